#include "viewer/window/legend.h"

#include <fmt/format.h>

#include "scene/text.h"

namespace veduta {
namespace {

constexpr int scale_steps = 5;
constexpr size_t workers_shown = 8;
const glm::vec3 no_colour{0.1f};

std::vector<LegendEntry> workers(const PvsIndex& index) {
  std::vector<LegendEntry> entries;
  for (uint32_t worker = 0; worker < index.workers.size() && worker < workers_shown; ++worker)
    entries.push_back({distinct_colour(worker), printable(index.workers[worker], 40)});
  if (index.workers.size() > workers_shown)
    entries.push_back({no_colour, fmt::format("and {} more", index.workers.size() - workers_shown)});
  return entries;
}

std::string number(float value, const char* unit) {
  // Two digits of what is small, and no more of a number of objects than there are.
  const bool whole = value >= 10 || std::string_view(unit) == "objects";
  return whole ? fmt::format("{:.0f} {}", value, unit) : fmt::format("{:.2g} {}", value, unit);
}

}  // namespace

std::vector<LegendEntry> map_legend() {
  // As the map's shader has them.
  return {{{0.62f, 0.05f, 0.04f}, "completely visible"},
          {{0.05f, 0.14f, 0.66f}, "partially visible"},
          {{0.75f, 0.58f, 0.06f}, "invisible"}};
}

std::vector<LegendEntry> cell_legend(const PvsIndex& index, CellColour by, const CellScale& scale) {
  if (by == CellColour::off) return {};
  if (scale.by == CellColour::off) return {{no_colour, "the file does not say"}};
  if (scale.by == CellColour::worker) return workers(index);
  if (!(scale.high > scale.low)) return {{scale_colour(0), number(scale.low, scale.unit)}};
  std::vector<LegendEntry> entries;
  for (int step = 0; step < scale_steps; ++step) {
    const float part = static_cast<float>(step) / (scale_steps - 1);
    entries.push_back({scale_colour(part), number(scale.low + part * (scale.high - scale.low), scale.unit)});
  }
  entries.front().text += " or less";
  entries.back().text += " or more";
  return entries;
}

}  // namespace veduta
