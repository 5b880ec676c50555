#include "pvs/cell_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

namespace veduta {
namespace {

/// The obvious answer.
int64_t scan(const std::vector<Box>& cells, const glm::vec3& point) {
  for (size_t c = 0; c < cells.size(); ++c)
    if (cells[c].contains(point)) return static_cast<int64_t>(c);
  return -1;
}

std::vector<uint32_t> scan(const std::vector<Box>& cells, const Box& box) {
  std::vector<uint32_t> found;
  for (uint32_t c = 0; c < cells.size(); ++c) {
    const Box both{glm::max(cells[c].lower, box.lower), glm::min(cells[c].upper, box.upper)};
    if (!both.empty()) found.push_back(c);
  }
  return found;
}

void expect_same(const std::vector<Box>& cells, uint32_t seed, float range_m) {
  const CellGrid grid(cells);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(-range_m, range_m);
  for (int i = 0; i < 20000; ++i) {
    const glm::vec3 point{place(random), place(random), place(random) * 0.1f};
    ASSERT_EQ(grid.find(cells, point), scan(cells, point)) << point.x << ' ' << point.y << ' ' << point.z;
  }
  for (int i = 0; i < 2000; ++i) {
    const glm::vec3 lower{place(random), place(random), place(random) * 0.1f};
    const Box box{lower, lower + std::exp2(place(random) / range_m * 8)};
    ASSERT_EQ(grid.touching(cells, box), scan(cells, box));
  }
  // Corners lie on the faces that neighbours share.
  for (const Box& cell : cells)
    for (const glm::vec3& point : {cell.lower, cell.upper, cell.center()})
      ASSERT_EQ(grid.find(cells, point), scan(cells, point)) << point.x << ' ' << point.y << ' ' << point.z;
}

TEST(CellGrid, AgreesWithAScanOfEqualCells) {
  std::vector<Box> cells;
  for (int y = -10; y < 10; ++y)
    for (int x = -10; x < 10; ++x)
      if ((x + 3 * y) % 4 != 0)
        cells.push_back(
            {{10.0f * static_cast<float>(x), 10.0f * static_cast<float>(y), 0.1f * static_cast<float>(x)},
             {10.0f * static_cast<float>(x + 1), 10.0f * static_cast<float>(y + 1),
              0.1f * static_cast<float>(x) + 1}});
  expect_same(cells, 1, 120);
}

TEST(CellGrid, AgreesWithAScanOfALongRowInNoOrder) {
  std::vector<Box> cells;
  for (int x = -1500; x < 1500; ++x)
    cells.push_back({{static_cast<float>(x), -1500, 0}, {static_cast<float>(x + 1), 1500, 1}});
  std::shuffle(cells.begin(), cells.end(), std::mt19937(3));
  expect_same(cells, 4, 1600);
}

TEST(CellGrid, AgreesWithAScanOfOverlappingCellsOfManySizes) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> place(-100, 100);
  std::vector<Box> cells;
  for (int i = 0; i < 300; ++i) {
    const glm::vec3 lower{place(random), place(random), place(random) * 0.1f};
    const float edge = std::exp2(std::uniform_real_distribution<float>(-6, 6)(random));
    cells.push_back({lower, lower + edge});
  }
  cells.push_back({{-100000, -100000, -100}, {100000, 100000, 100}});  // a giant among dwarfs
  expect_same(cells, 3, 150);
}

TEST(CellGrid, FlatCellsAndNoCells) {
  EXPECT_EQ(CellGrid().find({}, {0, 0, 0}), -1);
  const std::vector<Box> cells{{{0, 0, 1}, {10, 10, 1}}, {{10, 0, 1}, {20, 10, 1}}};
  const CellGrid grid(cells);
  EXPECT_EQ(grid.find(cells, {5, 5, 1}), 0);
  EXPECT_EQ(grid.find(cells, {10, 5, 1}), 0);
  EXPECT_EQ(grid.find(cells, {15, 5, 1}), 1);
  EXPECT_EQ(grid.find(cells, {15, 5, 1.001f}), -1);
  EXPECT_EQ(grid.find(cells, {NAN, 5, 1}), -1);
  EXPECT_EQ(grid.touching(cells, {{10, 0, 0}, {10, 1, 1}}), (std::vector<uint32_t>{0, 1}));
  EXPECT_TRUE(grid.touching(cells, {{0, 0, 1.001f}, {20, 10, 2}}).empty());
  EXPECT_TRUE(grid.touching(cells, {{NAN, 0, 0}, {NAN, 1, 1}}).empty());
  EXPECT_TRUE(CellGrid().touching({}, {{0, 0, 0}, {1, 1, 1}}).empty());
}

/// About `count` cells of 10 m in the streets of a town with hills: a tenth of its columns, 1 m high, their
/// floors at any height. Shuffled.
std::vector<Box> hilly_streets(uint32_t count) {
  const auto side = static_cast<int>(std::sqrt(10.0 * count));
  std::vector<Box> cells;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      if (x % 20 != 0 && y % 20 != 0) continue;
      const float floor_m = 30 * std::sin(static_cast<float>(x) / 40) * std::cos(static_cast<float>(y) / 70);
      const glm::vec3 lower{10.0f * static_cast<float>(x), 10.0f * static_cast<float>(y), floor_m};
      cells.push_back({lower, lower + glm::vec3(10, 10, 1)});
    }
  std::shuffle(cells.begin(), cells.end(), std::mt19937(7));
  return cells;
}

