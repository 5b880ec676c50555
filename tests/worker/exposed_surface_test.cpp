#include "worker/exposed_surface.h"

#include <gtest/gtest.h>

#include <bit>
#include <glm/geometric.hpp>

#include "tests/worker/shrink_cities.h"
#include "worker/exposed_seeds.h"

namespace veduta {
namespace {

using test::Mesh;
using test::Random;

constexpr double seed_m = 0.25;

double area(const ExposedSurface& surface, size_t piece) {
  glm::dvec3 twice(0);
  const glm::dvec3 first = surface.corners[surface.begin[piece]];
  for (uint32_t c = surface.begin[piece] + 2; c < surface.begin[piece + 1]; ++c)
    twice += glm::cross(surface.corners[c - 1] - first, surface.corners[c] - first);
  return 0.5 * glm::length(twice);
}

/// The area of pieces whose normal is along an axis and that lie between two heights.
double area_facing(const ExposedSurface& surface, int axis, double low_m, double high_m) {
  double sum = 0;
  for (size_t p = 0; p < surface.size(); ++p) {
    if (std::abs(surface.normal[p][axis]) < 0.99) continue;
    double z = 0;
    for (uint32_t c = surface.begin[p]; c < surface.begin[p + 1]; ++c) z += surface.corners[c].z;
    z /= surface.begin[p + 1] - surface.begin[p];
    if (z > low_m && z < high_m) sum += area(surface, p);
  }
  return sum;
}

bool holds(const ExposedSurface& surface, const glm::dvec3& p) {
  for (size_t piece = 0; piece < surface.size(); ++piece) {
    const uint32_t begin = surface.begin[piece], end = surface.begin[piece + 1];
    const glm::dvec3 n = surface.normal[piece];
    if (std::abs(glm::dot(n, p - surface.corners[begin])) > 1e-5) continue;
    bool left = true, right = true;
    for (uint32_t c = begin; c < end; ++c) {
      const glm::dvec3 a = surface.corners[c], b = surface.corners[c + 1 < end ? c + 1 : begin];
      const double side = glm::dot(n, glm::cross(b - a, p - a)) / std::max(glm::length(b - a), 1e-9);
      left = left && side > -1e-5, right = right && side < 1e-5;
    }
    if (left || right) return true;
  }
  return false;
}

TEST(ExposedSeeds, AreTouchedOnesBesideReachedOnes) {
  for (uint32_t seed = 0; seed < 3; ++seed) {
    const SealedBlock block = make_sealed_block(test::random_city(seed), seed_m);
    const SeedRegion& region = block.region;
    const GridFrame fine = region.seed_frame();
    const auto in = [&](const BrickGrid& bricks, int i, int j, int k) {
      return region.occupied->get(i / 4, j / 4, k / 4) &&
             (bricks.at(i / 4, j / 4, k / 4) & brick_run(i % 4, j % 4, k % 4, k % 4)) != 0;
    };
    const auto open = [&](int i, int j, int k) {
      if (i < 0 || j < 0 || k < 0 || i >= fine.nx || j >= fine.ny || k >= fine.nz) return false;
      return region.free.get(i / 4, j / 4, k / 4) || in(region.reached, i, j, k);
    };
    const BrickGrid exposed = exposed_seeds(region);
    size_t count = 0;
    test::each_voxel(fine, [&](int i, int j, int k) {
      if (!region.occupied->get(i / 4, j / 4, k / 4)) return;
      bool beside = false;
      for (int n = 0; n < 27; ++n) beside = beside || open(i + n % 3 - 1, j + n / 3 % 3 - 1, k + n / 9 - 1);
      const bool expected = beside && in(region.touched, i, j, k);
      ASSERT_EQ(in(exposed, i, j, k), expected) << i << ' ' << j << ' ' << k;
      count += expected;
    });
    EXPECT_GT(count, 1000u);
  }
}

TEST(ExposedSurface, IsTheOutsideOfAHouseAndNotItsFloor) {
  Mesh mesh;
  mesh.ground(-6, -6, 14, 12, 0);
  mesh.object();
  mesh.box({{0, 0, 0}, {8.1f, 6.2f, 5.3f}});
  mesh.box({{2, 2, 0}, {4, 4, 3}});  // a cupboard: nobody sees it
  const ExposedSurface surface = exposed_surface(make_sealed_block(mesh.scene, seed_m));
  EXPECT_NEAR(area_facing(surface, 2, 5, 6), 8.1 * 6.2, 1e-3) << "roof";
  EXPECT_NEAR(area_facing(surface, 0, 0, 6), 2 * 6.2 * 5.3, 0.02) << "two walls";
  EXPECT_NEAR(area_facing(surface, 1, 0, 6), 2 * 8.1 * 5.3, 0.02) << "two walls";
  const double outside = 20 * 18 - 8.1 * 6.2, border = 2 * (8.1 + 6.2) * 2 * seed_m;
  const double ground = area_facing(surface, 2, -1, 1);
  EXPECT_GE(ground, outside - 1e-3);
  EXPECT_LE(ground, outside + border) << "two seeds under the walls";
}

TEST(ExposedSurface, OfAPartyWallIsWhatStandsAboveTheNeighbour) {
  Mesh mesh;
  mesh.ground(-6, -6, 18, 12, 0);
  mesh.object();
  mesh.box({{0, 0, 0}, {6.1f, 6.2f, 9.3f}});
  mesh.object();
  mesh.box({{6.1f, 0, 0}, {12, 6.2f, 5.1f}});
  const ExposedSurface surface = exposed_surface(make_sealed_block(mesh.scene, seed_m));
  double party = 0, lowest = 100;
  for (size_t p = 0; p < surface.size(); ++p) {
    const glm::dvec3 at = surface.corners[surface.begin[p]];
    if (std::abs(surface.normal[p].x) < 0.99 || std::abs(at.x - 6.1) > 0.01) continue;
    party += area(surface, p);
    for (uint32_t c = surface.begin[p]; c < surface.begin[p + 1]; ++c) {
      // Beside the ends of the wall the fill is near as well.
      if (surface.corners[c].y > 1 && surface.corners[c].y < 5)
        lowest = std::min(lowest, surface.corners[c].z);
    }
  }
  EXPECT_GE(party, 6.2 * (9.3 - 5.1) - 1e-3);
  EXPECT_LE(party, 6.2 * (9.3 - 5.1 + 2 * seed_m) + 2 * (2 * 5.1 * 2 * seed_m))
      << "both houses have a wall here";
  EXPECT_GE(lowest, 5.1 - 2 * seed_m);
}

TEST(ExposedSurface, HoldsEveryPointOfATriangleInAnExposedSeed) {
  Random random(5);
  size_t inside = 0;
  for (uint32_t city = 0; city < 3; ++city) {
    const SealedBlock block = make_sealed_block(test::random_city(city), seed_m);
    const GridFrame fine = block.region.seed_frame();
    const BrickGrid exposed = exposed_seeds(block.region);
    const ExposedSurface surface = exposed_surface(block);
    for (int n = 0; n < 1500; ++n) {
      const auto& corner =
          block.triangles[random.integer(0, static_cast<int>(block.triangles.size()) - 1)].corner;
      if (glm::length(glm::cross(corner[1] - corner[0], corner[2] - corner[0])) == 0) continue;
      double a = random.real(0, 1), b = random.real(0, 1);
      if (a + b > 1) a = 1 - a, b = 1 - b;
      const glm::dvec3 c0(corner[0]),
          p = c0 + a * (glm::dvec3(corner[1]) - c0) + b * (glm::dvec3(corner[2]) - c0);
      const int i = fine.column_x(p.x), j = fine.column_y(p.y), k = fine.layer(p.z);
      if (!block.region.occupied->get(i / 4, j / 4, k / 4)) continue;
      if ((exposed.at(i / 4, j / 4, k / 4) & brick_run(i % 4, j % 4, k % 4, k % 4)) == 0) continue;
      ++inside;
      EXPECT_TRUE(holds(surface, p)) << p.x << ' ' << p.y << ' ' << p.z;
    }
  }
  EXPECT_GT(inside, 1000u);
}

TEST(ExposedSurface, KeepsAWholeWallWhole) {
  Mesh mesh;
  mesh.ground(-6, -6, 14, 12, 0);
  mesh.object();
  mesh.box({{0.03f, 0.04f, 0}, {8.1f, 6.2f, 5.3f}});
  const SealedBlock block = make_sealed_block(mesh.scene, seed_m);
  size_t walls_and_roof = 0;
  const ExposedSurface surface = exposed_surface(block);
  for (size_t p = 0; p < surface.size(); ++p) {
    double top = -1;
    for (uint32_t c = surface.begin[p]; c < surface.begin[p + 1]; ++c)
      top = std::max(top, surface.corners[c].z);
    walls_and_roof += top > 0.5;
  }
  EXPECT_EQ(walls_and_roof, 10u) << "two triangles a side";
}

}  // namespace
}  // namespace veduta
