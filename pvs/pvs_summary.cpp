#include "pvs/pvs_summary.h"

#include <toml++/toml.h>

#include <algorithm>
#include <glm/common.hpp>
#include <string_view>

#include "pvs/hdf5_input.h"
#include "pvs/row_codings.h"

namespace veduta {

namespace {

/// The file says how it was made, perhaps by a later program with other keys: only this one is looked at.
std::optional<double> asked_overestimate(const std::string& config) {
  try {
    return toml::parse(config)["occlusion"]["max_overestimate"].value<double>();
  } catch (const toml::parse_error&) {
    return {};
  }
}

void summarize_overestimates(const PvsFile& file, PvsSummary& s) {
  std::vector<float> certified;
  std::copy_if(file.overestimate.begin(), file.overestimate.end(), std::back_inserter(certified),
               [](float value) { return value > 0; });
  s.asked_overestimate = asked_overestimate(file.header.config);
  s.certified = certified.size();
  if (certified.empty()) return;
  std::sort(certified.begin(), certified.end());
  s.median_overestimate = certified[certified.size() / 2];
  s.worst_overestimate = certified.back();
  // Rounded as the ratios were, so that 6 over 5 is within 1.2.
  const auto asked = static_cast<float>(s.asked_overestimate.value_or(0));
  const auto within = std::upper_bound(certified.begin(), certified.end(), asked) - certified.begin();
  s.within_asked = static_cast<double>(within) / static_cast<double>(s.cells);
}

void summarize_cells(const PvsFile& file, PvsSummary& s) {
  for (const CellStatus status : file.cell_status) ++s.status[static_cast<size_t>(status)];
  std::vector<uint64_t> visible;
  for (uint32_t c = 0; c < s.cells; ++c) {
    visible.push_back(file.row(c).size());
    s.mean_visible += static_cast<double>(visible.back()) / static_cast<double>(s.cells);
    // To the millimetre: float32 positions make edges differ in their last bits.
    const glm::vec3 edge =
        glm::round((file.city.cells[c].upper - file.city.cells[c].lower) * 1000.0f) / 1000.0f;
    ++s.sizes[{edge.x, edge.y, edge.z}];
  }
  if (visible.empty()) return;
  std::sort(visible.begin(), visible.end());
  s.median_visible = visible[visible.size() / 2];
  s.max_visible = visible.back();
}

void summarize_bytes(const std::filesystem::path& path, PvsSummary& s) {
  const hdf5::Input input(path);
  s.file_bytes = input.file_bytes();
  for (const Column* column : column::all) {
    if (!std::string_view(column->path).starts_with("/pvs/") && column != &column::cell_row) continue;
    const uint64_t bytes = hdf5::ColumnReader(input, *column).stored_bytes();
    s.pvs_bytes_of[column->path] = bytes;
    s.pvs_bytes += bytes;
  }
}

void summarize_codings(const PvsFile& file, PvsSummary& s) {
  std::vector<uint64_t> cells_of_row(s.rows);
  for (const uint32_t row : file.cell_row) ++cells_of_row[row];
  RowCodings sum;
  for (size_t r = 0; r < s.rows; ++r) {
    const PvsEntry* entries = file.entries.data();
    const RowCodings row =
        row_codings(entries + file.row_begin[r], entries + file.row_begin[r + 1], s.objects);
    sum.three_bytes += cells_of_row[r] * row.three_bytes;
    sum.three_bytes_runs += cells_of_row[r] * row.three_bytes_runs;
    sum.bits += cells_of_row[r] * row.bits;
    sum.bits_runs += cells_of_row[r] * row.bits_runs;
  }
  const auto mean = [&](uint64_t bytes) { return static_cast<double>(bytes) / static_cast<double>(s.cells); };
  s.three_bytes = mean(sum.three_bytes), s.three_bytes_runs = mean(sum.three_bytes_runs);
  s.bits = mean(sum.bits), s.bits_runs = mean(sum.bits_runs);
}

}  // namespace

PvsSummary summarize(const PvsFile& file, const std::filesystem::path& path) {
  PvsSummary s;
  s.cells = file.city.cells.size();
  s.rows = file.row_begin.empty() ? 0 : file.row_begin.size() - 1;
  s.entries = file.entries.size();
  s.objects = file.city.scene.objects.size();
  s.triangles = file.city.scene.triangles.size();
  s.vertices = file.city.scene.vertices.size();
  summarize_cells(file, s);
  summarize_overestimates(file, s);
  summarize_bytes(path, s);
  if (s.cells > 0) summarize_codings(file, s);
  s.worker_cells.resize(file.workers.size());
  for (const uint32_t worker : file.cell_worker)
    if (worker != no_worker) ++s.worker_cells[worker];
  return s;
}

}  // namespace veduta
