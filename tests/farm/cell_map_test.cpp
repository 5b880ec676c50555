#include "farm/cell_map.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace veduta {
namespace {

size_t count(const std::string& text, const std::string& part) {
  size_t found = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

std::vector<Box> street(int cells) {
  std::vector<Box> all;
  for (int i = 0; i < cells; ++i) {
    const auto x = static_cast<float>(10 * i);
    all.push_back({{x, 0, 0}, {x + 10, 10, 1}});
  }
  return all;
}

TEST(CellMap, ColoursSayWhatIsDone) {
  const std::string svg = cell_map_svg(street(5),
                                       {CellProgress::baked, CellProgress::baked, CellProgress::in_hands,
                                        CellProgress::waiting, CellProgress::all_visible},
                                       "a <street>");
  // Each colour once more in the legend.
  EXPECT_EQ(count(svg, "fill=\"#0e7069\""), 3u) << svg;
  EXPECT_EQ(count(svg, "fill=\"#f0a202\""), 2u) << svg;
  EXPECT_EQ(count(svg, "fill=\"#dcdcdc\""), 2u) << svg;
  EXPECT_EQ(count(svg, "fill=\"#c81d25\""), 2u) << svg;
  EXPECT_NE(svg.find("a &lt;street&gt;"), std::string::npos);
}

TEST(CellMap, NorthIsUp) {
  const std::string svg = cell_map_svg({{{0, 0, 0}, {10, 10, 1}}, {{0, 10, 0}, {10, 20, 1}}},
                                       {CellProgress::all_visible, CellProgress::in_hands}, "two");
  const auto y_of = [&](const std::string& colour) {
    const size_t end = svg.find("fill=\"" + colour);
    return std::stod(svg.substr(svg.rfind("y=\"", end) + 3));
  };
  EXPECT_GT(y_of("#c81d25"), y_of("#f0a202")) << svg;
}

TEST(CellMap, CellsOfALargeCityAreGathered) {
  std::vector<Box> cells;
  for (int j = 0; j < 500; ++j)
    for (int i = 0; i < 500; ++i) {
      const auto x = static_cast<float>(i), y = static_cast<float>(j);
      cells.push_back({{x, y, 0}, {x + 1, y + 1, 1}});
    }
  std::vector<CellProgress> progress(cells.size(), CellProgress::waiting);
  for (size_t c = 0; c < cells.size(); c += 2) progress[c] = CellProgress::baked;
  progress.back() = CellProgress::all_visible;
  const std::string svg = cell_map_svg(cells, progress, "large");
  EXPECT_LT(count(svg, "<rect"), 30'000u);
  EXPECT_EQ(count(svg, "fill=\"#c81d25\""), 2u) << "one cell of many is still seen";
  EXPECT_EQ(count(svg, "fill=\"#0e7069\""), 1u) << "nothing but the legend is all baked";
}

TEST(CellMap, NoCells) {
  EXPECT_EQ(count(cell_map_svg({}, {}, "nothing"), "<rect"), 5u);
}

}  // namespace
}  // namespace veduta
