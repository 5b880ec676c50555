#include "viewer/draw/visible_objects.h"

#include <toml++/toml.h>
#include <algorithm>
#include <array>

#include "pvs/unite_rows.h"

namespace veduta {
namespace {

// By ascending number, each once.
std::vector<int64_t> cells_of_eyes(const PvsIndex& index, const Pose& pose, const ViewState& state,
                                   double eye_margin_m) {
  if (state.stereo == StereoMode::mono || state.optics.iod_m / 2.0 <= eye_margin_m)
    return {index.find_cell(pose.position_m)};
  std::vector<int64_t> cells;
  for (Eye eye : eyes(state.stereo))
    cells.push_back(index.find_cell(eye_view(pose, state.optics, eye).position_m));
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

void take_whole_buildings(std::vector<PvsEntry>& entries) {
  for (PvsEntry& entry : entries) entry.index = completely_visible;
  entries.erase(std::unique(entries.begin(), entries.end()), entries.end());
}

}  // namespace

double baked_eye_margin_m(const std::string& config) {
  try {
    return std::max(0.0, toml::parse(config)["stereo"]["eye_margin"].value_or(0.0));
  } catch (const toml::parse_error&) {
    return 0;  // a file of somebody else's making: both eyes are then looked up, which always holds
  }
}

VisibleObjects visible_objects(const PvsIndex& index, const RowOf& row, const ViewState& state,
                               double eye_margin_m) {
  const Pose& pose = state.frozen ? *state.frozen : state.pose;
  VisibleObjects visible;
  visible.cell = index.find_cell(pose.position_m);
  const std::vector<int64_t> cells = cells_of_eyes(index, pose, state, eye_margin_m);
  visible.everything = state.pvs == PvsUse::off || cells.front() < 0;
  if (visible.everything) return visible;

  static const PvsRow nothing;
  std::array<const PvsRow*, 2> rows{&nothing, &nothing};
  for (size_t i = 0; i < cells.size(); ++i) rows[i] = row(static_cast<uint32_t>(cells[i]));
  visible.waiting = !rows[0] || !rows[1];
  visible.everything = visible.waiting;
  if (visible.everything) return visible;
  unite_rows(*rows[0], *rows[1], visible.entries);
  if (state.pvs == PvsUse::buildings) take_whole_buildings(visible.entries);
  return visible;
}

}  // namespace veduta
