#include "viewer/window/legend.h"

#include <gtest/gtest.h>

namespace veduta {
namespace {

// 101 cells: of cell i a row of i + 10 objects, baked in i ms.
PvsIndex hundred_cells() {
  PvsIndex index;
  index.row_begin = {0};
  for (uint32_t i = 0; i <= 100; ++i) {
    index.cells.push_back({{0, 0, 0}, {1, 1, 1}});
    index.cell_row.push_back(i);
    index.bake_us.push_back(1000 * i);
    index.row_begin.push_back(index.row_begin.back() + i + 10);
  }
  return index;
}

std::vector<LegendEntry> legend(const PvsIndex& index, CellColour by) {
  return cell_legend(index, by, cell_scale(index, by));
}

TEST(Legend, TheMapIsRedBlueAndYellow) {
  const std::vector<LegendEntry> entries = map_legend();
  ASSERT_EQ(entries.size(), 3u);
  const auto [red, blue, yellow] = std::tuple(entries[0].colour, entries[1].colour, entries[2].colour);
  EXPECT_EQ(entries[0].text, "completely visible");
  EXPECT_GT(red.r, 4 * std::max(red.g, red.b));
  EXPECT_EQ(entries[1].text, "partially visible");
  EXPECT_GT(blue.b, 2 * std::max(blue.r, blue.g));
  EXPECT_EQ(entries[2].text, "invisible");
  EXPECT_GT(std::min(yellow.r, yellow.g), 4 * yellow.b);
}

TEST(Legend, AScaleHasNumbersUnitsAndTheColoursOfTheCells) {
  const PvsIndex index = hundred_cells();
  const CellScale scale = cell_scale(index, CellColour::pvs_size);
  const std::vector<LegendEntry> sizes = legend(index, CellColour::pvs_size);
  ASSERT_EQ(sizes.size(), 5u);
  EXPECT_EQ(sizes.front().text, "12 objects or less");
  EXPECT_EQ(sizes[2].text, "60 objects");
  EXPECT_EQ(sizes.back().text, "108 objects or more");
  EXPECT_EQ(sizes.front().colour, cell_colour(index, scale, 2));
  EXPECT_EQ(sizes[2].colour, cell_colour(index, scale, 50));
  EXPECT_EQ(sizes.back().colour, cell_colour(index, scale, 100));
  EXPECT_NE(sizes[1].colour, sizes[2].colour);

  const std::vector<LegendEntry> times = legend(index, CellColour::bake_time);
  EXPECT_EQ(times.front().text, "2 ms or less");
  EXPECT_EQ(times[1].text, "26 ms");
}

TEST(Legend, CellsThatAreAllAlikeHaveOneEntry) {
  PvsIndex index = hundred_cells();
  index.bake_us.assign(index.cells.size(), 1530);
  ASSERT_EQ(legend(index, CellColour::bake_time).size(), 1u);
  EXPECT_EQ(legend(index, CellColour::bake_time)[0].text, "1.5 ms");
}

TEST(Legend, WorkersHaveAColourEachAndPrintableNames) {
  PvsIndex index = hundred_cells();
  ASSERT_EQ(legend(index, CellColour::worker).size(), 1u);
  EXPECT_EQ(legend(index, CellColour::worker)[0].text, "the file does not say");
  for (int i = 0; i < 20; ++i) index.workers.push_back("host\n" + std::to_string(i));
  for (uint32_t cell = 0; cell < index.cells.size(); ++cell) index.cell_worker.push_back(cell % 20);
  const std::vector<LegendEntry> entries = legend(index, CellColour::worker);
  ASSERT_EQ(entries.size(), 9u);
  EXPECT_EQ(entries[1].text, "host?1");
  EXPECT_EQ(entries[1].colour, cell_colour(index, cell_scale(index, CellColour::worker), 21));
  EXPECT_EQ(entries[8].text, "and 12 more");
}

TEST(Legend, WithoutCellsThereIsNoScale) {
  EXPECT_EQ(legend({}, CellColour::pvs_size).size(), 1u);
  EXPECT_TRUE(legend(hundred_cells(), CellColour::off).empty());
}

}  // namespace
}  // namespace veduta
