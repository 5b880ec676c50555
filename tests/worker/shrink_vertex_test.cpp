#include "worker/shrink_vertex.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/worker/shrink_cities.h"

namespace veduta {
namespace {

using test::Mesh;

struct Shrunk {
  WindowOccluders window;
  VertexCounts counts;
};

Shrunk shrink(const Scene& scene, const glm::dvec3& half_extent) {
  ShrinkRequest request;
  request.half_extents_m = {half_extent};
  request.reach_m = 10;  // one ring
  Shrunk result;
  result.window = VertexShrinker().shrink(make_sealed_block(scene, 0.25), request, result.counts).front();
  return result;
}

/// A house [0, 20] x [0, 16] x [0, 12] on level ground.
Mesh one_house() {
  Mesh mesh;
  mesh.ground(-5, -5, 25, 21, 0);
  mesh.object();
  mesh.box({{0, 0, 0}, {20, 16, 12}});
  return mesh;
}

TEST(ShrinkVertex, FacesMoveByTheLongestWayInTheWindowOrMore) {
  const Shrunk s = shrink(one_house().scene, {1, 1, 0.5});
  ASSERT_EQ(s.window.rings.size(), 1u);
  const OccluderMesh& mesh = s.window.rings[0].occluders;
  EXPECT_EQ(s.counts.faces, 10u) << "but for the floor";
  EXPECT_EQ(s.counts.kept, 10u);
  ASSERT_EQ(mesh.bodies(), 1u);
  EXPECT_EQ(mesh.triangles(), 20u) << "both sides, as the floor is missing";
  const double epsilon = glm::length(glm::dvec3(1, 1, 0.5) + s.window.rings[0].h_m);
  const Box bounds = mesh.bounds(0);
  for (int axis = 0; axis < 2; ++axis) {
    EXPECT_GE(bounds.lower[axis], epsilon - 1e-5);
    EXPECT_LE(bounds.lower[axis], 3 * epsilon) << "a corner's sine is at least a third";
    EXPECT_LE(bounds.upper[axis], (axis == 0 ? 20 : 16) - epsilon + 1e-5);
  }
  EXPECT_LE(bounds.upper.z, 12 - epsilon + 1e-5);
  EXPECT_EQ(bounds.lower.z, 0) << "what touches the ground is not raised";
}

TEST(ShrinkVertex, AHouseThinnerThanTwiceTheWayIsRemoved) {
  Mesh mesh;
  mesh.ground(-5, -5, 35, 15, 0);
  mesh.object();
  mesh.box({{0, 0, 0}, {30, 2.6f, 12}});
  const Shrunk s = shrink(mesh.scene, {1, 1, 0.5});
  EXPECT_EQ(s.window.rings[0].occluders.bodies(), 0u);
  EXPECT_GT(s.counts.intersecting, 0u);
}

TEST(ShrinkVertex, AShellThatFacesInwardsIsTurned) {
  Mesh mesh = one_house();
  const Object& house = mesh.scene.objects.back();
  for (uint64_t t = house.triangle_begin; t < house.triangle_end; ++t)
    std::swap(mesh.scene.triangles[t].y, mesh.scene.triangles[t].z);
  EXPECT_EQ(shrink(mesh.scene, {1, 1, 0.5}).counts.kept, 10u);
}

TEST(ShrinkVertex, WhatTheThesisKeepsAndIsNotSealedIsRemoved) {
  Mesh mesh;  // a shell without roof, and so with nothing inside that hides
  mesh.ground(-5, -5, 25, 21, 0);
  mesh.object();
  mesh.box({{0, 0, 0}, {20, 16, 12}}, false);
  const Shrunk s = shrink(mesh.scene, {1, 1, 0.5});
  EXPECT_EQ(s.counts.kept, 0u);
  EXPECT_GT(s.counts.unsafe, 0u);
}

TEST(ShrinkVertex, HousesThatShareVerticesAreShrunkTogether) {
  Mesh together, apart;
  for (Mesh* mesh : {&together, &apart}) {
    mesh->ground(-5, -5, 25, 21, 0);
    mesh->object();
    mesh->box({{0, 0, 0}, {3, 16, 12}});
    mesh->object();
    // Apart: too little for an eye, and enough for vertices not to be the same.
    const float x = mesh == &apart ? 3.05f : 3;
    mesh->box({{x, 0, 0}, {6, 16, 12}});
  }
  // The party wall is there twice, each time cut along another diagonal.
  const Shrunk t = shrink(together.scene, {0.5, 0.5, 0.5}), a = shrink(apart.scene, {0.5, 0.5, 0.5});
  const auto width = [](const Shrunk& s) {
    Box all;
    for (const glm::vec3& corner : s.window.rings[0].occluders.corners) all.extend(corner);
    return all.empty() ? 0.0f : all.upper.x - all.lower.x;
  };
  EXPECT_GT(width(t), 2.5f);
  EXPECT_LT(t.window.rings[0].occluders.bounds(0).lower.x, 2);
  EXPECT_GT(t.window.rings[0].occluders.bounds(0).upper.x, 4) << "one body across the party wall";
  EXPECT_EQ(t.window.rings[0].occluders.bodies(), 1u);
  EXPECT_EQ(a.window.rings[0].occluders.bodies(), 2u);
}

TEST(ShrinkVertex, WhatLiesBelowEveryEyeIsLeftOut) {
  ShrinkRequest request;
  request.half_extents_m = {{1, 1, 0.5}};
  request.reach_m = 10;
  request.lowest_eye_m = 11.5;
  const auto windows = VertexShrinker().shrink(make_sealed_block(one_house().scene, 0.25), request);
  EXPECT_EQ(windows[0].rings[0].occluders.bodies(), 0u);
}

}  // namespace
}  // namespace veduta
