// Faces with points on their sides, cut: each piece with area, together the face.
#include "scene/city/cut_face.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>
#include <set>

#include "edge_balance.h"

namespace veduta::city {
namespace {

// A face of these corners with so many points on each side, and what lies beyond its sides: one sliver of a
// face for each piece of a side, up to a point far off. So the cut face closes a cone.
void expect_cut(const std::vector<glm::dvec3>& corners, const std::array<size_t, 4>& points, uint32_t seed) {
  std::mt19937 engine(seed);
  Mesh mesh;
  mesh.vertices = corners;
  const auto count = static_cast<uint32_t>(corners.size());
  Face face{{0, 1, 2, count - 1}, 5};
  std::array<std::vector<uint32_t>, 4> sides;
  size_t triangles = count - 2;
  std::vector<uint32_t> outline;
  for (uint32_t i = 0; i < count; ++i) {
    outline.push_back(i);
    std::set<double> shares;
    while (shares.size() < points[i]) shares.insert((static_cast<double>(engine() % 999) + 0.5) / 1000);
    for (const double share : shares) {
      sides[i].push_back(static_cast<uint32_t>(mesh.vertices.size()));
      outline.push_back(sides[i].back());
      mesh.vertices.push_back(corners[i] * (1 - share) + corners[(i + 1) % count] * share);
    }
    triangles += points[i];
  }
  FaceCutter().cut(mesh, face, sides, mesh.faces);
  EXPECT_EQ(mesh.triangle_count(), triangles);
  const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners.back() - corners[0]);
  for (const Face& piece : mesh.faces) {
    EXPECT_EQ(piece.layer, 5);
    const size_t last = piece.is_quad() ? 4 : 3;
    for (size_t i = 0; i < last; ++i) {
      const glm::dvec3 &a = mesh.vertices[piece.corner[i]], &b = mesh.vertices[piece.corner[(i + 1) % last]],
                       &c = mesh.vertices[piece.corner[(i + 2) % last]];
      EXPECT_GT(glm::dot(glm::cross(b - a, c - b), normal), 1e-6 * glm::dot(normal, normal) / 1e3);
    }
  }
  const auto top = static_cast<uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back(corners[0] + normal);
  for (size_t i = 0; i < outline.size(); ++i)
    mesh.faces.push_back({{outline[(i + 1) % outline.size()], outline[i], top, top}, 0});
  const EdgeBalance balance = edge_balance(mesh);
  EXPECT_EQ(balance.open, 0) << balance.first;
}

TEST(CutFace, AnyPointsOnAnySides) {
  const std::vector<glm::dvec3> triangle{{0, 0, 0}, {5, 1, 1}, {1, 4, 2}},
      quad{{0, 0, 0}, {6, 0, 0}, {5, 3, 3}, {1, 4, 4}}, square{{1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}};
  uint32_t seed = 0;
  for (const size_t a : {0, 1, 2, 7})
    for (const size_t b : {0, 1, 3})
      for (const size_t c : {0, 1, 2, 5})
        for (const size_t d : {0, 1, 4}) {
          if (a + b + c + d == 0) continue;
          if (d == 0) expect_cut(triangle, {a, b, c, 0}, ++seed);
          expect_cut(quad, {a, b, c, d}, ++seed);
          expect_cut(square, {a, b, c, d}, ++seed);
        }
  EXPECT_GT(seed, 300u);
}

}  // namespace
}  // namespace veduta::city
