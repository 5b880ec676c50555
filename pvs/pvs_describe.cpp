#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

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
  uint64_t certified = 0;  ///< cells with an over-estimate
  float median_overestimate = 0, worst_overestimate = 0;
  std::optional<double> asked_overestimate;  ///< occlusion.max_overestimate of the configuration
  double within_asked = 0;                   ///< share of all cells; those without an over-estimate are not
  std::map<std::array<float, 3>, uint64_t> sizes;  ///< edges of cells, m, and how many
};

/// The file says how it was made, perhaps by a later program with other keys: only this one is looked at.
std::optional<double> asked_overestimate(const std::string& config) {
  try {
    return toml::parse(config)["occlusion"]["max_overestimate"].value<double>();
  } catch (const toml::parse_error&) {
    return {};
  }
}

void summarize_overestimates(const PvsFile& file, Summary& s) {
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

std::string overestimate_line(const Summary& s) {
  if (s.certified == 0) return "  certified  no over-estimate: nobody looked\n";
  std::string out =
      fmt::format("  certified  over-estimate in objects {:.2f}x median, {:.2f}x worst, of {} cells",
                  s.median_overestimate, s.worst_overestimate, s.certified);
  if (s.asked_overestimate)
    out += fmt::format("; {:.1f} % of all within the {:g}x asked for", 100 * s.within_asked,
                       *s.asked_overestimate);
  return out + "\n";
}

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
  summarize_overestimates(file, s);
  return s;
}

std::vector<uint64_t> cells_of_workers(const PvsFile& file) {
  std::vector<uint64_t> cells(file.workers.size());
  for (const uint32_t worker : file.cell_worker)
    if (worker != no_worker) ++cells[worker];
  return cells;
}

std::string workers_line(const PvsFile& file) {
  if (file.workers.empty()) return "  workers    not known\n";
  const std::vector<uint64_t> cells = cells_of_workers(file);
  const auto most = std::max_element(cells.begin(), cells.end());
  return fmt::format("  workers    {}; {} baked most, {} cells\n", cells.size(),
                     file.workers[static_cast<size_t>(most - cells.begin())], *most);
}

double per_cell(uint64_t bytes, const Summary& s) {
  return s.cells == 0 ? 0 : static_cast<double>(bytes) / static_cast<double>(s.cells);
}

nlohmann::ordered_json verification_json(const std::optional<Verification>& v) {
  if (!v) return nullptr;
  nlohmann::ordered_json out = {
      {"passed", v->passed()},
      {"when", v->when},
      {"program", v->program},
      {"seed", v->seed},
      {"rays_per_cell", v->rays_per_cell},
      {"eyes_per_cell", v->eyes_per_cell},
      {"cells_checked", v->cells.size()},
      {"cells_without_eye", v->cells_without_eye()},
      {"rays", v->rays()},
      {"false_invisible_objects", v->false_invisible_objects()},
      {"false_invisible_triangles", v->false_invisible_triangles()},
      {"false_invisible_solid_angle_mean", v->false_invisible_solid_angle_mean},
      {"false_invisible_solid_angle_worst", v->false_invisible_solid_angle_worst},
      {"narrow_gap_limit_m", v->narrow_gap_limit_m},
      {"narrow_gap_objects", v->narrow_gap_objects()},
      {"narrow_gap_triangles", v->narrow_gap_triangles},
      {"overestimate_objects", v->overestimate_objects},
      {"overestimate_buildings", v->overestimate_buildings},
      {"overestimate_triangles", v->overestimate_triangles},
      {"tightest_triangles", v->tightest_triangles},
      {"examples", nlohmann::ordered_json::array()},
  };
  const auto array = [](const glm::vec3& p) { return std::array<float, 3>{p.x, p.y, p.z}; };
  for (const Witness& w : v->witnesses)
    out["examples"].push_back({{"cell", w.cell},
                               {"object", w.object},
                               {"triangle", w.triangle},
                               {"eye_m", array(w.eye)},
                               {"direction", array(w.direction)},
                               {"hit_m", array(w.hit)},
                               {"gap_m", w.gap_m},
                               {"gap_from_eye_m", w.gap_from_eye_m}});
  return out;
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
  out += workers_line(file);
  out += fmt::format("  rows       {} unique, {} entries\n", s.rows, s.entries);
  out += fmt::format("  visible    {:.1f} objects a cell in the mean, {} median, {} most, of {}\n",
                     s.mean_visible, s.median_visible, s.max_visible, s.objects);
  out += overestimate_line(s);
  out += file.verification ? describe_verification(*file.verification, file) : "  verified   no\n";
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
  nlohmann::ordered_json workers = nlohmann::ordered_json::array();
  const std::vector<uint64_t> worker_cells = cells_of_workers(file);
  for (size_t w = 0; w < file.workers.size(); ++w)
    workers.push_back({{"name", file.workers[w]}, {"cells", worker_cells[w]}});
  nlohmann::ordered_json out = {
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
      {"workers", workers},
      {"rows", s.rows},
      {"entries", s.entries},
      {"visible_objects_mean", s.mean_visible},
      {"visible_objects_median", s.median_visible},
      {"visible_objects_max", s.max_visible},
      {"cells_certified", s.certified},
      {"overestimate_median", s.median_overestimate},
      {"overestimate_worst", s.worst_overestimate},
      {"overestimate_asked", nullptr},
      {"cells_within_asked_share", s.within_asked},
      {"file_bytes", s.file_bytes},
      {"pvs_bytes", s.pvs_bytes},
      {"pvs_bytes_per_cell", per_cell(s.pvs_bytes, s)},
      {"verification", verification_json(file.verification)},
      {"renderer", file.header.renderer},
      {"fingerprint", file.header.fingerprint},
      {"content_digest", file.content_digest},
  };
  if (s.asked_overestimate) out["overestimate_asked"] = *s.asked_overestimate;
  // Names in a file need not be valid UTF-8; an info command must not fail over that.
  return out.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace veduta
