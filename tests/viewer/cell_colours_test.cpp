#include "viewer/cell_colours.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace veduta {
namespace {

/// A row of 100 cells of 1 m; cell i lists i + 1 objects and took 10 i ms.
PvsIndex a_row_of_cells() {
  PvsIndex index;
  uint64_t entries = 0;
  for (uint32_t i = 0; i < 100; ++i) {
    const auto x = static_cast<float>(i);
    index.cells.push_back({{x, 0, 0}, {x + 1, 1, 1}});
    index.cell_row.push_back(i);
    index.bake_us.push_back(10000 * i);
    index.row_begin.push_back(entries);
    entries += i + 1;
  }
  index.row_begin.push_back(entries);
  return index;
}

float brightness(const glm::vec3& c) {
  return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z;
}

TEST(CellColours, TheScaleRisesInBrightnessAndEndsWhereViridisDoes) {
  for (int i = 1; i <= 20; ++i)
    EXPECT_GT(brightness(scale_colour(static_cast<float>(i) / 20)),
              brightness(scale_colour(static_cast<float>(i - 1) / 20)));
  // sRGB 68, 1, 84 and 253, 231, 37, here linear.
  EXPECT_LT(glm::distance(scale_colour(0), glm::vec3(0.058f, 0.0003f, 0.089f)), 0.02f);
  EXPECT_LT(glm::distance(scale_colour(1), glm::vec3(0.982f, 0.799f, 0.018f)), 0.04f);
  EXPECT_EQ(scale_colour(-3), scale_colour(0));
  EXPECT_EQ(scale_colour(7), scale_colour(1));
}

TEST(CellColours, GoFromTheFewestToTheMost) {
  const PvsIndex index = a_row_of_cells();
  const CellScale size = cell_scale(index, CellColour::pvs_size);
  EXPECT_NEAR(size.low, 2, 1);
  EXPECT_NEAR(size.high, 98, 1);
  EXPECT_EQ(cell_colour(index, size, 0), scale_colour(0));
  EXPECT_EQ(cell_colour(index, size, 99), scale_colour(1));
  const CellScale time = cell_scale(index, CellColour::bake_time);
  EXPECT_NEAR(time.high, 970, 15);
  EXPECT_STREQ(time.unit, "ms");
  EXPECT_EQ(cell_scale(index, CellColour::worker).by, CellColour::off) << "the file does not say";
  EXPECT_EQ(cell_scale(PvsIndex{}, CellColour::pvs_size).by, CellColour::off) << "there are no cells";
}

TEST(CellColours, OfWorkersAreToldApart) {
  PvsIndex index = a_row_of_cells();
  for (uint32_t i = 0; i < 100; ++i) index.cell_worker.push_back(i % 8);
  index.workers.resize(8);
  const CellScale scale = cell_scale(index, CellColour::worker);
  ASSERT_EQ(scale.by, CellColour::worker);
  for (uint32_t a = 0; a < 8; ++a) {
    EXPECT_EQ(cell_colour(index, scale, a), cell_colour(index, scale, a + 8));
    for (uint32_t b = 0; b < a; ++b)
      EXPECT_GT(glm::distance(cell_colour(index, scale, a), cell_colour(index, scale, b)), 0.1f) << a << b;
  }
}

TEST(CellColours, TheNearestCells) {
  const PvsIndex index = a_row_of_cells();
  EXPECT_EQ(cells_near(index, {50.5f, 0.5f, 0.5f}, 10, 3).front(), 50u);
  EXPECT_EQ(cells_near(index, {50.5f, 0.5f, 0.5f}, 10, 3).size(), 3u);
  EXPECT_EQ(cells_near(index, {50.5f, 0.5f, 0.5f}, 1.6f, 1000).size(), 5u) << "two on either side";
  EXPECT_TRUE(cells_near(index, {50, 0, 500}, 10, 3).empty());
}

}  // namespace
}  // namespace veduta
