// The key cells.region: a box or a polygon.
#include <fmt/format.h>

#include "worker/settings_keys.h"

namespace veduta {
namespace {

/// A region as [x0, y0, x1, y1]: the corners of that box, counter-clockwise from the lower one.
std::vector<std::array<double, 2>> box_region(const toml::array& array, const Place& place) {
  std::array<double, 4> box{};
  for (size_t i = 0; i < 4; ++i) box[i] = finite_number(*array.get(i), place);
  if (!(box[0] < box[2] && box[1] < box[3]))
    place.refuse(array,
                 fmt::format("'{}' is empty; it must be [x0, y0, x1, y1] with x0 < x1, y0 < y1", place.key));
  return {{box[0], box[1]}, {box[2], box[1]}, {box[2], box[3]}, {box[0], box[3]}};
}

std::vector<std::array<double, 2>> polygon_region(const toml::array& array, const Place& place) {
  std::vector<std::array<double, 2>> corners;
  for (const toml::node& node : array) {
    const toml::array* corner = node.as_array();
    if (!corner || corner->size() != 2)
      place.refuse(node, fmt::format("'{}' must have two numbers [x, y] for each corner", place.key));
    corners.push_back({finite_number(*corner->get(0), place), finite_number(*corner->get(1), place)});
  }
  if (corners.size() < 3)
    place.refuse(array,
                 fmt::format("'{}' has {} corners; a polygon has at least 3", place.key, corners.size()));
  return corners;
}

std::string region_text(const std::vector<std::array<double, 2>>& c) {
  if (c.size() == 4 && c[0][1] == c[1][1] && c[1][0] == c[2][0] && c[2][1] == c[3][1] && c[3][0] == c[0][0] &&
      c[0][0] < c[2][0] && c[0][1] < c[2][1])
    return fmt::format("[{}, {}, {}, {}]", number_text(c[0][0]), number_text(c[0][1]), number_text(c[2][0]),
                       number_text(c[2][1]));
  std::string out;
  for (const auto& [x, y] : c)
    out += fmt::format("{}[{}, {}]", out.empty() ? "" : ", ", number_text(x), number_text(y));
  return "[" + out + "]";
}

}  // namespace

Key region_key() {
  return {"cells.region",
          "array of 4 numbers, or of corners [x, y]",
          "[x0, y0, x1, y1] with x0 < x1, y0 < y1; a polygon of 3 corners or more; []: everywhere",
          "where cells are made (by their centres), in the scene's CRS; never limits what is seen from them",
          [](Settings& s, const toml::node& node, const Place& place) {
            const toml::array* array = node.as_array();
            const bool corners = array && !array->empty() && array->get(0)->is_array();
            if (!array || (!array->empty() && !corners && array->size() != 4))
              place.refuse(node, fmt::format("'{}' must be four numbers [x0, y0, x1, y1] or a polygon "
                                             "[[x, y], [x, y], [x, y], ...]",
                                             place.key));
            s.cells.region.clear();
            if (!array->empty())
              s.cells.region = corners ? polygon_region(*array, place) : box_region(*array, place);
          },
          [](const Settings& s) { return region_text(s.cells.region); }};
}

}  // namespace veduta
