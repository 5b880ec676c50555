#include "worker/cell_windows.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace veduta {
namespace {

constexpr double rounding_m = 1e-3;  // half a float's step is less up to 16 km from the origin

}  // namespace

int size_classes(const Settings& settings) {
  if (settings.navigation.mode != "fly") return 1;
  return std::bit_width(static_cast<unsigned>(settings.cells.largest));
}

int size_class_of(const Settings& settings, const Box& cell) {
  const double edge = cell.upper.x - cell.lower.x;
  const auto size_class = static_cast<int>(std::lround(std::log2(edge / settings.cells.size_m)));
  return std::clamp(size_class, 0, size_classes(settings) - 1);
}

glm::dvec3 part_half_extent(const Settings& settings, int size_class, int parts) {
  const double margin = settings.stereo.eye_margin_m + rounding_m;
  const double horizontal = std::ldexp(settings.cells.size_m, size_class) / (2.0 * parts) + margin;
  return {horizontal, horizontal, std::ldexp(settings.cells.height_m, size_class) / 2 + margin};
}

glm::dvec3 window_around(const Settings& settings, const Box& eyes) {
  // Half the rounding: bounds of a whole part, rounded themselves, must fit into the window made for it.
  return glm::dvec3(eyes.half_extent()) + settings.stereo.eye_margin_m + 0.5 * rounding_m;
}

std::vector<glm::dvec3> window_half_extents(const Settings& settings) {
  std::vector<glm::dvec3> windows;
  for (int size_class = 0; size_class < size_classes(settings); ++size_class) {
    for (int parts = settings.occlusion.subdivide; parts >= 1; parts /= 2)
      windows.push_back(part_half_extent(settings, size_class, parts));
  }
  return windows;
}

}  // namespace veduta
