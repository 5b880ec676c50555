#include "worker/convex_body.h"

#include <gtest/gtest.h>

#include <glm/mat3x3.hpp>

#include "tests/worker/shrink_property.h"

namespace veduta {
namespace {

using test::Random;

std::vector<HalfSpace> box_sides(const glm::dvec3& half, const glm::dmat3& turn) {
  std::vector<HalfSpace> sides;
  for (int axis = 0; axis < 3; ++axis) {
    sides.push_back({turn[axis], half[axis]});
    sides.push_back({-turn[axis], half[axis]});
  }
  return sides;
}

const Box around{{-20, -20, -20}, {20, 20, 20}};

double volume(const OccluderMesh& mesh) {
  double six = 0;
  for (const auto& face : test::faces_of(mesh, 0))
    for (size_t n = 2; n < face.size(); ++n) six += glm::dot(face[0], glm::cross(face[n - 1], face[n]));
  return six / 6;
}

TEST(ConvexBody, SupportIsHowFarTheBoxReaches) {
  EXPECT_DOUBLE_EQ(support({1, 2, 3}, {0, 0, -1}), 3);
  EXPECT_DOUBLE_EQ(support({1, 2, 3}, {0.6, -0.8, 0}), 0.6 + 1.6);
}

TEST(ConvexBody, ABoxHasSixFacesThatFaceOutwards) {
  OccluderMesh mesh;
  add_body(box_sides({3, 4, 5}, glm::dmat3(1)), {1, 1, 0.5}, around, mesh);
  ASSERT_EQ(mesh.bodies(), 1u);
  EXPECT_EQ(mesh.faces(), 6u);
  EXPECT_EQ(mesh.triangles(), 12u);
  EXPECT_NEAR(volume(mesh), 4.0 * 6 * 9, 1e-3) << "signed: inwards would be negative";
  EXPECT_EQ(mesh.bounds(0).upper, glm::vec3(2, 3, 4.5));
}

TEST(ConvexBody, ErosionTakesAwayWhatTheWindowOfEachPointReaches) {
  Random random(1);
  for (int round = 0; round < 40; ++round) {
    const glm::dvec3 axis =
        glm::normalize(glm::dvec3(random.real(-1, 1), random.real(-1, 1), random.real(-1, 1)));
    const glm::dvec3 u = glm::normalize(glm::cross(axis, glm::dvec3(0.3, 0.5, 0.7)));
    const std::vector<HalfSpace> sides = box_sides({5, 4, 6}, glm::dmat3(u, glm::cross(axis, u), axis));
    const glm::dvec3 window(random.real(0, 1), random.real(0, 1), random.real(0, 1));
    OccluderMesh mesh;
    add_body(sides, window, around, mesh);
    ASSERT_EQ(mesh.bodies(), 1u);
    const auto faces = test::faces_of(mesh, 0);
    EXPECT_TRUE(test::is_convex(faces));
    for (const auto& face : faces) {
      for (const glm::dvec3& corner : face) {
        double most = -1e9;  // some corner of the window touches a side, none passes one
        for (const HalfSpace& side : sides) {
          for (int c = 0; c < 8; ++c) {
            const glm::dvec3 q = corner + window * glm::dvec3(c & 1 ? 1 : -1, c & 2 ? 1 : -1, c & 4 ? 1 : -1);
            most = std::max(most, glm::dot(side.normal, q) - side.offset_m);
          }
        }
        EXPECT_NEAR(most, 0, 1e-5);
      }
    }
  }
}

TEST(ConvexBody, FacesMeetInTheSameCorners) {
  // Five planes through nearly one point: corners closer than float32 tells apart are one.
  std::vector<HalfSpace> sides = box_sides({5, 5, 5}, glm::dmat3(1));
  for (const double turn : {0.0, 0.7, 2.1, 3.3, 5.0}) {
    const glm::dvec3 n = glm::normalize(glm::dvec3(std::cos(turn), std::sin(turn), 1));
    sides.push_back({n, glm::dot(n, glm::dvec3(0, 0, 4)) + 1e-10 * turn});
  }
  OccluderMesh mesh;
  add_body(sides, glm::dvec3(0), around, mesh);
  ASSERT_EQ(mesh.bodies(), 1u);
  // Closed: every edge once each way.
  std::vector<std::pair<glm::vec3, glm::vec3>> edges;
  for (size_t f = 0; f < mesh.faces(); ++f) {
    const uint32_t begin = mesh.face_begin[f], end = mesh.face_begin[f + 1];
    for (uint32_t c = begin; c < end; ++c)
      edges.emplace_back(mesh.corners[c], mesh.corners[c + 1 < end ? c + 1 : begin]);
  }
  for (const auto& [a, b] : edges) {
    int back = 0;
    for (const auto& [c, d] : edges) back += c == b && d == a;
    EXPECT_EQ(back, 1);
  }
}

TEST(ConvexBody, WhatIsErodedAwayIsNoBody) {
  OccluderMesh mesh;
  add_body(box_sides({1, 1, 1}, glm::dmat3(1)), {0.5, 1.1, 0.5}, around, mesh);
  EXPECT_EQ(mesh.bodies(), 0u);
  add_body({{{0, 0, 1}, 1}, {{0, 0, -1}, -2}}, glm::dvec3(0), around, mesh);  // contradict each other
  EXPECT_EQ(mesh.bodies(), 0u);
}

}  // namespace
}  // namespace veduta
