#include "pvs/pvs_file.h"

namespace veduta {

PvsFile::Span PvsFile::row(uint32_t cell) const {
  const uint32_t r = cell_row[cell];
  return {entries.data() + row_begin[r], entries.data() + row_begin[r + 1]};
}

int64_t PvsFile::find_cell(const glm::vec3& point) const {
  if (grid.cell_count() == city.cells.size()) return grid.find(city.cells, point);
  for (size_t c = 0; c < city.cells.size(); ++c)
    if (city.cells[c].contains(point)) return static_cast<int64_t>(c);
  return -1;
}

}  // namespace veduta
