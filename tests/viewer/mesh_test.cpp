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

TEST(Mesh, AVertexIsSharedWithinAnObjectAndAMaterial) {
  Scene scene;
  scene.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {1, 0, 1}};
  scene.triangles = {{0, 1, 2}, {1, 3, 2}, {0, 1, 2}, {0, 1, 2}};
  scene.material = {Material::wall, Material::wall, Material::roof, Material::wall};
  scene.objects = {{"two materials", Kind::building, 0, 3}, {"in the same place", Kind::building, 3, 4}};
  const Mesh mesh = make_mesh(scene);
  EXPECT_EQ(mesh.vertices.size(), 4u + 3 + 3);
  EXPECT_EQ(mesh.corners[0].z, mesh.corners[1].z);
  EXPECT_EQ(mesh.vertices[mesh.corners[2].x].material, static_cast<uint8_t>(Material::roof));
  EXPECT_EQ(mesh.vertices[mesh.corners[3].x].object, 1u);
}

// What a building looks like must not depend on the piece of the file that it came in.
TEST(Mesh, APieceOfAFileHasTheNumbersOfTheFile) {
  Scene second = two_houses();
  second.objects = {{"with a window", Kind::building, 0, 3}};
  second.triangles.erase(second.triangles.begin(), second.triangles.begin() + 2);
  second.material.erase(second.material.begin(), second.material.begin() + 2);
  const Mesh whole = make_mesh(two_houses()), piece = make_mesh(second, 1);
  for (size_t t = 0; t < 3; ++t) {
    const MeshVertex& vertex = piece.vertices[piece.corners[t].x];
    EXPECT_EQ(vertex.object, 1u);
    EXPECT_EQ(vertex.tint, whole.vertices[whole.corners[t + 2].x].tint);
  }
}

}  // namespace
}  // namespace veduta
