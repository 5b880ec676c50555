#include <nlohmann/json.hpp>

#include "pvs/pvs_summary.h"

namespace veduta {

namespace {

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

std::string describe_json(const PvsFile& file, const std::filesystem::path& path) {
  const PvsSummary s = summarize(file, path);
  nlohmann::ordered_json sizes = nlohmann::ordered_json::array();
  for (const auto& [edge, count] : s.sizes)
    sizes.push_back({{"edges_m", {edge[0], edge[1], edge[2]}}, {"cells", count}});
  nlohmann::ordered_json workers = nlohmann::ordered_json::array();
  for (size_t w = 0; w < file.workers.size(); ++w)
    workers.push_back({{"name", file.workers[w]}, {"cells", s.worker_cells[w]}});
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
      {"pvs_bytes_of", s.pvs_bytes_of},
      {"pvs_bytes_per_cell", s.pvs_bytes_per_cell()},
      {"other_codings_bytes_per_cell",
       {{"three_bytes", s.three_bytes},
        {"three_bytes_zero_runs", s.three_bytes_runs},
        {"bits", s.bits},
        {"bits_zero_runs", s.bits_runs}}},
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
