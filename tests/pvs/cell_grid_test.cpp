#include "pvs/cell_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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

}  // namespace
}  // namespace veduta
