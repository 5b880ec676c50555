#include "pvs/vertex_numbers.h"

#include <gtest/gtest.h>

namespace veduta {
namespace {

TEST(VertexNumbers, OfVerticesInARow) {
  std::vector<glm::uvec3> triangles{{7, 8, 9}, {8, 10, 9}};
  EXPECT_EQ(number_from_zero(triangles), (std::vector<VertexRun>{{7, 4}}));
  EXPECT_EQ(triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {1, 3, 2}}));
}

TEST(VertexNumbers, OfVerticesWithGaps) {
  std::vector<glm::uvec3> triangles{{7, 9, 12}, {9, 13, 12}};
  EXPECT_EQ(number_from_zero(triangles), (std::vector<VertexRun>{{7, 1}, {9, 1}, {12, 2}}));
  EXPECT_EQ(triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {1, 3, 2}}));
}

TEST(VertexNumbers, OfVerticesFarApart) {
  std::vector<glm::uvec3> triangles{{4294967294u, 0, 1000000}, {0, 1000001, 4294967294u}};
  EXPECT_EQ(number_from_zero(triangles), (std::vector<VertexRun>{{0, 1}, {1000000, 2}, {4294967294u, 1}}));
  EXPECT_EQ(triangles, (std::vector<glm::uvec3>{{3, 0, 1}, {0, 2, 3}}));
}

TEST(VertexNumbers, OfNoTriangles) {
  std::vector<glm::uvec3> triangles;
  EXPECT_TRUE(number_from_zero(triangles).empty());
}

}  // namespace
}  // namespace veduta
