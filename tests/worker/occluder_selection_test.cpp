#include "worker/occluder_selection.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/worker/convex_bodies.h"
#include "worker/cube_face.h"

namespace veduta {
namespace {

using test::Faces;
using test::Random;

/// Of one ring.
OccluderSelection selection_of(OccluderMesh mesh, float depth_limit_m = 1000) {
  const std::vector<WindowOccluders> windows{{glm::dvec3(1), {{0.1, depth_limit_m, std::move(mesh)}}}};
  return OccluderSelection(windows, 0);
}

/// Twice the area of what the quads draw, as two triangles each.
glm::dvec3 drawn_area(const std::vector<OccluderVertex>& vertices) {
  glm::dvec3 sum(0);
  for (size_t v = 0; v < vertices.size(); v += 4) {
    const glm::dvec3 a(vertices[v]), b(vertices[v + 1]), c(vertices[v + 2]), d(vertices[v + 3]);
    sum += glm::cross(b - a, c - a) + glm::cross(c - a, d - a);
  }
  return sum;
}

TEST(OccluderSelection, DrawsEveryPolygonThatFacesTheEyeAndNoOther) {
  Random random(1);
  size_t seen = 0;
  for (int round = 0; round < 200; ++round) {
    const Faces faces = test::random_body(random, {3, 2, 4});
    const glm::vec3 middle(20, random.real(-5, 5), random.real(-5, 5));
    OccluderMesh mesh;
    test::add_body(mesh, faces, middle);
    OccluderSelection selection = selection_of(mesh, 77);
    size_t quads = 0;
    glm::dvec3 area(0);
    for (const auto& face : faces) {
      const glm::dvec3 a(face[0]), b(face[1]), c(face[2]);
      if (glm::dot(glm::cross(b - a, c - a), a + glm::dvec3(middle)) >= 0) continue;
      quads += (face.size() - 1) / 2;
      for (size_t n = 1; n + 1 < face.size(); ++n)
        area += glm::cross(glm::dvec3(face[n] - face[0]), glm::dvec3(face[n + 1] - face[0]));
    }
    const std::vector<OccluderVertex>& vertices = selection.select(0, {0, 0, 0});
    EXPECT_EQ(vertices.size(), 4 * quads);
    EXPECT_LT(glm::length(drawn_area(vertices) - area), 1e-4 * glm::length(area));
    for (const OccluderVertex& v : vertices) EXPECT_EQ(v.w, 77);
    seen += quads;
    EXPECT_TRUE(selection.select(1, {0, 0, 0}).empty()) << "behind";
    EXPECT_TRUE(selection.select(0, middle).empty() || !test::inside(faces, {0, 0, 0})) << "from inside";
  }
  EXPECT_GT(seen, 400u);
}

TEST(OccluderSelection, FacesWithoutAnAreaAreDropped) {
  OccluderMesh mesh;
  mesh.add_box({{10, -1, -1}, {11, 1, 1}});
  mesh.face_begin.pop_back(), mesh.corners.resize(mesh.face_begin.back());  // without its top
  mesh.add_face({{10, -1, 0}, {10, 0, 0}, {10, 1, 0}});
  mesh.body_begin.back() = static_cast<uint32_t>(mesh.faces());
  mesh.add_face({{12, 0, 0}, {12, 0, 0}, {12, 0, 0}});
  mesh.end_body();
  EXPECT_EQ(selection_of(mesh).select(0, {0, 0, 0}).size(), 4u) << "one side of the box";
}

TEST(OccluderSelection, FacesTakeWhatReachesIntoThem) {
  OccluderMesh mesh;
  for (int face = 0; face < face_count; ++face) {
    const glm::vec3 forward = glm::transpose(face_from_world(face)) * glm::vec3(0, 0, 10);
    mesh.add_box({forward - 1.0f, forward + 1.0f});
  }
  OccluderSelection selection = selection_of(mesh);
  for (int face = 0; face < face_count; ++face) {
    const auto& vertices = selection.select(face, {0, 0, 0});
    ASSERT_EQ(vertices.size(), 4u) << face;
    for (const OccluderVertex& v : vertices)
      EXPECT_NEAR((face_from_world(face) * glm::vec3(v)).z, 9, 1e-5) << face;
  }
  const OccluderMesh beyond = [] {
    OccluderMesh far;
    far.add_box({{60, -1, -1}, {62, 1, 1}});
    return far;
  }();
  EXPECT_TRUE(selection_of(beyond, 59).select(0, {0, 0, 0}).empty());
  EXPECT_FALSE(selection_of(beyond, 61).select(0, {0, 0, 0}).empty());
}

TEST(OccluderSelection, ManyBodiesBehindOneAreLeftOut) {
  OccluderMesh mesh;
  mesh.add_box({{10, -20, -2}, {12, 20, 10}});
  for (int n = 0; n < 100; ++n) {
    const auto x = static_cast<float>(30 + n);
    mesh.add_box({{x, -10, -2}, {x + 0.5f, 10, 5}});
  }
  EXPECT_EQ(selection_of(mesh).select(0, {0, 0, 0}).size(), 4u);
}

}  // namespace
}  // namespace veduta
