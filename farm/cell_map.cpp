#include "farm/cell_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "scene/markup.h"

namespace veduta {
namespace {

constexpr double longest_px = 840, margin_px = 20, title_px = 44, legend_px = 40;
constexpr size_t most_squares = 160;  // along an edge: a browser shows 25,000 rectangles at once

constexpr const char* waiting_colour = "#dcdcdc";
constexpr const char* in_hands_colour = "#f0a202";
constexpr const char* all_visible_colour = "#c81d25";
constexpr std::array baked_rgb{14, 112, 105}, waiting_rgb{220, 220, 220};

struct Square {
  Box bounds;
  uint64_t cells = 0, baked = 0, in_hands = 0, all_visible = 0;
};

std::string colour_of(const Square& square) {
  if (square.all_visible > 0) return all_visible_colour;
  if (square.in_hands > 0) return in_hands_colour;
  const double share = static_cast<double>(square.baked) / static_cast<double>(square.cells);
  std::array<int, 3> rgb;
  for (size_t c = 0; c < 3; ++c)
    rgb[c] = static_cast<int>(std::lround(waiting_rgb[c] + share * (baked_rgb[c] - waiting_rgb[c])));
  return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]);
}

Box bounds_of(const std::vector<Box>& cells) {
  Box bounds = cells.front();
  for (const Box& cell : cells)
    bounds.lower = glm::min(bounds.lower, cell.lower), bounds.upper = glm::max(bounds.upper, cell.upper);
  return bounds;
}

/// Cells by the square of the plan that their middle lies in. A square is as large as what is drawn of it.
std::vector<Square> squares_of(const std::vector<Box>& cells, const std::vector<CellProgress>& progress,
                               const Box& bounds) {
  const glm::vec3 extent = bounds.upper - bounds.lower;
  float edge = std::max(extent.x, extent.y) / static_cast<float>(most_squares);
  for (const Box& cell : cells) edge = std::max(edge, cell.upper.x - cell.lower.x);
  std::map<std::pair<int, int>, Square> squares;
  for (size_t c = 0; c < cells.size(); ++c) {
    const glm::vec3 place = (cells[c].center() - bounds.lower) / edge;
    auto [found, first] = squares.try_emplace({static_cast<int>(place.y), static_cast<int>(place.x)});
    Square& square = found->second;
    square.bounds = first ? cells[c] : bounds_of({square.bounds, cells[c]});
    ++square.cells;
    square.baked += progress[c] == CellProgress::baked;
    square.in_hands += progress[c] == CellProgress::in_hands;
    square.all_visible += progress[c] == CellProgress::all_visible;
  }
  std::vector<Square> all;
  for (auto& [place, square] : squares) all.push_back(square);
  return all;
}

}  // namespace

std::string cell_map_svg(const std::vector<Box>& cells, const std::vector<CellProgress>& progress,
                         const std::string& title) {
  const Box bounds = cells.empty() ? Box{{0, 0, 0}, {1, 1, 1}} : bounds_of(cells);
  const glm::vec3 extent = bounds.upper - bounds.lower;
  const double px_per_m = longest_px / std::max(extent.x, extent.y);
  const double height = px_per_m * extent.y, width = std::max(px_per_m * extent.x, 560.0);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\" font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"100%\" height=\"100%\" "
      "fill=\"#ffffff\"/>\n<text x=\"{2:.0f}\" y=\"28\" font-weight=\"bold\" "
      "fill=\"#222\">{3}</text>\n<g stroke=\"#ffffff\" stroke-width=\"0.5\">\n",
      width + 2 * margin_px, height + title_px + legend_px + margin_px, margin_px, escaped(title));
  for (const Square& square : squares_of(cells, progress, bounds))
    svg += fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"/>\n",
                       margin_px + px_per_m * (square.bounds.lower.x - bounds.lower.x),
                       title_px + px_per_m * (bounds.upper.y - square.bounds.upper.y),
                       px_per_m * (square.bounds.upper.x - square.bounds.lower.x),
                       px_per_m * (square.bounds.upper.y - square.bounds.lower.y), colour_of(square));
  svg += "</g>\n";
  const std::array<std::pair<const char*, const char*>, 4> legend{
      {{"#0e7069", "baked"},
       {in_hands_colour, "in hands"},
       {waiting_colour, "waiting"},
       {all_visible_colour, "recorded all visible"}}};
  double x = margin_px;
  for (const auto& [colour, name] : legend) {
    const double y = title_px + height + 16;
    svg += fmt::format(
        "<rect x=\"{:.0f}\" y=\"{:.0f}\" width=\"14\" height=\"14\" fill=\"{}\"/><text x=\"{:.0f}\" "
        "y=\"{:.0f}\" "
        "fill=\"#222\">{}</text>\n",
        x, y, colour, x + 20, y + 12, name);
    x += 110;
  }
  return svg + "</svg>\n";
}

}  // namespace veduta
