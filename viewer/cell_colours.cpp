#include "viewer/cell_colours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

namespace veduta {
namespace {

float linear(float srgb) {
  return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f);
}

glm::vec3 linear(const glm::vec3& srgb) {
  return {linear(srgb.x), linear(srgb.y), linear(srgb.z)};
}

float value_of(const PvsIndex& index, CellColour by, uint32_t cell) {
  return by == CellColour::bake_time ? static_cast<float>(index.bake_us[cell]) / 1000
                                     : static_cast<float>(index.row_size(cell));
}

}  // namespace

glm::vec3 scale_colour(float at) {
  static constexpr std::array<glm::vec3, 7> c{{{0.2777f, 0.0054f, 0.3341f},
                                               {0.1051f, 1.4046f, 1.3846f},
                                               {-0.3309f, 0.2148f, 0.0951f},
                                               {-4.6342f, -5.7991f, -19.3324f},
                                               {6.2283f, 14.1799f, 56.6906f},
                                               {4.7764f, -13.7451f, -65.3530f},
                                               {-5.4355f, 4.6459f, 26.3124f}}};
  const float t = std::clamp(at, 0.0f, 1.0f);
  glm::vec3 sum = c[6];
  for (size_t i = 6; i-- > 0;) sum = sum * t + c[i];
  return linear(glm::clamp(sum, 0.0f, 1.0f));
}

glm::vec3 distinct_colour(uint32_t n) {
  // Hues by the golden ratio: any first few of them lie far apart.
  const float hue = 6 * std::fmod(0.08f + 0.618034f * static_cast<float>(n), 1.0f);
  const auto ramp = [&](float shift) {
    return std::clamp(std::abs(std::fmod(hue + shift, 6.0f) - 3.0f) - 1.0f, 0.0f, 1.0f);
  };
  return linear(0.15f + 0.8f * glm::vec3(ramp(0), ramp(4), ramp(2)));
}

CellScale cell_scale(const PvsIndex& index, CellColour by) {
  if (by == CellColour::worker) return {index.cell_worker.empty() ? CellColour::off : by, 0, 0, ""};
  if (by == CellColour::off || index.cells.empty()) return {};
  std::vector<float> values(index.cells.size());
  for (uint32_t cell = 0; cell < values.size(); ++cell) values[cell] = value_of(index, by, cell);
  const auto at = [&](double share) {  // asked for in each frame: not sorted
    const auto found =
        values.begin() + static_cast<ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), found, values.end());
    return *found;
  };
  return {by, at(0.02), at(0.98), by == CellColour::bake_time ? "ms" : "objects"};
}

glm::vec3 cell_colour(const PvsIndex& index, const CellScale& scale, uint32_t cell) {
  if (scale.by == CellColour::worker) {
    const uint32_t worker = index.cell_worker[cell];
    return worker == no_worker ? glm::vec3(0.2f) : distinct_colour(worker);
  }
  const float range = std::max(scale.high - scale.low, 1e-6f);
  return scale_colour((value_of(index, scale.by, cell) - scale.low) / range);
}

std::vector<uint32_t> cells_near(const PvsIndex& index, const glm::vec3& point, float reach_m, size_t most) {
  std::vector<std::pair<float, uint32_t>> near;
  for (uint32_t cell = 0; cell < index.cells.size(); ++cell) {
    const Box& box = index.cells[cell];
    const float distance_m = glm::distance(point, glm::clamp(point, box.lower, box.upper));
    if (distance_m <= reach_m) near.emplace_back(distance_m, cell);
  }
  const size_t count = std::min(most, near.size());
  std::partial_sort(near.begin(), near.begin() + static_cast<ptrdiff_t>(count), near.end());
  std::vector<uint32_t> cells;
  for (size_t i = 0; i < count; ++i) cells.push_back(near[i].second);
  return cells;
}

}  // namespace veduta
