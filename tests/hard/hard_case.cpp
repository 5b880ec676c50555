#include "tests/hard/hard_case.h"

#include <toml++/toml.h>

#include <array>
#include <sstream>
#include <stdexcept>

#include "tests/hard/generated_scenes.h"
#include "worker/baker.h"
#include "worker/clustered_occluders.h"
#include "worker/preparation.h"

namespace veduta::hard {
namespace {

template <size_t count>
std::array<double, count> numbers(const toml::node& node) {
  std::array<double, count> all{};
  const toml::array* array = node.as_array();
  if (array == nullptr || array->size() != count) throw std::runtime_error("case.toml: not so many numbers");
  for (size_t n = 0; n < count; ++n) all[n] = array->get(n)->value<double>().value();
  return all;
}

template <typename Each>
void for_each(const toml::node& node, const Each& each) {
  const toml::array* array = node.as_array();
  if (array == nullptr) throw std::runtime_error("case.toml: not an array");
  for (const toml::node& element : *array) each(element);
}

void read_key(HardCase& hard_case, const std::string& key, const toml::node& node) {
  const auto text = [&] { return node.value<std::string>().value(); };
  if (key == "hard")
    hard_case.hard = text();
  else if (key == "stands")
    for_each(node, [&](const toml::node& stand) { hard_case.stands.push_back(numbers<3>(stand)); });
  else if (key == "hidden")
    for_each(node,
             [&](const toml::node& name) { hard_case.hidden.push_back(name.value<std::string>().value()); });
  else if (key == "seen")
    for_each(node,
             [&](const toml::node& name) { hard_case.seen.push_back(name.value<std::string>().value()); });
  else if (key == "narrow_gaps")
    for_each(node, [&](const toml::node& gap) {
      const auto b = numbers<6>(gap);
      hard_case.gaps.push_back({{b[0], b[1], b[2]}, {b[3], b[4], b[5]}});
    });
  else if (key == "refused")
    hard_case.refused = text();
  else if (key == "known_fault")
    hard_case.known_fault = text();
  else if (key == "looks")
    hard_case.looks = node.value<size_t>().value();
  else if (key == "generated")
    hard_case.generated = text();
  else
    throw std::runtime_error("case.toml: unknown key case." + key);
}

/// In the coordinates of the model.
Point in_model(const Scene& scene, const glm::vec3& p) {
  return {scene.origin[0] + p.x, scene.origin[1] + p.y, scene.origin[2] + p.z};
}

}  // namespace

HardCase read_case(const std::filesystem::path& folder) {
  HardCase hard_case;
  hard_case.name = folder.filename().string();
  toml::table table = toml::parse_file((folder / "case.toml").string());
  const toml::table* own = table["case"].as_table();
  if (own == nullptr) throw std::runtime_error(hard_case.name + "/case.toml: no section [case]");
  for (const auto& [key, node] : *own) read_key(hard_case, std::string(key.str()), node);
  table.erase("case");
  std::ostringstream bake;
  bake << table;
  hard_case.settings = parse_settings(bake.str(), hard_case.name + "/case.toml", folder);
  return hard_case;
}

PreparedCase prepare_case(const Settings& settings) {
  const test::TemporaryDirectory directory;
  const RunPaths run{directory.path()};
  prepare_all(run, settings);
  return {read_city(run.city()), ClusteredOccluders::map(run.occluders()).meshes()};
}

PvsFile bake_case(const PreparedCase& prepared, Settings settings, const std::string& method) {
  settings.occlusion.method = method;
  PvsFile file;
  file.city = prepared.city;
  file.index_cells();
  file.row_begin.push_back(0);
  Baker baker(prepared.city, prepared.occluders, settings, "software");
  std::vector<uint32_t> cells(baker.cell_count());
  for (uint32_t cell = 0; cell < cells.size(); ++cell) cells[cell] = cell;
  baker.bake(cells, [&](const CellRecord& record) {
    file.cell_row.push_back(static_cast<uint32_t>(file.cell_row.size()));
    file.cell_status.push_back(record.status);
    file.bake_us.push_back(record.bake_us);
    file.overestimate.push_back(record.overestimate);
    file.entries.insert(file.entries.end(), record.row.begin(), record.row.end());
    file.row_begin.push_back(file.entries.size());
  });
  return file;
}

std::vector<Point> places_of_eyes(const HardCase& hard_case, const City& city) {
  std::vector<Point> places = hard_case.stands;
  for (const Box& cell : city.cells)
    for (const glm::vec3& corner : {cell.lower, cell.upper}) places.push_back(in_model(city.scene, corner));
  return places;
}

std::vector<CellSightings> look_from_cells(const ExactReference& reference, const HardCase& hard_case,
                                           const PvsFile& file) {
  LookAbout about;
  about.stands = hard_case.stands, about.gaps = hard_case.gaps, about.looks = hard_case.looks;
  about.clearance_m = 2 * hard_case.settings.navigation.seed_size_m;
  const auto world = [&](const glm::vec3& p) { return in_model(file.city.scene, p); };
  std::vector<CellSightings> all;
  for (uint32_t cell = 0; cell < file.city.cells.size(); ++cell) {
    const Box& box = file.city.cells[cell];
    const auto eyes = certain_eyes(reference, {world(box.lower), world(box.upper)}, about);
    if (!eyes.empty()) all.push_back({cell, eyes.size(), look_about(reference, eyes, about)});
  }
  return all;
}

}  // namespace veduta::hard