/// Leaves of an octree with corners at multiples of `leaf_m`, small ones where `near` is.
void add_leaves(const glm::vec3& lower, float edge_m, float leaf_m, const glm::vec3& near,
                std::vector<Box>& cells) {
  const Box box{lower, lower + edge_m};
  if (edge_m <= leaf_m || glm::distance(box.center(), near) > 1.5f * edge_m) return cells.push_back(box);
  for (int child = 0; child < 8; ++child)
    add_leaves(lower + edge_m / 2 * glm::vec3(child & 1, (child >> 1) & 1, child >> 2), edge_m / 2, leaf_m,
               near, cells);
}

TEST(CellGrid, LooksAtAFewCellsHoweverManyThereAre) {
  for (const uint32_t count : {1000u, 10000u, 100000u}) {
    SCOPED_TRACE(count);
    const std::vector<Box> streets = hilly_streets(count);
    ASSERT_GT(streets.size(), 9 * count / 10);
    EXPECT_LE(CellGrid(streets).most_looked_at(), 10u);
    EXPECT_LE(CellGrid(streets).bytes(), 64 * streets.size());

    std::vector<Box> lattice;
    for (uint32_t c = 0; c < count; ++c) {
      const glm::vec3 lower{0.3f * static_cast<float>(c % 250), 0.3f * static_cast<float>(c / 250), 0};
      lattice.push_back({lower, lower + glm::vec3(0.3f, 0.3f, 1)});
    }
    EXPECT_LE(CellGrid(lattice).most_looked_at(), 9u) << "of 0.3 m, which is no number in binary";
    EXPECT_LE(CellGrid(lattice).bytes(), 64 * lattice.size());

    std::vector<Box> row;
    for (uint32_t c = 0; c < count; ++c) {
      const float x = 8.0f * static_cast<float>(c);
      row.push_back({{x, -40000, 0}, {x + 8, 40000, 1}});
    }
    EXPECT_LE(CellGrid(row).most_looked_at(), 1u);
    row.push_back({{1e9f, 1e9f, 1e9f}, {1e9f + 1024, 1e9f + 1024, 1e9f + 1024}});
    row.push_back({{-1e9f, 1e9f, 0}, {8 - 1e9f, 1e9f + 80000, 1}});
    EXPECT_LE(CellGrid(row).most_looked_at(), 9u) << "and two far away";
    EXPECT_LE(CellGrid(row).bytes(), 64 * row.size());
  }
}

TEST(CellGrid, LooksAtAFewLeavesOfAnOctree) {
  std::vector<Box> cells;
  add_leaves({-512, -512, -512}, 1024, 1, {33, 47, 12}, cells);
  ASSERT_GT(cells.size(), 800u);
  EXPECT_LE(CellGrid(cells).most_looked_at(), 20u);
  expect_same(cells, 5, 600);
}

TEST(CellGrid, AgreesWithAScanOfHillyStreets) {
  std::vector<Box> cells = hilly_streets(1000);
  for (Box& cell : cells) cell = {cell.lower - glm::vec3(500, 500, 0), cell.upper - glm::vec3(500, 500, 0)};
  expect_same(cells, 6, 600);
}

TEST(CellGrid, AgreesWithAScanOfSizesWithoutNumber) {
  std::mt19937 random(9);
  std::uniform_real_distribution<float> place(-100, 100), exponent(-9, 6);
  std::vector<Box> cells;
  for (int i = 0; i < 600; ++i) {
    const glm::vec3 lower{place(random), place(random), place(random) * 0.1f};
    const glm::vec3 edges{std::exp2(exponent(random)), std::exp2(exponent(random)),
                          std::exp2(exponent(random))};
    cells.push_back({lower, lower + edges});
  }
  expect_same(cells, 10, 150);
  EXPECT_LE(CellGrid(cells).bytes(), 600 * cells.size());
}

TEST(CellGrid, AgreesWithAScanAtTheEndsOfFloats) {
  constexpr float most = std::numeric_limits<float>::max(), least = std::numeric_limits<float>::denorm_min();
  const std::vector<Box> cells{{{-most, -most, -most}, {most, most, most}},
                               {{most, most, most}, {most, most, most}},
                               {{0, 0, 0}, {least, least, least}},
                               {{-least, 0, 0}, {0, least, 4}},
                               {{0, -most, 0}, {1, most, 0}},
                               {{-1, -1, -1}, {1, 1, 1}}};
  std::vector<float> values{0, -0.0f, least, -least, 1, -1, 4, most, -most, INFINITY, -INFINITY, NAN};
  for (size_t without = 0; without <= cells.size(); ++without) {
    std::vector<Box> some = cells;
    if (without < cells.size()) some.erase(some.begin() + static_cast<ptrdiff_t>(without));
    const CellGrid grid(some);
    for (const float x : values)
      for (const float y : values)
        for (const float z : values) {
          ASSERT_EQ(grid.find(some, {x, y, z}), scan(some, glm::vec3(x, y, z))) << x << ' ' << y << ' ' << z;
          const Box box{{x, y, z}, {most, 1, most}};
          if (x <= most && y <= 1 && z <= most) {
            ASSERT_EQ(grid.touching(some, box), scan(some, box));
          }
        }
  }
}

TEST(CellGrid, ManyCellsInOnePlaceTakeNoMoreMemory) {
  const std::vector<Box> cells(20000, Box{{1, 2, 3}, {4, 5, 6}});
  const CellGrid grid(cells);
  EXPECT_EQ(grid.find(cells, {4, 5, 6}), 0);
  EXPECT_EQ(grid.touching(cells, {{4, 4, 4}, {9, 9, 9}}).size(), cells.size());
  EXPECT_LE(grid.bytes(), 64 * cells.size());
}

}  // namespace
}  // namespace veduta
