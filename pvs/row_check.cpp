// What must hold between cells, rows and entries.
#include <fmt/format.h>

#include "pvs/forms.h"
#include "pvs/pvs_check.h"
#include "pvs/pvs_stream.h"

namespace veduta {

namespace {

using Defect = std::optional<std::string>;

bool index_within(VisibilityIndex index, SliceCounts n) {
  // x = +k with 1 <= k <= n; x = -k means slices from k+1 on, 1 <= k < n; z as x > 0.
  const auto side = [](int value, int count) { return value > 0 ? value <= count : -value < count; };
  return index.z >= 0 && index.z <= n.z && side(index.x, n.x) && side(index.y, n.y) &&
         (index.x == 0 || index.y == 0) && !index.nothing();
}

std::string text_of(VisibilityIndex index) {
  return fmt::format("{}, {}, {}", int{index.x}, int{index.y}, int{index.z});
}

/// Of a PvsFile or a PvsIndex: all but the entries.
template <typename File>
Defect check_cells(const File& of, size_t cells, uint64_t entries) {
  if (of.cell_row.size() != cells) return "/cells/row: not one for each cell";
  if (of.cell_status.size() != cells) return "/cells/status: not one for each cell";
  if (of.bake_us.size() != cells) return "/cells/bake_us: not one for each cell";
  if (of.overestimate.size() != cells) return "/cells/overestimate: not one for each cell";
  if (!of.workers.empty() && of.cell_worker.size() != cells) return "/cells/worker: not one for each cell";
  if (of.row_begin.empty() || of.row_begin.front() != 0 || of.row_begin.back() != entries)
    return "/pvs/begin: does not span the entries";
  const size_t rows = of.row_begin.size() - 1;
  for (size_t c = 0; c < cells; ++c) {
    if (of.cell_row[c] >= rows) return fmt::format("/cells/row: cell {} names a row that is not there", c);
    if (of.cell_status[c] > CellStatus::all_visible)
      return fmt::format("/cells/status: cell {}: unknown status", c);
    if (!is_overestimate(of.overestimate[c]))
      return fmt::format("/cells/overestimate: cell {}: neither 0 nor at least 1", c);
    if (!of.workers.empty() && of.cell_worker[c] >= of.workers.size() && of.cell_worker[c] != no_worker)
      return fmt::format("/cells/worker: cell {} names a worker that is not there", c);
  }
  for (size_t r = 0; r < rows; ++r)
    if (of.row_begin[r] > of.row_begin[r + 1] || of.row_begin[r + 1] > entries)
      return fmt::format("/pvs/begin: row {} ends before it begins", r);
  return {};
}

}  // namespace

Defect find_defect(const PvsEntry* first, const PvsEntry* last, const std::vector<SliceCounts>& slices) {
  for (const PvsEntry* entry = first; entry != last; ++entry) {
    if (entry->object >= slices.size()) return fmt::format("object {} of {}", entry->object, slices.size());
    if (entry != first && entry->object <= (entry - 1)->object)
      return fmt::format("object {} is not in ascending order", entry->object);
    if (!index_within(entry->index, slices[entry->object]))
      return fmt::format("object {}: the index {} is outside of its slices", entry->object,
                         text_of(entry->index));
  }
  return {};
}

Defect find_form_defect(const Forms& forms, const std::vector<SliceCounts>& slices) {
  if (forms.begin.size() != slices.size() + 1 || forms.begin.front() != 0 ||
      forms.begin.back() != forms.index.size())
    return "/pvs/form_begin: not one more than there are objects, from 0 to the number of forms";
  for (size_t o = 0; o < slices.size(); ++o) {
    const uint64_t begin = forms.begin[o], end = forms.begin[o + 1];
    if (begin > end || end > forms.index.size())
      return fmt::format("/pvs/form_begin: object {} ends before it begins", o);
    for (uint64_t f = begin; f < end; ++f)
      if (!index_within(forms.index[f], slices[o]))
        return fmt::format("/pvs/form_index: form {}: {} is outside of the slices of object {}", f,
                           text_of(forms.index[f]), o);
  }
  return {};
}

Defect find_row_defect(const PvsFile& file) {
  return check_cells(file, file.city.cells.size(), file.entries.size());
}

Defect find_row_defect(const PvsIndex& index, uint64_t entries) {
  return check_cells(index, index.cells.size(), entries);
}

}  // namespace veduta
