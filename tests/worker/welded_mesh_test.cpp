#include "worker/welded_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "tests/worker/mesh.h"

namespace veduta {
namespace {

using test::Mesh;

TEST(WeldedMesh, ABoxHasEightVerticesAndFacesOutwards) {
  for (const bool inwards : {false, true}) {
    Mesh mesh;
    mesh.ground(-5, -5, 5, 5, 0);
    mesh.object();
    mesh.box({{0, 0, 0}, {2, 3, 4}});
    if (inwards) {
      for (size_t t = 2; t < mesh.scene.triangles.size(); ++t)
        std::swap(mesh.scene.triangles[t].y, mesh.scene.triangles[t].z);
    }
    const auto meshes = weld_buildings(all_triangles(mesh.scene));
    ASSERT_EQ(meshes.size(), 1u) << "the earth is none";
    const WeldedMesh& box = meshes[0];
    EXPECT_EQ(box.vertices.size(), 8u);
    ASSERT_EQ(box.faces.size(), 12u);
    EXPECT_EQ(std::count(box.oriented.begin(), box.oriented.end(), 1), 12);
    EXPECT_EQ(std::count(box.on_ground.begin(), box.on_ground.end(), 1), 4);
    const glm::dvec3 middle(1, 1.5, 2);
    for (const glm::uvec3& f : box.faces) {
      const glm::dvec3 &a = box.vertices[f.x], &b = box.vertices[f.y], &c = box.vertices[f.z];
      EXPECT_GT(glm::dot(glm::cross(b - a, c - a), a - middle), 0);
    }
  }
}

TEST(WeldedMesh, BuildingsThatShareAVertexAreOne) {
  for (const float gap : {0.0f, 0.1f}) {
    Mesh mesh;
    mesh.object();
    mesh.box({{0, 0, 0}, {2, 3, 4}});
    mesh.object();
    mesh.box({{2 + gap, 3, 0}, {4, 5, 4}});
    EXPECT_EQ(weld_buildings(all_triangles(mesh.scene)).size(), gap > 0 ? 2u : 1u);
  }
}

TEST(WeldedMesh, PartsOfABuildingAreOneMesh) {
  Mesh mesh;
  mesh.object();
  mesh.box({{0, 0, 0}, {2, 3, 4}});
  mesh.box({{5, 0, 1}, {7, 3, 4}});
  const auto meshes = weld_buildings(all_triangles(mesh.scene));
  ASSERT_EQ(meshes.size(), 1u);
  EXPECT_EQ(std::count(meshes[0].on_ground.begin(), meshes[0].on_ground.end(), 1), 4)
      << "the other stands on air";
}

TEST(WeldedMesh, DoublesAreOneAndPartyWallsNone) {
  Mesh mesh;
  mesh.object();
  mesh.triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  mesh.triangle({1, 0, 0}, {0, 1, 0}, {0, 0, 0});  // the same again
  mesh.triangle({0, 0, 1}, {1, 0, 1}, {0, 1, 1});
  mesh.triangle({0, 0, 1}, {0, 1, 1}, {1, 0, 1});  // faces the one before
  mesh.triangle({3, 0, 0}, {4, 0, 0}, {5, 0, 0});  // no area
  const auto meshes = weld_buildings(all_triangles(mesh.scene));
  ASSERT_EQ(meshes.size(), 1u);
  EXPECT_EQ(meshes[0].source, std::vector<uint32_t>{0});
  EXPECT_EQ(meshes[0].oriented, std::vector<uint8_t>{0}) << "an open sheet";
}

}  // namespace
}  // namespace veduta
