#include "viewer/draw/visible_objects.h"

#include <toml++/toml.h>
#include <algorithm>
#include <array>
#include <utility>

namespace veduta {
namespace {

// What either of two entries of one object draws. Bytes of one kind fall together: the one that reaches
// further draws what both do. Bytes of two kinds do not: then a second entry has what the first lacks.
std::pair<VisibilityIndex, VisibilityIndex> unite(VisibilityIndex a, VisibilityIndex b) {
  const auto reaches = [](int8_t k, int8_t l) { return k == 0 || (l != 0 && l < k) ? l : k; };
  a.z = b.z = reaches(a.z, b.z);
  if (a.z == 1) return {completely_visible, {}};
  if (a.x > 0 && b.x > 0) a.x = b.x = std::max(a.x, b.x);
  if (a.x < 0 && b.x < 0) a.x = b.x = std::max(a.x, b.x);  // -1 draws from slice 2 on, -2 from 3
  if (a.y > 0 && b.y > 0) a.y = b.y = std::max(a.y, b.y);
  if (a.y < 0 && b.y < 0) a.y = b.y = std::max(a.y, b.y);
  const bool a_adds = a.x != 0 || a.y != 0, b_adds = b.x != 0 || b.y != 0;
  if (!b_adds || (a.x == b.x && a.y == b.y)) return {a, {}};
  if (!a_adds) return {b, {}};
  b.z = 0;
  return {a, b};
}

void add(VisibleObjects& visible, const PvsEntry& entry) {
  if (!entry.index.nothing()) visible.entries.push_back(entry);
}

void unite_rows(VisibleObjects& visible, const PvsRow& a, const PvsRow& b) {
  visible.entries.reserve(a.size() + b.size());
  auto i = a.begin(), j = b.begin();
  while (i != a.end() && j != b.end())
    if (i->object < j->object)
      add(visible, *i++);
    else if (j->object < i->object)
      add(visible, *j++);
    else {
      const auto [first, second] = unite(i->index, j->index);
      add(visible, {i->object, first});
      add(visible, {i->object, second});
      ++i, ++j;
    }
  visible.entries.insert(visible.entries.end(), i, a.end());
  visible.entries.insert(visible.entries.end(), j, b.end());
}

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
  unite_rows(visible, *rows[0], *rows[1]);
  if (state.pvs == PvsUse::buildings) take_whole_buildings(visible.entries);
  return visible;
}

}  // namespace veduta
