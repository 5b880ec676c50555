#include "farm/sweep_grid.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <sstream>

#include "farm/run_directory.h"
#include "scene/error.h"
#include "scene/nearest_word.h"
#include "worker/settings_keys.h"

namespace veduta {
namespace {

constexpr size_t most_points = 1000;

/// The models and where cells are made are the city, not a knob.
bool is_knob(const Key& key) {
  return !key.path.starts_with("scene.") && key.path != "cells.region";
}

/// Points in the order of their coming, each once.
class Grid {
 public:
  explicit Grid(const Settings& base) : base_(base), values_(list_settings(base)) { add(base); }

  void add(const Settings& settings) {
    GridPoint point{{}, settings};
    const auto values = list_settings(settings);
    for (size_t k = 0; k < values.size(); ++k)
      if (values[k] != values_[k]) point.changed.push_back(values[k]);
    const auto same = [&](const GridPoint& other) { return other.changed == point.changed; };
    if (std::none_of(points_.begin(), points_.end(), same)) points_.push_back(std::move(point));
  }

  const Settings& base() const { return base_; }
  std::vector<GridPoint> points() && { return std::move(points_); }

 private:
  Settings base_;
  std::vector<std::pair<std::string, std::string>> values_;
  std::vector<GridPoint> points_;
};

/// The base with keys set from TOML; left out when that is beyond their range.
void add_if_in_range(Grid& grid, const std::string& assignments) {
  Settings settings = grid.base();
  const std::string name = "the grid";
  const toml::table table = toml::parse(assignments);
  try {
    for (const Key& key : settings_keys())
      if (const auto node = table.at_path(key.path)) key.set(settings, *node.node(), {name, {}, key.path});
  } catch (const Error&) {
    return;
  }
  grid.add(settings);
}

/// The lists of one [[grid]], by key.
struct Axis {
  const Key* key;
  std::vector<const toml::node*> values;
};

void collect_axes(const toml::table& table, const std::string& prefix, const Place& place,
                  std::vector<Axis>& axes) {
  for (const auto& [name, node] : table) {
    Place here = place;
    here.key = prefix + std::string(name.str());
    if (node.is_table()) {
      collect_axes(*node.as_table(), here.key + ".", place, axes);
      continue;
    }
    std::set<std::string> known;
    for (const Key& key : settings_keys())
      if (is_knob(key)) known.insert(key.path);
    if (!known.contains(here.key))
      here.refuse(node, fmt::format("'{}' is no key that a grid can vary; did you mean '{}'?", here.key,
                                    nearest_word(here.key, known)));
    const auto key = std::find_if(settings_keys().begin(), settings_keys().end(),
                                  [&](const Key& k) { return k.path == here.key; });
    Axis axis{&*key, {}};
    if (const toml::array* list = node.as_array())
      for (const toml::node& value : *list) axis.values.push_back(&value);
    if (axis.values.empty())
      here.refuse(node, fmt::format("'{}' must be a list of values, such as [1, 2]", here.key));
    axes.push_back(std::move(axis));
  }
}

void add_combinations(Grid& grid, const std::vector<Axis>& axes, const Place& place) {
  std::vector<size_t> turn(axes.size(), 0);
  for (;;) {
    Settings settings = grid.base();
    for (size_t a = 0; a < axes.size(); ++a)
      axes[a].key->set(settings, *axes[a].values[turn[a]], {place.name, place.base, axes[a].key->path});
    grid.add(settings);
    size_t a = axes.size();
    while (a > 0 && ++turn[a - 1] == axes[a - 1].values.size()) turn[--a] = 0;
    if (a == 0) return;
  }
}

}  // namespace

std::vector<GridPoint> default_grid(const Settings& base) {
  Grid grid(base);
  for (const int parts : {1, 2, 4, 8, 16})
    add_if_in_range(grid, fmt::format("occlusion.subdivide = {}", parts));
  for (const double factor : {0.25, 0.5, 2.0})
    add_if_in_range(
        grid, fmt::format("occlusion.resolution = {}", static_cast<int>(base.occlusion.resolution * factor)));
  for (const double factor : {0.5, 2.0})
    add_if_in_range(grid, fmt::format("cells.size = {}", number_text(base.cells.size_m * factor)));
  add_if_in_range(grid,
                  fmt::format("navigation.seed_size = {}", number_text(base.navigation.seed_size_m * 2)));
  for (const int slices : {1, 4, 16}) add_if_in_range(grid, fmt::format("slices.max = {}", slices));
  for (const char* method : {"planes", "sections", "sealed", "vertex"})
    add_if_in_range(grid, fmt::format("shrink.method = \"{}\"", method));
  for (const double bound : {1.2, 2.0})
    add_if_in_range(grid, fmt::format("occlusion.max_overestimate = {}", number_text(bound)));
  for (const int parts : {1, 2})
    add_if_in_range(grid, fmt::format("occlusion.method = \"zoom\"\nocclusion.subdivide = {}", parts));
  return std::move(grid).points();
}

std::vector<GridPoint> read_grid(const std::filesystem::path& file, const Settings& base) {
  const auto text = read_text_file(file);
  const std::string name = file.string();
  if (!text)
    throw Error(ExitStatus::input_output, name + ": cannot read the grid; check that the file exists");
  toml::table table;
  try {
    table = toml::parse(*text);
  } catch (const toml::parse_error& error) {
    throw Error(ExitStatus::usage,
                fmt::format("{}: line {}: {}", name, error.source().begin.line, error.description()));
  }
  Grid grid(base);
  const Place place{name, file.parent_path(), ""};
  for (const auto& [key, node] : table) {
    const toml::array* const grids = key.str() == "grid" ? node.as_array() : nullptr;
    if (!grids) place.refuse(node, "only [[grid]] is known here, with lists of values by key below it");
    size_t all = 1;
    for (const toml::node& entry : *grids) {
      if (!entry.is_table()) place.refuse(entry, "a grid must be a table: write [[grid]]");
      std::vector<Axis> axes;
      collect_axes(*entry.as_table(), "", place, axes);
      size_t combinations = 1;
      for (const Axis& axis : axes) {
        combinations *= axis.values.size();
        if (combinations > most_points) break;
      }
      all += combinations;
      if (all > most_points)
        place.refuse(entry, fmt::format("these are more than {} points; write shorter lists", most_points));
      add_combinations(grid, axes, place);
    }
  }
  return std::move(grid).points();
}

}  // namespace veduta
