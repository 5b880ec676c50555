#include <fmt/format.h>

#include "pvs/city_columns.h"
#include "pvs/forms.h"
#include "pvs/pvs_check.h"
#include "pvs/row_table.h"
#include "scene/atomic_file.h"
#include "scene/error.h"

namespace veduta {

namespace {

using hdf5::ColumnWriter;
using hdf5::Output;

/// Writes /cells and /pvs while rows come. In memory: a RowTable, a FormTable, and a few chunks of each
/// dataset. Rows are called equal when their 128-bit hashes are; among 10^9 different rows, two share one
/// with a chance of 10^-21.
class RowWriter {
 public:
  RowWriter(Output& output, uint64_t cells, size_t objects, const std::vector<std::string>& workers)
      : output_(output),
        cell_row_(output, column::cell_row, cells),
        bake_us_(output, column::cell_bake_us, cells),
        status_(output, column::cell_status, cells),
        overestimate_(output, column::cell_overestimate, cells),
        begin_(output, column::pvs_begin, cells + 1),
        object_step_(output, column::pvs_object_step, 0),
        form_(output, column::pvs_form, 0),
        object_count_(objects),
        forms_(objects) {
    if (!workers.empty()) worker_.emplace(output, column::cell_worker, cells);
    begin_.append(&entries_, 1);
  }

  void add(const BakedCell& cell) {
    const uint32_t row = cell.status == CellStatus::all_visible ? row_of_all_objects() : row_of(cell.row);
    cell_row_.append(&row, 1);
    bake_us_.append(&cell.bake_us, 1);
    status_.append(&cell.status, 1);
    overestimate_.append(&cell.overestimate, 1);
    if (worker_) worker_->append(&cell.worker, 1);
  }

  void finish(ColumnDigests& digests) {
    digests[column::cell_row.path] = cell_row_.finish();
    digests[column::cell_bake_us.path] = bake_us_.finish();
    digests[column::cell_status.path] = status_.finish();
    digests[column::cell_overestimate.path] = overestimate_.finish();
    if (worker_) digests[column::cell_worker.path] = worker_->finish();
    digests[column::pvs_begin.path] = begin_.finish();
    digests[column::pvs_object_step.path] = object_step_.finish();
    digests[column::pvs_form.path] = form_.finish();
    const Forms forms = forms_.forms();
    digests[column::pvs_form_begin.path] = hdf5::write_rows(output_, column::pvs_form_begin, forms.begin);
    digests[column::pvs_form_index.path] = hdf5::write_rows(output_, column::pvs_form_index, forms.index);
  }

 private:
  uint32_t row_of(const PvsRow& row) {
    steps_.clear();
    row_forms_.clear();
    uint32_t before = 0;
    for (const PvsEntry& entry : row) {
      steps_.push_back(entry.object - before);
      row_forms_.push_back(forms_.number(entry));
      before = entry.object;
    }
    const Hash128 both[2] = {hash128(steps_.data(), steps_.size() * sizeof(uint32_t)),
                             hash128(row_forms_.data(), row_forms_.size() * sizeof(uint16_t))};
    const auto [number, added] = rows_.add(hash128(both, sizeof both));
    if (added) {
      object_step_.append(steps_.data(), steps_.size());
      form_.append(row_forms_.data(), row_forms_.size());
      entries_ += row.size();
      begin_.append(&entries_, 1);
    }
    return number;
  }

  /// Made once: of a partial file it is the row of most cells.
  uint32_t row_of_all_objects() {
    if (!all_objects_) {
      PvsRow row(object_count_);
      for (uint32_t i = 0; i < row.size(); ++i) row[i] = {i, completely_visible};
      all_objects_ = row_of(row);
    }
    return *all_objects_;
  }

