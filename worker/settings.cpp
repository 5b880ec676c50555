#include "worker/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

#include "scene/error.h"
#include "scene/nearest_word.h"
#include "worker/settings_keys.h"

namespace veduta {
namespace {

std::string section(const std::string& path) {
  return path.substr(0, path.find('.'));
}
std::string leaf(const std::string& path) {
  return path.substr(path.find('.') + 1);
}

[[noreturn]] void refuse_unknown(const Place& place, const toml::node& node,
                                 const std::set<std::string>& known) {
  place.refuse(
      node, fmt::format("unknown key '{}'; did you mean '{}'?", place.key, nearest_word(place.key, known)));
}

void apply_section(Settings& settings, const std::string& name_of_section, const toml::table& table,
                   Place place, std::set<std::string>& seen) {
  std::set<std::string> known;
  for (const Key& key : settings_keys()) known.insert(key.path);
  for (const auto& [name, node] : table) {
    place.key = name_of_section + "." + std::string(name.str());
    const auto key = std::find_if(settings_keys().begin(), settings_keys().end(),
                                  [&](const Key& k) { return k.path == place.key; });
    if (key == settings_keys().end()) refuse_unknown(place, node, known);
    key->set(settings, node, place);
    seen.insert(place.key);
  }
}

}  // namespace

Settings parse_settings(const std::string& text, const std::string& name, const std::filesystem::path& base) {
  toml::table table;
  try {
    table = toml::parse(text);
  } catch (const toml::parse_error& error) {
    throw Error(ExitStatus::usage,
                fmt::format("{}: line {}: {}", name, error.source().begin.line, error.description()));
  }
  std::set<std::string> sections, seen;
  for (const Key& key : settings_keys()) sections.insert(section(key.path));
  Settings settings;
  for (const auto& [key, node] : table) {
    const Place place{name, base, std::string(key.str())};
    if (!sections.count(place.key)) refuse_unknown(place, node, sections);
    if (!node.is_table())
      place.refuse(node, fmt::format("'{}' must be a section; write [{}] and its keys below it", place.key,
                                     place.key));
    apply_section(settings, place.key, *node.as_table(), place, seen);
  }
  if (!seen.count("scene.model"))
    throw Error(ExitStatus::usage, name + ": 'scene.model' is missing; name a model file under [scene]");
  if (settings.navigation.fly_lowest_m >= settings.navigation.fly_highest_m)
    throw Error(ExitStatus::usage,
                fmt::format("{}: 'navigation.fly_lowest' is {}; it must be below "
                            "'navigation.fly_highest', which is {}",
                            name, settings.navigation.fly_lowest_m, settings.navigation.fly_highest_m));
  return settings;
}

Settings load_settings(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored) || !in || !(text << in.rdbuf()))
    throw Error(ExitStatus::input_output,
                file.string() + ": cannot read the configuration; check that the file exists");
  return parse_settings(text.str(), file.string(), std::filesystem::absolute(file).parent_path());
}

std::string to_toml(const Settings& settings) {
  std::string out, open;
  for (const auto& [path, value] : list_settings(settings)) {
    if (section(path) != open) out += fmt::format("{}[{}]\n", out.empty() ? "" : "\n", section(path));
    open = section(path);
    out += fmt::format("{} = {}\n", leaf(path), value);
  }
  return out;
}

std::vector<std::pair<std::string, std::string>> list_settings(const Settings& settings) {
  std::vector<std::pair<std::string, std::string>> values;
  for (const Key& key : settings_keys()) values.emplace_back(key.path, key.get(settings));
  return values;
}

std::string describe_settings() {
  const Settings defaults;
  std::string out;
  for (const Key& key : settings_keys()) {
    const std::string value = key.path == "scene.model" ? "required" : "default " + key.get(defaults);
    out += fmt::format("{}: {}; {}; {}\n    {}\n", key.path, key.type, key.range, value, key.help);
  }
  return out;
}

}  // namespace veduta
