#include "scene/terrain_skirt.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>

namespace veduta {
namespace {

/// A sheet of two triangles over the unit square, the corners at heights of their own.
struct Sheet {
  explicit Sheet(bool clockwise = false) {
    for (const glm::vec3& p : {glm::vec3(0, 0, 5), {1, 0, 6}, {1, 1, 7}, {0, 1, 8}}) pool.index_of(p);
    for (glm::uvec3 t : {glm::uvec3(0, 1, 2), glm::uvec3(0, 2, 3)}) {
      if (clockwise) std::swap(t.y, t.z);
      terrain.push_back({t, Material::terrain, 3, 7});
    }
  }
  std::vector<glm::vec3> vertices;
  VertexPool pool{vertices};
  std::vector<Draft> terrain;
};

TEST(TerrainSkirt, WallsUnderOpenEdgesFaceAwayHoweverTheSheetIsWound) {
  for (const bool clockwise : {false, true}) {
    Sheet sheet(clockwise);
    const std::vector<Draft> walls = terrain_skirt(sheet.terrain, sheet.vertices, sheet.pool, 0);
    ASSERT_EQ(walls.size(), 8u) << "four open edges; the diagonal is shared";
    for (const Draft& wall : walls) {
      const glm::vec3 a = sheet.vertices[wall.corners.x], b = sheet.vertices[wall.corners.y],
                      c = sheet.vertices[wall.corners.z];
      const glm::vec3 normal = glm::cross(b - a, c - a),
                      outward = (a + b + c) / 3.0f - glm::vec3(0.5f, 0.5f, 0);
      EXPECT_NEAR(normal.z, 0, 1e-6) << "upright";
      EXPECT_GT(glm::dot(normal, glm::vec3(outward.x, outward.y, 0)), 0) << "faces away";
      EXPECT_EQ(wall.patch, 3u);
      EXPECT_EQ(wall.polygon, 7u);
    }
  }
}

TEST(TerrainSkirt, ClosesTheSheetButForItsFloor) {
  Sheet sheet;
  std::vector<Draft> all = terrain_skirt(sheet.terrain, sheet.vertices, sheet.pool, 0);
  all.insert(all.end(), sheet.terrain.begin(), sheet.terrain.end());
  std::map<std::pair<uint32_t, uint32_t>, int> uses;
  for (const Draft& t : all) {
    for (int n = 0; n < 3; ++n) ++uses[std::minmax(t.corners[n], t.corners[(n + 1) % 3])];
  }
  for (const auto& [edge, count] : uses) {
    const bool floor = sheet.vertices[edge.first].z == 0 && sheet.vertices[edge.second].z == 0;
    EXPECT_EQ(count, floor ? 1 : 2) << edge.first << " - " << edge.second;
  }
}

TEST(TerrainSkirt, NothingWhereTheSheetLiesOnTheBottom) {
  Sheet sheet;
  for (glm::vec3& vertex : sheet.vertices) vertex.z = 0;
  EXPECT_TRUE(terrain_skirt(sheet.terrain, sheet.vertices, sheet.pool, 0).empty());
}

}  // namespace
}  // namespace veduta
