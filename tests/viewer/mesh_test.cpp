#include "viewer/mesh.h"

#include <gtest/gtest.h>

namespace veduta {
namespace {

// Two objects of two walls each; the second has a window as well.
Scene two_houses() {
  Scene scene;
  for (uint32_t t = 0; t < 5; ++t) {
    const float x = 10.0f * static_cast<float>(t);
    scene.vertices.insert(scene.vertices.end(), {{x, 0, 1}, {x + 1, 0, 1}, {x, 0, 4}});
    scene.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    scene.material.push_back(t == 4 ? Material::window : Material::wall);
  }
  scene.objects = {{"plain", Kind::building, 0, 2}, {"with a window", Kind::building, 2, 5}};
  return scene;
}

TEST(Mesh, WallsBesideModelledWindowsArePlain) {
  const Mesh mesh = make_mesh(two_houses());
  ASSERT_EQ(mesh.corners.size(), 5u);
  const auto material = [&](size_t triangle) { return mesh.vertices[mesh.corners[triangle].x].material; };
  EXPECT_EQ(material(0), static_cast<uint8_t>(Material::wall));
  EXPECT_EQ(material(1), static_cast<uint8_t>(Material::wall));
  EXPECT_EQ(material(2), plain_wall);
  EXPECT_EQ(material(3), plain_wall);
  EXPECT_EQ(material(4), static_cast<uint8_t>(Material::window));
}

TEST(Mesh, HeightsAreAboveTheFootOfTheBuilding) {
  const Mesh mesh = make_mesh(two_houses());
  EXPECT_EQ(mesh.vertices[mesh.corners[0].x].height_cm, 0);
  EXPECT_EQ(mesh.vertices[mesh.corners[0].z].height_cm, 300);
}

}  // namespace
}  // namespace veduta
