#include "worker/cell_lattice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "tests/worker/mesh.h"

namespace veduta {
namespace {

using test::Random;

TEST(HilbertIndex, VisitsEveryPointOnceAndStepsToANeighbour) {
  for (const uint32_t order : {1u, 2u, 3u, 4u, 6u}) {
    const uint32_t edge = 1u << order;
    std::vector<std::pair<int, int>> place(size_t{edge} * edge, {-1, -1});
    for (uint32_t y = 0; y < edge; ++y) {
      for (uint32_t x = 0; x < edge; ++x) {
        const uint64_t index = hilbert_index(order, x, y);
        ASSERT_LT(index, place.size());
        ASSERT_EQ(place[index].first, -1) << "met twice";
        place[index] = {static_cast<int>(x), static_cast<int>(y)};
      }
    }
    for (size_t n = 1; n < place.size(); ++n) {
      const auto [x0, y0] = place[n - 1];
      const auto [x1, y1] = place[n];
      ASSERT_EQ(std::abs(x1 - x0) + std::abs(y1 - y0), 1) << "order " << order << ", step " << n;
    }
  }
}

TEST(PolygonContains, EvenOddWithItsBoundary) {
  const std::vector<glm::dvec2> l{{0, 0}, {10, 0}, {10, 4}, {4, 4}, {4, 10}, {0, 10}};
  for (const glm::dvec2 inside : {glm::dvec2{2, 8}, {8, 2}, {0, 0}, {5, 0}, {4, 7}, {10, 4}, {0, 5}, {4, 4}})
    EXPECT_TRUE(polygon_contains(l, inside)) << inside.x << ' ' << inside.y;
  for (const glm::dvec2 outside : {glm::dvec2{5, 5}, {-1, 0}, {11, 0}, {-1, 4}, {4.01, 7}, {12, 4}, {5, 10}})
    EXPECT_FALSE(polygon_contains(l, outside)) << outside.x << ' ' << outside.y;
  const std::vector<glm::dvec2> star{{0, 10}, {6, -8}, {-9.5, 3}, {9.5, 3}, {-6, -8}};  // crosses itself
  EXPECT_FALSE(polygon_contains(star, {0, 0})) << "twice around";
  EXPECT_TRUE(polygon_contains(star, {0, 8}));
}

TEST(PolygonContains, TurnsAndMirrorsWithItsPolygon) {
  Random random(2);
  int inside = 0;
  for (int round = 0; round < 2000; ++round) {
    std::vector<glm::dvec2> polygon, turned, mirrored, backwards;
    for (int n = random.integer(3, 7); n > 0; --n)
      polygon.emplace_back(random.integer(-4, 4), random.integer(-4, 4));
    for (const glm::dvec2& p : polygon) turned.emplace_back(-p.y, p.x), mirrored.emplace_back(-p.x, p.y);
    backwards.assign(polygon.rbegin(), polygon.rend());
    const glm::dvec2 p(0.5 * random.integer(-9, 9), 0.5 * random.integer(-9, 9));
    const bool expected = polygon_contains(polygon, p);
    inside += expected;
    ASSERT_EQ(polygon_contains(turned, {-p.y, p.x}), expected) << round;
    ASSERT_EQ(polygon_contains(mirrored, {-p.x, p.y}), expected) << round;
    ASSERT_EQ(polygon_contains(backwards, p), expected) << round;
  }
  EXPECT_GT(inside, 200);
}

/// Cells of an open space of nx by ny by nz cells from (i, j, k) on.
std::vector<LatticeCell> open_block(int i, int j, int k, int nx, int ny, int nz) {
  std::vector<LatticeCell> cells;
  for (int c = 0; c < nx * ny * nz; ++c) {
    LatticeCell cell;
    cell.i = i + c % nx, cell.j = j + c / nx % ny, cell.k = k + c / nx / ny;
    cell.open = true;
    const glm::vec3 lower(cell.i * 10, cell.j * 10, cell.k * 2);
    cell.box = {lower, lower + glm::vec3(10, 10, 2)};
    cells.push_back(cell);
  }
  return cells;
}

CellOptions flying() {
  CellOptions options;
  options.fly = true, options.height_m = 2, options.largest = 4;
  options.city.i0 = -400, options.city.j0 = -400, options.city.nx = options.city.ny = 800;
  return options;
}

TEST(UniteOpenCells, EightBecomeOneOnTheLattice) {
  const auto united = unite_open_cells(open_block(-4, 0, 4, 4, 4, 4), flying());
  ASSERT_EQ(united.size(), 1u);
  EXPECT_EQ(united[0].box, (Box{{-40, 0, 8}, {0, 40, 16}}));
  EXPECT_EQ(united[0].size_class, 2);
  EXPECT_EQ(unite_open_cells(open_block(-8, 0, 8, 8, 8, 8), flying()).size(), 8u) << "no larger than asked";
  EXPECT_EQ(unite_open_cells(open_block(1, 0, 0, 2, 2, 2), flying()).size(), 8u) << "across the lattice";
  auto walled = open_block(0, 0, 0, 4, 4, 4);
  walled[0].open = false;
  EXPECT_EQ(unite_open_cells(walled, flying()).size(), 7u + 8u);
}

TEST(UniteOpenCells, InStepsAsAtOnce) {
  Random random(8);
  for (int round = 0; round < 20; ++round) {
    std::vector<LatticeCell> all = open_block(-5, -3, 0, 10, 9, 8), left, right;
    for (LatticeCell& cell : all) cell.open = random.chance(0.97);
    for (const LatticeCell& cell : all) (cell.i < round % 7 - 3 ? left : right).push_back(cell);
    left = unite_open_cells(left, flying()), right = unite_open_cells(right, flying());
    right.insert(right.end(), left.begin(), left.end());
    const auto steps = in_hilbert_order(unite_open_cells(right, flying()), flying());
    EXPECT_EQ(steps, in_hilbert_order(unite_open_cells(all, flying()), flying())) << round;
    double volume = 0;
    for (const Box& box : steps) {
      const glm::dvec3 edge = box.upper - box.lower;
      volume += edge.x * edge.y * edge.z;
    }
    EXPECT_EQ(volume, 10 * 9 * 8 * 200.0);
  }
}

}  // namespace
}  // namespace veduta
