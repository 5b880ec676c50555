#include "scene/city/city_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

#include "scene/city/city_settings_keys.h"
#include "scene/error.h"
#include "scene/nearest_word.h"
#include "scene/text.h"

namespace veduta::city {
namespace {

[[noreturn]] void refuse_unknown(const Place& place, const toml::node& node,
                                 const std::set<std::string>& known) {
  place.refuse(node, fmt::format("unknown key '{}'; did you mean '{}'?", printable(place.key, 80),
                                 nearest_word(place.key, known)));
}

template <typename Target>
void apply(Target& target, const toml::table& table, const std::string& prefix, Place place,
           const std::vector<Key<Target>>& keys, std::set<std::string>& seen) {
  for (const auto& [name, node] : table) {
    place.key = prefix + std::string(name.str());
    const auto key =
        std::find_if(keys.begin(), keys.end(), [&](const Key<Target>& k) { return k.path == place.key; });
    if (key == keys.end()) {
      std::set<std::string> known;
      for (const Key<Target>& each : keys) known.insert(each.path);
      refuse_unknown(place, node, known);
    }
    key->set(target, node, place);
    seen.insert(place.key);
  }
}

void apply_rules(CitySettings& settings, const toml::node& node, const Place& place, bool made_up) {
  if (!node.is_array_of_tables()) place.refuse(node, "'rules' must be entries [[rules]], one a style");
  double weights = 0;
  for (const toml::node& entry : *node.as_array()) {
    CityStyle style;
    std::set<std::string> seen;
    apply(style, *entry.as_table(), "rules.", place, style_keys(), seen);
    if (!seen.count("rules.file")) place.refuse(entry, "'rules.file' is missing; name the style's XML file");
    for (const char* const key : {"rules.depth", "rules.gap", "rules.courtyard"})
      if (!made_up && seen.count(key))
        place.refuse(entry, fmt::format("'{}' has no meaning where the plan is a file; remove it", key));
    const auto& lot = settings.streets.lot;
    const Architecture& wanted = style.architecture;
    if (made_up && wanted.depth[1] > lot[1] - least_yard_m)
      place.refuse(entry,
                   fmt::format("a 'rules.depth' of {} m does not fit a 'streets.lot' of {} m; leave {} "
                               "m behind the building",
                               wanted.depth[1], lot[1], least_yard_m));
    if (made_up && lot[0] - 2 * wanted.gap < 2)
      place.refuse(entry, fmt::format("a 'rules.gap' of {} m leaves less than 2 m of a 'streets.lot' of {} m",
                                      wanted.gap, lot[0]));
    weights += wanted.weight;
    settings.styles.push_back(std::move(style));
  }
  if (!(weights > 0)) place.refuse(node, "each 'rules.weight' is 0; give one style a weight above it");
}

void check_streets(const CitySettings& settings, const toml::node& node, const Place& place) {
  const StreetOptions& streets = settings.streets;
  if (std::min(streets.street, streets.avenue) <= 2 * streets.pavement)
    place.refuse(node, "'streets.pavement' twice leaves nothing of a street; make streets wider");
  const double buildings = 1.0 * streets.blocks[0] * streets.blocks[1] * streets.buildings_per_block;
  if (buildings > 1e7)
    place.refuse(node,
                 fmt::format("{:.0f} buildings are more than 10 million; ask for fewer blocks", buildings));
}

}  // namespace

CitySettings parse_city_settings(const std::string& text, const std::string& name,
                                 const std::filesystem::path& base) {
  toml::table table;
  try {
    table = toml::parse(text);
  } catch (const toml::parse_error& error) {
    throw Error(ExitStatus::usage,
                fmt::format("{}: line {}: {}", name, error.source().begin.line, error.description()));
  }
  CitySettings settings;
  std::set<std::string> seen;
  for (const auto& [key, node] : table) {
    const Place place{name, base, std::string(key.str())};
    const bool section = place.key == "plan" || place.key == "streets";
    if (section && !node.is_table())
      place.refuse(node,
                   fmt::format("'{0}' must be a section; write [{0}] and its keys below it", place.key));
    if (section) {
      seen.insert(place.key);
      apply(settings, *node.as_table(), place.key + ".", place, city_keys(), seen);
    } else if (place.key == "seed") {
      city_keys().front().set(settings, node, place);
    } else if (place.key != "rules") {
      refuse_unknown(place, node, {"seed", "plan", "streets", "rules"});
    }
  }
  if (seen.count("plan") == seen.count("streets"))
    throw Error(ExitStatus::usage,
                name + ": give either [plan] with the file of a plan or [streets] to have one made up");
  if (seen.count("plan") && !seen.count("plan.file"))
    throw Error(ExitStatus::usage, name + ": 'plan.file' is missing; name the plan under [plan]");
  const Place place{name, base, "rules"};
  const toml::node* const rules = table.get("rules");
  if (rules == nullptr) throw Error(ExitStatus::usage, name + ": 'rules' is missing; add a [[rules]] entry");
  if (seen.count("streets")) check_streets(settings, *table.get("streets"), place);
  apply_rules(settings, *rules, place, seen.count("streets") > 0);
  return settings;
}

CitySettings load_city_settings(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  std::error_code ignored;
  const bool empty = std::filesystem::file_size(file, ignored) == 0;  // which is a configuration without keys
  if (std::filesystem::is_directory(file, ignored) || !in || !(empty || text << in.rdbuf()))
    throw Error(ExitStatus::input_output,
                file.string() + ": cannot read the configuration; check that the file exists");
  return parse_city_settings(text.str(), file.string(), std::filesystem::absolute(file).parent_path());
}

std::string describe_city_settings() {
  std::string out;
  const auto add = [&](const auto& keys) {
    for (const auto& key : keys)
      out += fmt::format("{}: {}; default {}\n    {}\n", key.path, key.range, key.initial, key.help);
  };
  add(city_keys());
  add(style_keys());
  return out;
}

}  // namespace veduta::city
