#include "worker/shrink_sections.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/worker/mesh.h"
#include "tests/worker/shrink_cities.h"
#include "tests/worker/shrink_property.h"

namespace veduta {
namespace {

using test::Mesh;

constexpr double seed_m = 0.125;

ShrinkRequest request_of(const glm::dvec3& half_extent_m) {
  ShrinkRequest request;
  request.half_extents_m = {half_extent_m};
  request.resolution = 512;
  request.reach_m = 30;  // one ring
  request.lowest_eye_m = 0;
  return request;
}

/// Is the point in a body?
bool inside(const OccluderMesh& mesh, const glm::dvec3& p) {
  for (size_t body = 0; body < mesh.bodies(); ++body) {
    bool in = true;
    for (const auto& face : test::faces_of(mesh, body))
      in = in && glm::dot(glm::cross(face[1] - face[0], face[2] - face[1]), p - face[0]) <= 1e-9;
    if (in) return true;
  }
  return false;
}

/// Volume of all bodies together above z, by points on a lattice.
double volume_above(const OccluderMesh& mesh, double z_m, double step_m = 0.2) {
  Box bounds;
  for (size_t body = 0; body < mesh.bodies(); ++body) bounds.extend(mesh.bounds(body));
  if (bounds.empty()) return 0;
  double count = 0;
  for (double x = bounds.lower.x + step_m / 2; x < bounds.upper.x; x += step_m) {
    for (double y = bounds.lower.y + step_m / 2; y < bounds.upper.y; y += step_m) {
      for (double z = z_m + step_m / 2; z < bounds.upper.z; z += step_m) count += inside(mesh, {x, y, z});
    }
  }
  return count * step_m * step_m * step_m;
}

OccluderMesh shrunk(const Mesh& mesh, const ShrinkRequest& request) {
  return SectionsShrinker()
      .shrink(make_sealed_block(mesh.scene, seed_m), request)
      .at(0)
      .rings.at(0)
      .occluders;
}

/// Turns what was added since `first`.
void turn(Mesh& mesh, size_t first, double angle) {
  const auto c = static_cast<float>(std::cos(angle)), s = static_cast<float>(std::sin(angle));
  for (size_t v = first; v < mesh.scene.vertices.size(); ++v) {
    glm::vec3& p = mesh.scene.vertices[v];
    p = {c * p.x - s * p.y, s * p.x + c * p.y, p.z};
  }
}

Mesh on_ground() {
  Mesh mesh;
  mesh.ground(-40, -40, 40, 40, 0);
  mesh.object();
  return mesh;
}

TEST(SectionsShrinker, ATurnedBoxKeepsItsWalls) {
  const glm::dvec3 e(2.5, 2.5, 0.5);
  const ShrinkRequest request = request_of(e);
  const double h = request.rings(e)[0].h_m;
  for (const double angle : {0.0, 0.3, 0.7}) {
    Mesh mesh = on_ground();
    const size_t first = mesh.scene.vertices.size();
    mesh.box({{-5, -10, 0}, {5, 10, 12}});
    turn(mesh, first, angle);
    const OccluderMesh left = shrunk(mesh, request);
    const double support = (2.5 + h) * (std::abs(std::cos(angle)) + std::abs(std::sin(angle)));
    const double exact = (10 - 2 * support) * (20 - 2 * support) * (12 - 0.5 - h);
    const double kept = volume_above(left, 0);
    EXPECT_GT(kept, 0.97 * exact) << "at " << angle << ", " << left.triangles() << " triangles";
    EXPECT_LT(kept, 1.02 * exact);
    EXPECT_LE(left.triangles(), 12u) << "at " << angle;
  }
}

TEST(SectionsShrinker, AnLShapeIsTwoPrisms) {
  const glm::dvec3 e(1.5, 1.5, 0.5);
  const ShrinkRequest request = request_of(e);
  const double w = 1.5 + request.rings(e)[0].h_m;
  Mesh mesh = on_ground();
  mesh.box({{0, 0, 0}, {20, 8, 10}}), mesh.box({{0, 0, 0}, {8, 20, 10}});
  const OccluderMesh left = shrunk(mesh, request);
  const double exact = ((20 - 2 * w) * (8 - 2 * w) * 2 - (8 - 2 * w) * (8 - 2 * w)) * (10 - w + 1);
  EXPECT_GT(volume_above(left, 0), 0.97 * exact);
  EXPECT_EQ(left.bodies(), 2u);
}

TEST(SectionsShrinker, AGableIsAFewSteps) {
  const glm::dvec3 e(1.5, 1.5, 0.5);
  ShrinkRequest request = request_of(e);
  const double h = request.rings(e)[0].h_m, w = 1.5 + h;
  Mesh mesh = on_ground();
  const glm::vec3 a(0, 0, 0), b(8, 0, 0), c(8, 16, 0), d(0, 16, 0), up(0, 0, 6), r0(4, 0, 10), r1(4, 16, 10);
  mesh.quad(a, b, b + up, a + up), mesh.triangle(a + up, b + up, r0);
  mesh.quad(c, d, d + up, c + up), mesh.triangle(c + up, d + up, r1);
  mesh.quad(b, c, c + up, b + up), mesh.quad(d, a, a + up, d + up);
  mesh.quad(b + up, c + up, r1, r0), mesh.quad(d + up, a + up, r0, r1);
  // The eaves stand w aside of where the roof ends above them: it rises from there at 45 degrees.
  const double width = 8 - 2 * w;
  const double exact = (16 - 2 * w) * (width * (6 - 0.5 - h) + width * width / 4);
  const OccluderMesh left = shrunk(mesh, request);
  EXPECT_GT(volume_above(left, 0), 0.9 * exact);
  EXPECT_LE(left.bodies(), 4u);
  request.keep = 0.8;
  EXPECT_LT(shrunk(mesh, request).bodies(), left.bodies()) << "asked for less, gives fewer";
}

TEST(SectionsShrinker, RowHousesFuse) {
  const glm::dvec3 e(2, 2, 0.5);
  const ShrinkRequest request = request_of(e);
  const double w = 2 + request.rings(e)[0].h_m;
  Mesh row = on_ground();
  for (int house = 0; house < 8; ++house) {
    Mesh alone = on_ground();
    const Box box{{static_cast<float>(4 * house), 0, 0}, {static_cast<float>(4 * house + 4), 9, 8}};
    row.object();
    row.box(box), alone.box(box);
    EXPECT_EQ(shrunk(alone, request).bodies(), 0u);
  }
  Mesh turned = row;
  turn(turned, 4, 0.4);  // the ground stays
  const OccluderMesh left = shrunk(row, request);
  EXPECT_EQ(left.bodies(), 1u);
  // Party walls are exposed at their ends, up to a seed deep: the outline keeps off them.
  EXPECT_GT(volume_above(left, 0), 0.95 * (32 - 2 * w) * (9 - 2 * w) * (8 - w + 1.5));
  EXPECT_EQ(shrunk(turned, request).bodies(), 1u);
}

TEST(SectionsShrinker, AnUpperFloorOverAPassageHangs) {
  const glm::dvec3 e(1, 1, 0.5);
  const ShrinkRequest request = request_of(e);
  Mesh mesh = on_ground();
  mesh.box({{0, 0, 0}, {5, 8, 12}}), mesh.box({{9, 0, 0}, {14, 8, 12}}), mesh.box({{4, 0, 4}, {10, 8, 12}});
  const OccluderMesh left = shrunk(mesh, request);
  EXPECT_TRUE(inside(left, {7, 4, 8})) << "over the passage";
  EXPECT_FALSE(inside(left, {7, 4, 2})) << "in the passage";
  EXPECT_TRUE(inside(left, {2.5, 4, 3})) << "beside it";
}

TEST(SectionsShrinker, ACourtyardStaysOpen) {
  const ShrinkRequest request = request_of({1, 1, 0.5});
  Mesh mesh = on_ground();
  for (const Box& wing : {Box{{-10, -10, 0}, {10, -4, 9}},
                          {{-10, 4, 0}, {10, 10, 9}},
                          {{-10, -10, 0}, {-4, 10, 9}},
                          {{4, -10, 0}, {10, 10, 9}}})
    mesh.box(wing);
  const OccluderMesh left = shrunk(mesh, request);
  EXPECT_FALSE(inside(left, {0, 0, 2}));
  for (const glm::dvec3& wing : {glm::dvec3(7, 0, 4), {-7, 0, 4}, {0, 7, 4}, {0, -7, 4}})
    EXPECT_TRUE(inside(left, wing));
  EXPECT_EQ(left.bodies(), 4u);
}

TEST(SectionsShrinker, EveryWindowIsSealed) {
  ShrinkRequest request;
  request.half_extents_m = {{0.6, 0.6, 0.3}, {1.3, 0.9, 0.4}};
  request.resolution = 64;
  request.reach_m = 60;
  request.lowest_eye_m = 0.5;
  size_t bodies = 0;
  for (int plot = 0; plot < static_cast<int>(test::Plot::count); ++plot) {
    SCOPED_TRACE(test::plot_name(static_cast<test::Plot>(plot)));
    bodies += test::expect_conservative(test::one_plot(static_cast<test::Plot>(plot), 1), SectionsShrinker(),
                                        request, 0.25, 200)
                  .bodies;
  }
  for (const uint32_t seed : {1u, 2u, 3u}) {
    SCOPED_TRACE(seed);
    bodies +=
        test::expect_conservative(test::random_city(seed), SectionsShrinker(), request, 0.25, 300).bodies;
  }
  EXPECT_GT(bodies, 100u);
}

TEST(SectionsShrinker, TheSameCityGivesTheSameBytes) {
  const Scene scene = test::random_city(7);
  ShrinkRequest request;
  request.half_extents_m = {{0.6, 0.6, 0.3}};
  request.reach_m = 100;
  const auto once = SectionsShrinker().shrink(make_sealed_block(scene, 0.25), request);
  const auto again = SectionsShrinker().shrink(make_sealed_block(scene, 0.25), request);
  for (size_t r = 0; r < once[0].rings.size(); ++r) {
    const OccluderMesh &a = once[0].rings[r].occluders, &b = again[0].rings[r].occluders;
    EXPECT_EQ(a.corners, b.corners);
    EXPECT_EQ(a.face_begin, b.face_begin);
    EXPECT_EQ(a.body_begin, b.body_begin);
  }
  EXPECT_GT(once[0].rings[0].occluders.bodies(), 0u);
}

TEST(SectionsShrinker, NothingToShrinkGivesEmptyRings) {
  ShrinkRequest request = request_of({2, 2, 0.5});
  Mesh bare;
  bare.ground(0, 0, 20, 20, 0);
  EXPECT_EQ(shrunk(bare, request).bodies(), 0u);
  Mesh one;
  one.object();
  one.triangle({0, 0, 0}, {1, 0, 3}, {0, 1, 1});
  EXPECT_EQ(shrunk(one, request).bodies(), 0u);
  Mesh thin = on_ground();
  thin.box({{0, 0, 0}, {20, 3.9f, 10}});  // thinner than the window
  EXPECT_EQ(shrunk(thin, request).bodies(), 0u);
  request.half_extents_m.clear();
  EXPECT_TRUE(SectionsShrinker().shrink(make_sealed_block(thin.scene, seed_m), request).empty());
}

}  // namespace
}  // namespace veduta
