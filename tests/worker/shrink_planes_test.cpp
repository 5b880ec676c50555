#include "worker/shrink_planes.h"

#include <gtest/gtest.h>

#include <cstring>

#include "tests/worker/shrink_cities.h"
#include "tests/worker/shrink_property.h"

namespace veduta {
namespace {

using test::Mesh;
using test::Plot;

ShrinkRequest request_of(const glm::dvec3& half_extent_m) {
  ShrinkRequest request;
  request.half_extents_m = {half_extent_m};
  request.resolution = 64;
  request.reach_m = 60;
  request.lowest_eye_m = 1.2;
  return request;
}

double volume(const OccluderMesh& mesh, size_t body) {
  double six = 0;
  const auto faces = test::faces_of(mesh, body);
  for (const auto& face : faces)
    for (size_t n = 2; n < face.size(); ++n) six += glm::dot(face[0], glm::cross(face[n - 1], face[n]));
  return six / 6;
}

double volume(const OccluderMesh& mesh) {
  double sum = 0;
  for (size_t b = 0; b < mesh.bodies(); ++b) sum += volume(mesh, b);
  return sum;
}

/// The part of the mesh's only body above a height, as a volume: a box's base is below the ground.
const OccluderMesh& first_ring(const std::vector<WindowOccluders>& windows) {
  return windows.at(0).rings.at(0).occluders;
}

/// A house with a gable roof, 10 m x 16 m, eaves at 6 m, ridge at 10 m, turned about the origin.
Mesh gable_house(double angle) {
  Mesh mesh;
  mesh.ground(-30, -30, 30, 30, 0);
  mesh.object();
  const auto at = [&](double x, double y, double z) {
    return glm::vec3(std::cos(angle) * x - std::sin(angle) * y, std::sin(angle) * x + std::cos(angle) * y, z);
  };
  for (const double y : {-8.0, 8.0}) {
    mesh.quad(at(-5, y, 0), at(5, y, 0), at(5, y, 6), at(-5, y, 6));
    mesh.triangle(at(-5, y, 6), at(5, y, 6), at(0, y, 10));
  }
  for (const double x : {-5.0, 5.0}) {
    mesh.quad(at(x, -8, 0), at(x, 8, 0), at(x, 8, 6), at(x, -8, 6));
    mesh.quad(at(x, -8, 6), at(x, 8, 6), at(0, 8, 10), at(0, -8, 10));
  }
  return mesh;
}

TEST(ShrinkPlanes, IsAmongTheMethods) {
  EXPECT_NE(dynamic_cast<PlanesShrinker*>(make_shrinker("planes").get()), nullptr);
}

TEST(ShrinkPlanes, AHouseIsErodedAlongItsOwnWallsAndRoofs) {
  for (const double angle : {0.0, 0.3, 1.0}) {
    const ShrinkRequest request = request_of({1, 1, 0.5});
    const SealedBlock block = make_sealed_block(gable_house(angle).scene, 0.0625);
    const auto windows = PlanesShrinker().shrink(block, request);
    const OccluderMesh& mesh = first_ring(windows);
    // The house in one body; another may take what the first lost at the foot of the walls.
    ASSERT_GE(mesh.bodies(), 1u);
    ASSERT_LE(mesh.bodies(), 2u) << angle;
    EXPECT_LE(test::faces_of(mesh, 0).size(), 8u) << angle;
    // The same by hand: every plane moved inwards by the window's support.
    const glm::dvec3 w = request.half_extents_m[0] + windows[0].rings[0].h_m;
    const double c = std::abs(std::cos(angle)), s = std::abs(std::sin(angle));
    const double wall = w.x * c + w.y * s;  // support along a wall's normal (w.x = w.y)
    const glm::dvec3 roof = glm::normalize(glm::dvec3(4, 0, 5));
    const double roof_drop = (roof.x * (w.x * c + w.y * s) + roof.z * w.z) / roof.z;  // of the roof's height
    const double half = 5 - wall, length = 16 - 2 * wall;
    const double ridge = 10 - roof_drop, eaves = ridge - 0.8 * half;
    const double bottom = mesh.bounds(0).lower.z;
    EXPECT_LT(bottom, 0) << "nobody looks from underneath";
    const double expected = length * (2 * half * (eaves - bottom) + half * (ridge - eaves));
    // Ground and wall meet in a seed: the ground's pieces reach into the house by up to two seeds.
    EXPECT_LE(volume(mesh, 0), expected * 1.0001);
    EXPECT_GE(volume(mesh, 0), expected * 0.9) << angle;
    EXPECT_NEAR(mesh.bounds(0).upper.z, ridge, 0.02) << angle;
  }
}

TEST(ShrinkPlanes, EveryWindowLiesInSealedSpaceOnEachKindOfPlot) {
  test::Looked looked;
  for (int plot = 0; plot < static_cast<int>(Plot::count); ++plot) {
    for (const uint32_t seed : {1u, 3u}) {
      SCOPED_TRACE(test::plot_name(static_cast<Plot>(plot)));
      const auto here = test::expect_conservative(test::one_plot(static_cast<Plot>(plot), seed),
                                                  PlanesShrinker(), request_of({0.6, 0.6, 0.4}));
      looked.bodies += here.bodies, looked.points += here.points;
    }
  }
  EXPECT_GT(looked.bodies, 60u);
  EXPECT_GT(looked.points, 2000u);
}

TEST(ShrinkPlanes, EveryWindowLiesInSealedSpaceInMixedCities) {
  test::Looked looked;
  for (uint32_t seed = 0; seed < 4; ++seed) {
    ShrinkRequest request = request_of({0.7, 0.7, 0.4});
    request.half_extents_m.push_back({1.2, 1.2, 0.4});
    const auto here = test::expect_conservative(test::random_city(seed), PlanesShrinker(), request);
    looked.bodies += here.bodies, looked.points += here.points;
  }
  EXPECT_GT(looked.bodies, 60u);
}

TEST(ShrinkPlanes, RowHousesAreErodedTogether) {
  Mesh row;
  row.ground(-8, -8, 48, 20, 0);
  for (int house = 0; house < 10; ++house) {
    const auto x = static_cast<float>(house) * 4;
    Mesh alone;
    alone.ground(-8, -8, 48, 20, 0);
    alone.object();
    alone.box({{x, 0, 0}, {x + 4, 9, 8}});
    const SealedBlock block = make_sealed_block(alone.scene, 0.125);
    EXPECT_EQ(first_ring(PlanesShrinker().shrink(block, request_of({2, 2, 0.5}))).bodies(), 0u);
    row.object();
    row.box({{x, 0, 0}, {x + 4, 9, 8}});
  }
  const auto windows = PlanesShrinker().shrink(make_sealed_block(row.scene, 0.125), request_of({2, 2, 0.5}));
  const OccluderMesh& mesh = first_ring(windows);
  ASSERT_GE(mesh.bodies(), 1u) << "ten houses, one body";
  EXPECT_EQ(test::faces_of(mesh, 0).size(), 6u);
  EXPECT_LE(mesh.triangles(), 48u) << "and little for what it lost at the foot of the walls";
  const Box box = mesh.bounds(0);
  const double w = 2 + windows[0].rings[0].h_m;
  EXPECT_NEAR(box.upper.x - box.lower.x, 40 - 2 * w, 4 * 0.125);
  EXPECT_NEAR(box.upper.y - box.lower.y, 9 - 2 * w, 4 * 0.125);
}

TEST(ShrinkPlanes, OneBodyServesAllRings) {
  const SealedBlock block = make_sealed_block(gable_house(0.4).scene, 0.125);
  const auto windows = PlanesShrinker().shrink(block, request_of({1, 1, 0.5}));
  ASSERT_GE(windows[0].rings.size(), 3u);
  double last = 1e30;
  for (const OccluderRing& ring : windows[0].rings) {
    const double here = volume(ring.occluders);
    EXPECT_LT(here, last) << "h " << ring.h_m;
    last = here;
  }
  EXPECT_GT(volume(windows[0].rings[1].occluders), 0);
}

TEST(ShrinkPlanes, GivesTheSameBytesTwice) {
  const SealedBlock block = make_sealed_block(test::random_city(7), 0.25);
  const auto a = PlanesShrinker().shrink(block, request_of({0.7, 0.7, 0.4}));
  const auto b = PlanesShrinker().shrink(block, request_of({0.7, 0.7, 0.4}));
  const OccluderMesh &m = first_ring(a), &n = first_ring(b);
  ASSERT_EQ(m.corners.size(), n.corners.size());
  ASSERT_GT(m.corners.size(), 0u);
  EXPECT_EQ(std::memcmp(m.corners.data(), n.corners.data(), m.corners.size() * sizeof(glm::vec3)), 0);
  EXPECT_EQ(m.face_begin, n.face_begin);
  EXPECT_EQ(m.body_begin, n.body_begin);
}

TEST(ShrinkPlanes, NothingButGroundGivesNothing) {
  Mesh mesh;
  mesh.ground(-10, -10, 10, 10, 0);
  EXPECT_EQ(first_ring(PlanesShrinker().shrink(make_sealed_block(mesh.scene, 0.25), request_of({1, 1, 0.5})))
                .bodies(),
            0u);
}

}  // namespace
}  // namespace veduta
