#include "viewer/active_cells.h"

#include <algorithm>
#include <iterator>

namespace veduta {

ActiveCells active_cells(const PvsFile& file, const Pose& pose, const Optics& optics, StereoMode mode,
                         double eye_margin_m) {
  ActiveCells active;
  active.cell = file.find_cell(pose.position_m);
  std::vector<int64_t> cells;
  const bool apart = mode != StereoMode::mono && optics.iod_m / 2.0 > eye_margin_m;
  if (apart)
    for (Eye eye : eyes(mode)) cells.push_back(file.find_cell(eye_view(pose, optics, eye).position_m));
  else
    cells.push_back(active.cell);
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  if (cells.front() < 0) {
    active.everything = true;
    return active;
  }
  for (int64_t cell : cells) {
    const PvsFile::Span row = file.row(static_cast<uint32_t>(cell));
    std::vector<PvsEntry> both;
    std::merge(active.entries.begin(), active.entries.end(), row.begin(), row.end(), std::back_inserter(both),
               [](const PvsEntry& a, const PvsEntry& b) { return a.object < b.object; });
    active.entries.swap(both);
  }
  return active;
}

}  // namespace veduta
