// What a result says of its cells, beside their bounds.
#pragma once

#include "pvs/hdf5_input.h"

namespace veduta {

/// Reads it into a PvsFile or a PvsIndex. Digests are compared, relations not yet.
template <typename File>
void read_cell_columns(const hdf5::Input& input, File& file, ColumnDigests& digests) {
  const auto read = [&](const Column& column, auto& values) {
    digests[column.path] = hdf5::ColumnReader(input, column).read_into(values);
  };
  read(column::cell_row, file.cell_row);
  read(column::cell_bake_us, file.bake_us);
  read(column::cell_status, file.cell_status);
  read(column::cell_overestimate, file.overestimate);
  read(column::pvs_begin, file.row_begin);
  if (!input.has(column::cell_worker.path) && !input.has(column::worker_name.path)) return;
  read(column::cell_worker, file.cell_worker);
  digests[column::worker_name.path] = hdf5::ColumnReader(input, column::worker_name).read_texts(file.workers);
  if (file.workers.empty()) input.fail(column::worker_name.path, "no name");
}

}  // namespace veduta
