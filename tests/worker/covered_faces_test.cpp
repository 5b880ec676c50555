#include "worker/covered_faces.h"

#include <gtest/gtest.h>

#include "tests/worker/mesh.h"

namespace veduta {
namespace {

using test::Mesh;

std::vector<uint8_t> covered_faces_of(const Mesh& mesh) {
  return covered_faces({mesh.scene.vertices.begin(), mesh.scene.vertices.end()}, mesh.scene.triangles);
}

TEST(CoveredFaces, HoweverTheyAreCut) {
  Mesh mesh;
  mesh.object();
  mesh.quad({3, 0, 0}, {3, 4, 0}, {3, 4, 5}, {3, 0, 5});
  mesh.quad({3, 4, 0}, {3, 0, 0}, {3, 0, 5}, {3, 4, 5});  // along the other diagonal
  mesh.quad({0, 0, 5}, {3, 0, 5}, {3, 4, 5}, {0, 4, 5});  // a roof beside
  EXPECT_EQ(covered_faces_of(mesh), (std::vector<uint8_t>{1, 1, 1, 1, 0, 0}));
}

TEST(CoveredFaces, WhatIsCoveredInPartStays) {
  Mesh mesh;
  mesh.object();
  mesh.quad({3, 0, 0}, {3, 4, 0}, {3, 4, 5}, {3, 0, 5});
  mesh.quad({3, 3, 0}, {3, 1, 0}, {3, 1, 5}, {3, 3, 5});  // of a narrower house
  EXPECT_EQ(covered_faces_of(mesh), (std::vector<uint8_t>{0, 0, 1, 1}));
}

TEST(CoveredFaces, FacingTheSameWayOrApartIsNone) {
  Mesh mesh;
  mesh.object();
  mesh.quad({3, 0, 0}, {3, 4, 0}, {3, 4, 5}, {3, 0, 5});
  mesh.quad({3, 0, 0}, {3, 4, 0}, {3, 4, 5}, {3, 0, 5});
  mesh.quad({3.01f, 4, 0}, {3.01f, 0, 0}, {3.01f, 0, 5}, {3.01f, 4, 5});
  EXPECT_EQ(covered_faces_of(mesh), std::vector<uint8_t>(6, 0));
}

}  // namespace
}  // namespace veduta
