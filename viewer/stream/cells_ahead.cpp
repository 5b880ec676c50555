#include "viewer/stream/cells_ahead.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

namespace veduta {
namespace {

constexpr float stray_m_s = 3;   ///< how fast an eye leaves its way: a turn, or a start from standing
constexpr float corridor_m = 4;  ///< to either side of the way; where it begins, as far as it strays
constexpr float step_m = 4;      ///< along the way
constexpr size_t most_steps = 64;
constexpr float touching_m = 0.01f;  ///< cells that share a face touch, whatever the rounding

Box around(const glm::vec3& point, float reach_m) {
  return {point - reach_m, point + reach_m};
}

}  // namespace

std::vector<CellAhead> cells_ahead(const PvsIndex& index, const Gaze& gaze, size_t most) {
  const float way_m = glm::length(gaze.velocity_m_s) * ahead_s;
  const size_t steps = way_m < step_m * most_steps ? static_cast<size_t>(way_m / step_m) + 1 : most_steps;
  const auto time_s = [&](size_t step) {
    return ahead_s * static_cast<float>(step) / static_cast<float>(steps);
  };

  std::vector<uint32_t> cells;
  const auto add = [&](const Box& box) {
    const std::vector<uint32_t> touched = index.grid.touching(index.cells, box);
    cells.insert(cells.end(), touched.begin(), touched.end());
  };
  const int64_t own = index.find_cell(gaze.position_m);
  if (own >= 0) {
    const Box& cell = index.cells[static_cast<size_t>(own)];
    add({cell.lower - touching_m, cell.upper + touching_m});
  }
  add(around(gaze.position_m, stray_m_s * ahead_s));
  for (size_t step = 1; step <= steps; ++step)
    add(around(gaze.position_m + gaze.velocity_m_s * time_s(step), corridor_m));
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());

  std::vector<CellAhead> ahead;
  ahead.reserve(cells.size());
  for (uint32_t c : cells) {
    CellAhead cell{c, std::numeric_limits<float>::infinity()};
    for (size_t step = 0; step <= steps; ++step) {
      const float t = time_s(step);
      const glm::vec3 eye = gaze.position_m + gaze.velocity_m_s * t;
      const glm::vec3 nearest = glm::clamp(eye, index.cells[c].lower, index.cells[c].upper);
      cell.in_s = std::min(cell.in_s, t + glm::distance(eye, nearest) / stray_m_s);
    }
    ahead.push_back(cell);
  }
  std::stable_sort(ahead.begin(), ahead.end(),
                   [](const CellAhead& a, const CellAhead& b) { return a.in_s < b.in_s; });
  if (ahead.size() > most) ahead.resize(most);
  return ahead;
}

}  // namespace veduta