  Output& output_;
  ColumnWriter cell_row_, bake_us_, status_, overestimate_, begin_, object_step_, form_;
  std::optional<ColumnWriter> worker_;
  uint64_t entries_ = 0;
  size_t object_count_;
  std::optional<uint32_t> all_objects_;
  RowTable rows_;
  FormTable forms_;
  std::vector<uint32_t> steps_;
  std::vector<uint16_t> row_forms_;
};

BakedCell ask(const CellSource& cells, uint32_t number, const std::vector<SliceCounts>& slices,
              size_t workers, const std::filesystem::path& file) {
  BakedCell cell = cells(number);
  const PvsEntry* first = cell.row.data();
  auto defect = find_defect(first, first + cell.row.size(), slices);
  if (!is_overestimate(cell.overestimate)) defect = fmt::format("an over-estimate of {}", cell.overestimate);
  if (cell.worker >= workers && cell.worker != no_worker) defect = fmt::format("worker {}", cell.worker);
  if (defect)
    throw Error(ExitStatus::defect, fmt::format("{}: cell {}: {}; a defect of the bake, please report it",
                                                file.string(), number, *defect));
  return cell;
}

void refuse_defects(const City& city, const std::filesystem::path& file) {
  if (const auto defect = find_defect(city))
    throw Error(ExitStatus::defect,
                fmt::format("{}: {}; a defect of the preparation, please report it", file.string(), *defect));
}

/// The least that the file can take: a refusal now is better than one after an hour.
uint64_t least_bytes(const City& city) {
  const Scene& scene = city.scene;
  const uint64_t raw = scene.vertices.size() * 12 + scene.triangle_count() * 19 + city.cells.size() * 37 +
                       city.navigation.ground.height.size() * 4;
  return raw / 8;
}

RootAttributes root_of(const City& city, const char* format, uint32_t version) {
  RootAttributes root;
  root.format = format;
  root.version = version;
  root.crs = city.scene.crs;
  root.origin = city.scene.origin;
  return root;
}

/// The rows and the root of a file whose city is written by others.
struct RowsJob {
  const std::filesystem::path& file;
  uint64_t cell_count;
  const std::vector<SliceCounts>& slices;
  const City& frame;
  const CellSource& cells;
  const std::vector<std::string>& workers;
  const WorkHeard& heard;

  void write_rows(Output& output, RootAttributes& root, ColumnDigests& digests) const {
    output.group("/pvs");
    RowWriter rows(output, cell_count, slices.size(), workers);
    for (uint32_t c = 0; c < cell_count; ++c) {
      const BakedCell cell = ask(cells, c, slices, workers.size(), file);
      if (cell.status != CellStatus::baked) root.header.complete = false;
      rows.add(cell);
      if (heard) heard("rows", c + 1, cell_count);
    }
    rows.finish(digests);
    if (!workers.empty())
      digests[column::worker_name.path] =
          hdf5::write_texts(output, column::worker_name, workers.size(),
                            [&](size_t i) -> const std::string& { return workers[i]; });
  }

  std::string write(const PvsHeader& header,
                    const std::function<void(Output&, ColumnDigests&)>& write_place) const {
    RootAttributes root = root_of(frame, pvs_format, pvs_version);
    root.header = header;
    root.header.complete = true;
    ColumnDigests digests;
    write_atomically(
        file,
        [&](const std::filesystem::path& temporary) {
          Output output(temporary);
          write_place(output, digests);
          write_rows(output, root, digests);
          root.content_digest = content_digest(frame, root.header.conservative, digests);
          write_root(output, root);
          output.close();
        },
        [&](const std::filesystem::path& temporary) { check_written(temporary, digests, root, heard); });
    return root.content_digest;
  }
};

}  // namespace

std::string write_pvs(const std::filesystem::path& file, const City& city, const PvsHeader& header,
                      const CellSource& cells, const std::vector<std::string>& workers) {
  refuse_defects(city, file);
  RowsJob job{file, city.cells.size(), city.slices, city, cells, workers, {}};
  return job.write(header, [&](Output& output, ColumnDigests& digests) {
    output.require_space(least_bytes(city));
    write_scene_columns(output, city, digests);
    write_place_columns(output, city, digests);
  });
}

std::string write_pvs(const std::filesystem::path& file, const std::filesystem::path& city_file,
                      const CityOutline& city, const PvsHeader& header, const CellSource& cells,
                      const WorkHeard& heard, const std::vector<std::string>& workers) {
  RowsJob job{file, city.cells, city.slices, city.frame, cells, workers, heard};
  return job.write(header, [&](Output& output, ColumnDigests& digests) {
    copy_city(output, hdf5::Input(city_file), city);
    digests = city.digests;
  });
}

void write_city(const std::filesystem::path& file, const City& city) {
  refuse_defects(city, file);
  RootAttributes root = root_of(city, city_format, city_version);
  ColumnDigests digests;
  write_atomically(
      file,
      [&](const std::filesystem::path& temporary) {
        Output output(temporary);
        output.require_space(least_bytes(city));
        write_scene_columns(output, city, digests);
        write_place_columns(output, city, digests);
        root.content_digest = content_digest(city, root.header.conservative, digests);
        write_root(output, root);
        output.close();
      },
      [&](const std::filesystem::path& temporary) { check_written(temporary, digests, root); });
}

}  // namespace veduta
