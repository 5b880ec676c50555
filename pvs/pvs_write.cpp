#include <fmt/format.h>

#include <unordered_map>

#include "pvs/city_columns.h"
#include "pvs/pvs_check.h"
#include "scene/atomic_file.h"
#include "scene/error.h"

namespace veduta {

namespace {

using hdf5::ColumnWriter;
using hdf5::Output;

struct HashOfHash {
  size_t operator()(const Hash128& hash) const { return hash.low; }
};

/// Writes /cells and /pvs while rows come. In memory: one hash per unique row, and a chunk of each dataset.
/// Rows are called equal when their 128-bit hashes are; among 10^9 different rows, two share one with a
/// chance of 10^-21.
class RowWriter {
 public:
  RowWriter(Output& output, const City& city)
      : cell_row_(output, column::cell_row, city.cells.size()),
        bake_us_(output, column::cell_bake_us, city.cells.size()),
        status_(output, column::cell_status, city.cells.size()),
        overestimate_(output, column::cell_overestimate, city.cells.size()),
        begin_(output, column::pvs_begin, city.cells.size() + 1),
        object_(output, column::pvs_object, 0),
        index_(output, column::pvs_index, 0) {
    begin_.append(&entries_, 1);
  }

  void add(const BakedCell& cell) {
    const uint32_t row = row_of(cell.row);
    cell_row_.append(&row, 1);
    bake_us_.append(&cell.bake_us, 1);
    status_.append(&cell.status, 1);
    overestimate_.append(&cell.overestimate, 1);
  }

  void finish(ColumnDigests& digests) {
    digests[column::cell_row.path] = cell_row_.finish();
    digests[column::cell_bake_us.path] = bake_us_.finish();
    digests[column::cell_status.path] = status_.finish();
    digests[column::cell_overestimate.path] = overestimate_.finish();
    digests[column::pvs_begin.path] = begin_.finish();
    digests[column::pvs_object.path] = object_.finish();
    digests[column::pvs_index.path] = index_.finish();
  }

 private:
  uint32_t row_of(const PvsRow& row) {
    objects_.clear();
    indices_.clear();
    for (const PvsEntry& entry : row) {
      objects_.push_back(entry.object);
      indices_.push_back(entry.index);
    }
    const Hash128 of_objects = hash128(objects_.data(), objects_.size() * sizeof(uint32_t));
    const Hash128 of_indices = hash128(indices_.data(), indices_.size() * sizeof(VisibilityIndex));
    const Hash128 both[2] = {of_objects, of_indices};
    const auto [known, added] =
        rows_.try_emplace(hash128(both, sizeof both), static_cast<uint32_t>(rows_.size()));
    if (added) {
      object_.append(objects_.data(), objects_.size());
      index_.append(indices_.data(), indices_.size());
      entries_ += row.size();
      begin_.append(&entries_, 1);
    }
    return known->second;
  }

  ColumnWriter cell_row_, bake_us_, status_, overestimate_, begin_, object_, index_;
  uint64_t entries_ = 0;
  std::unordered_map<Hash128, uint32_t, HashOfHash> rows_;
  std::vector<uint32_t> objects_;
  std::vector<VisibilityIndex> indices_;
};

BakedCell ask(const CellSource& cells, uint32_t number, const City& city, const std::filesystem::path& file) {
  BakedCell cell = cells(number);
  const PvsEntry* first = cell.row.data();
  auto defect = find_defect(first, first + cell.row.size(), city.slices);
  if (!is_overestimate(cell.overestimate)) defect = fmt::format("an over-estimate of {}", cell.overestimate);
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

RootAttributes root_of(const City& city, const char* format) {
  RootAttributes root;
  root.format = format;
  root.crs = city.scene.crs;
  root.origin = city.scene.origin;
  return root;
}

}  // namespace

std::string write_pvs(const std::filesystem::path& file, const City& city, const PvsHeader& header,
                      const CellSource& cells) {
  refuse_defects(city, file);
  RootAttributes root = root_of(city, pvs_format);
  root.header = header;
  root.header.complete = true;
  ColumnDigests digests;
  write_atomically(
      file,
      [&](const std::filesystem::path& temporary) {
        Output output(temporary);
        output.require_space(least_bytes(city));
        write_scene_columns(output, city, digests);
        write_place_columns(output, city, digests);
        output.group("/pvs");
        RowWriter rows(output, city);
        for (uint32_t c = 0; c < city.cells.size(); ++c) {
          const BakedCell cell = ask(cells, c, city, file);
          if (cell.status != CellStatus::baked) root.header.complete = false;
          rows.add(cell);
        }
        rows.finish(digests);
        root.content_digest = content_digest(city, root.header.conservative, digests);
        write_root(output, root);
        output.close();
      },
      [&](const std::filesystem::path& temporary) { check_written(temporary, digests, root); });
  return root.content_digest;
}

void write_city(const std::filesystem::path& file, const City& city) {
  refuse_defects(city, file);
  RootAttributes root = root_of(city, city_format);
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
