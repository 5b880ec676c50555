#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <map>
#include <nlohmann/json.hpp>

#include "pvs/hdf5_input.h"
#include "pvs/pvs_file.h"

namespace veduta {

namespace {

struct Summary {
  uint64_t cells = 0, rows = 0, entries = 0, objects = 0, triangles = 0, vertices = 0;
  uint64_t file_bytes = 0, pvs_bytes = 0;  ///< as stored
  std::array<uint64_t, 3> status{};        ///< cells by CellStatus
  double mean_visible = 0;                 ///< objects, over cells
  uint64_t median_visible = 0, max_visible = 0;
  std::map<std::array<float, 3>, uint64_t> sizes;  ///< edges of cells, m, and how many
};

Summary summarize(const PvsFile& file, const std::filesystem::path& path) {
  Summary s;
  s.cells = file.city.cells.size();
  s.rows = file.row_begin.empty() ? 0 : file.row_begin.size() - 1;
  s.entries = file.entries.size();
  s.objects = file.city.scene.objects.size();
  s.triangles = file.city.scene.triangles.size();
  s.vertices = file.city.scene.vertices.size();
  const hdf5::Input input(path);
  s.file_bytes = input.file_bytes();
  for (const Column* column : {&column::pvs_begin, &column::pvs_object, &column::pvs_index})
    s.pvs_bytes += hdf5::ColumnReader(input, *column).stored_bytes();
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
  if (!visible.empty()) {
    std::sort(visible.begin(), visible.end());
    s.median_visible = visible[visible.size() / 2];
    s.max_visible = visible.back();
  }
  return s;
}

double per_cell(uint64_t bytes, const Summary& s) {
  return s.cells == 0 ? 0 : static_cast<double>(bytes) / static_cast<double>(s.cells);
}

}  // namespace

std::string describe(const PvsFile& file, const std::filesystem::path& path) {
  const Summary s = summarize(file, path);
  const auto& origin = file.city.scene.origin;
  std::string out =
      fmt::format("{}: {}{}\n", path.string(), file.header.complete ? "complete" : "not complete",
                  file.header.conservative ? ", conservative" : ", not conservative");
  out +=
      fmt::format("  scene      {} objects, {} triangles, {} vertices\n", s.objects, s.triangles, s.vertices);
  out += fmt::format("  place      {}, origin {:.3f} {:.3f} {:.3f} m\n",
                     file.city.scene.crs.empty() ? "CRS unknown" : file.city.scene.crs, origin[0], origin[1],
                     origin[2]);
  out += fmt::format("  cells      {}: {} baked, {} coarse, {} all visible\n", s.cells, s.status[0],
                     s.status[1], s.status[2]);
  for (const auto& [edge, count] : s.sizes)
    out += fmt::format("  cell size  {:g} x {:g} x {:g} m: {}\n", edge[0], edge[1], edge[2], count);
  out += fmt::format("  rows       {} unique, {} entries\n", s.rows, s.entries);
  out += fmt::format("  visible    {:.1f} objects a cell in the mean, {} median, {} most, of {}\n",
                     s.mean_visible, s.median_visible, s.max_visible, s.objects);
  out += fmt::format("  size       {} bytes; the PVS {} bytes, {:.1f} bytes a cell\n", s.file_bytes,
                     s.pvs_bytes, per_cell(s.pvs_bytes, s));
  out += fmt::format("  renderer   {}\n", file.header.renderer.empty() ? "not known" : file.header.renderer);
  out += fmt::format("  digest     {}\n", file.content_digest);
  return out;
}

std::string describe_json(const PvsFile& file, const std::filesystem::path& path) {
  const Summary s = summarize(file, path);
  nlohmann::ordered_json sizes = nlohmann::ordered_json::array();
  for (const auto& [edge, count] : s.sizes)
    sizes.push_back({{"edges_m", {edge[0], edge[1], edge[2]}}, {"cells", count}});
  const nlohmann::ordered_json out = {
      {"file", path.string()},
      {"complete", file.header.complete},
      {"conservative", file.header.conservative},
      {"objects", s.objects},
      {"triangles", s.triangles},
      {"vertices", s.vertices},
      {"crs", file.city.scene.crs},
      {"origin_m", file.city.scene.origin},
      {"cells", s.cells},
      {"cells_baked", s.status[0]},
      {"cells_coarse", s.status[1]},
      {"cells_all_visible", s.status[2]},
      {"cell_sizes", sizes},
      {"rows", s.rows},
      {"entries", s.entries},
      {"visible_objects_mean", s.mean_visible},
      {"visible_objects_median", s.median_visible},
      {"visible_objects_max", s.max_visible},
      {"file_bytes", s.file_bytes},
      {"pvs_bytes", s.pvs_bytes},
      {"pvs_bytes_per_cell", per_cell(s.pvs_bytes, s)},
      {"renderer", file.header.renderer},
      {"fingerprint", file.header.fingerprint},
      {"content_digest", file.content_digest},
  };
  // Names in a file need not be valid UTF-8; an info command must not fail over that.
  return out.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace veduta
