// The figures of a result that `veduta info` prints.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pvs/pvs_file.h"

namespace veduta {

struct PvsSummary {
  uint64_t cells = 0, rows = 0, entries = 0, objects = 0, triangles = 0, vertices = 0;
  std::array<uint64_t, 3> status{};                ///< cells by CellStatus
  std::map<std::array<float, 3>, uint64_t> sizes;  ///< edges of cells, m, and how many

  double mean_visible = 0;  ///< objects, over cells
  uint64_t median_visible = 0, max_visible = 0;

  uint64_t certified = 0;  ///< cells with an over-estimate
  float median_overestimate = 0, worst_overestimate = 0;
  std::optional<double> asked_overestimate;  ///< occlusion.max_overestimate of the configuration
  double within_asked = 0;                   ///< share of all cells; those without an over-estimate are not

  uint64_t file_bytes = 0;
  /// By path: what holds the rows, and which cell has which, as packed (without headers and chunk indices).
  std::map<std::string, uint64_t> pvs_bytes_of;
  uint64_t pvs_bytes = 0;  ///< their sum
  /// What the rows of the cells would take in other codings (pvs/row_codings.h), bytes in the mean of cells.
  double three_bytes = 0, three_bytes_runs = 0, bits = 0, bits_runs = 0;

  std::vector<uint64_t> worker_cells;  ///< for each name of PvsFile::workers, how many it baked

  double pvs_bytes_per_cell() const {
    return cells == 0 ? 0 : static_cast<double>(pvs_bytes) / static_cast<double>(cells);
  }
};

/// \param path where the file was read from: its size and those of its datasets are asked for.
PvsSummary summarize(const PvsFile& file, const std::filesystem::path& path);

}  // namespace veduta
