#include "scene/city/city_settings_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/text.h"

namespace veduta::city {
namespace {

double number_of(const toml::node& node, const Place& place, double low, double high) {
  const double value =
      node.is_floating_point() || node.is_integer() ? node.value<double>().value_or(NAN) : NAN;
  if (!(value >= low && value <= high))
    place.refuse(node, fmt::format("'{}' must be a number from {} to {}", place.key, low, high));
  return value;
}

int whole_of(const toml::node& node, const Place& place, int low, int high) {
  const int64_t value = node.is_integer() ? node.value<int64_t>().value_or(0) : int64_t{low} - 1;
  if (value < low || value > high)
    place.refuse(node, fmt::format("'{}' must be a whole number from {} to {}", place.key, low, high));
  return static_cast<int>(value);
}

std::string text_of(const toml::node& node, const Place& place) {
  const auto value = node.is_string() ? node.value<std::string>() : std::nullopt;
  if (!value || value->empty()) place.refuse(node, fmt::format("'{}' must be a text", place.key));
  return *value;
}

const toml::array& two_of(const toml::node& node, const Place& place) {
  const toml::array* const array = node.as_array();
  if (array == nullptr || array->size() != 2)
    place.refuse(node, fmt::format("'{}' must be two numbers, [a, b]", place.key));
  return *array;
}

template <typename Target, typename Field>
Key<Target> real(std::string path, double low, double high, std::string help, Field field) {
  Target initial;
  return {std::move(path), fmt::format("{} to {}", low, high), fmt::format("{}", field(initial)),
          std::move(help), [=](Target& target, const toml::node& node, const Place& place) {
            field(target) = number_of(node, place, low, high);
          }};
}

template <typename Target, typename Field>
Key<Target> whole(std::string path, int low, int high, std::string help, Field field) {
  Target initial;
  return {std::move(path), fmt::format("whole, {} to {}", low, high), fmt::format("{}", field(initial)),
          std::move(help), [=](Target& target, const toml::node& node, const Place& place) {
            field(target) = whole_of(node, place, low, high);
          }};
}

template <typename Target, typename Field>
Key<Target> text(std::string path, std::string help, Field field) {
  return {std::move(path), "text", "none", std::move(help),
          [=](Target& target, const toml::node& node, const Place& place) {
            field(target) = text_of(node, place);
          }};
}

/// Two numbers; `ascending`: from, to.
template <typename Target, typename Field>
Key<Target> pair(std::string path, bool ascending, double low, double high, std::string help, Field field) {
  Target initial;
  const auto values = field(initial);
  const std::string range = fmt::format("[a, b], {} to {}{}", low, high, ascending ? ", a <= b" : "");
  return {std::move(path), range, fmt::format("[{}, {}]", values[0], values[1]), std::move(help),
          [=](Target& target, const toml::node& node, const Place& place) {
            const toml::array& array = two_of(node, place);
            auto& pair = field(target);
            for (size_t i = 0; i < 2; ++i) {
              if constexpr (std::is_same_v<std::decay_t<decltype(pair[0])>, int>)
                pair[i] = whole_of(array[i], place, static_cast<int>(low), static_cast<int>(high));
              else
                pair[i] = number_of(array[i], place, low, high);
            }
            if (ascending && pair[0] > pair[1])
              place.refuse(node, fmt::format("'{}' must be [from, to], from <= to", place.key));
          }};
}

template <typename Target, typename Field>
Key<Target> existing_file(std::string path, std::string help, Field field) {
  return {std::move(path), "a file, relative to this one", "required", std::move(help),
          [=](Target& target, const toml::node& node, const Place& place) {
            const std::string file = text_of(node, place);
            field(target) = std::filesystem::absolute(place.base / file).lexically_normal();
            if (std::error_code ignored; !std::filesystem::exists(field(target), ignored))
              throw bad_input(place.name, fmt::format("line {}", node.source().begin.line),
                              fmt::format("'{}' names {}, which does not exist; check the path", place.key,
                                          printable(field(target).string(), 400)));
          }};
}

Key<CitySettings> seed() {
  return {"seed", "whole, 0 or more", "1", "another seed, another city",
          [](CitySettings& settings, const toml::node& node, const Place& place) {
            const int64_t value = node.is_integer() ? node.value<int64_t>().value_or(-1) : -1;
            if (value < 0) place.refuse(node, "'seed' must be a whole number, 0 or more");
            settings.seed = static_cast<uint64_t>(value);
          }};
}

Key<CitySettings> use() {
  return {"plan.use", "array of \"floors\", \"heights\", \"ground\"", "all three",
          "what to take from the plan besides outlines; floors are drawn and ground is level otherwise",
          [](CitySettings& settings, const toml::node& node, const Place& place) {
            FootprintOptions& options = settings.footprints;
            options.use_floors = options.use_heights = options.use_ground = false;
            if (!node.is_array())
              place.refuse(node, "'plan.use' must be an array, such as [\"floors\", \"ground\"]");
            for (const toml::node& each : *node.as_array()) {
              const std::string what = text_of(each, place);
              if (what != "floors" && what != "heights" && what != "ground")
                place.refuse(each, fmt::format("'plan.use' holds \"{}\"; it may hold \"floors\", \"heights\" "
                                               "and \"ground\"",
                                               printable(what, 40)));
              (what == "floors"    ? options.use_floors
               : what == "heights" ? options.use_heights
                                   : options.use_ground) = true;
            }
          }};
}

Key<CitySettings> buildings_per_block() {
  return {"streets.buildings_per_block", "whole and even, 2 to 1000", "6", "in two rows, back to back",
          [](CitySettings& settings, const toml::node& node, const Place& place) {
            const int value = whole_of(node, place, 2, 1000);
            if (value % 2 != 0) place.refuse(node, fmt::format("'{}' must be even", place.key));
            settings.streets.buildings_per_block = value;
          }};
}

}  // namespace

void Place::refuse(const toml::node& node, const std::string& what) const {
  throw Error(ExitStatus::usage, fmt::format("{}: line {}: {}", name, node.source().begin.line, what));
}

const std::vector<Key<CitySettings>>& city_keys() {
  using S = CitySettings;
  static const std::vector<Key<S>> table = {
      seed(),
      existing_file<S>(
          "plan.file", "footprints: GeoJSON, Shapefile, DXF or CityJSON",
          [](S & s) -> auto& { return s.plan_file; }),
      use(),
      text<S>(
          "plan.crs", "of a plan that states none (\"EPSG:3946\")",
          [](S & s) -> auto& { return s.plan_import.crs; }),
      real<S>(
          "plan.unit", 0, 1e6, "metres in a unit of the plan; 0: what the plan says, else 1",
          [](S & s) -> auto& { return s.plan_import.unit_m; }),
      text<S>(
          "plan.floors_field", "attribute that holds the number of floors; none: the usual names",
          [](S & s) -> auto& { return s.plan_import.floors_field; }),
      text<S>(
          "plan.height_field", "attribute that holds the height in m; none: the usual names",
          [](S & s) -> auto& { return s.plan_import.height_field; }),
      real<S>(
          "plan.floor_height", 2, 8, "m; how many floors a building of known height has",
          [](S & s) -> auto& { return s.footprints.floor_height_m; }),
      real<S>(
          "plan.margin", 0, 10000, "m of terrain around the footprints",
          [](S & s) -> auto& { return s.footprints.margin_m; }),
      pair<S>(
          "streets.blocks", false, 1, 1000, "blocks along x and y",
          [](S & s) -> auto& { return s.streets.blocks; }),
      buildings_per_block(),
      pair<S>(
          "streets.lot", false, 4, 1000, "m; of a building, along the street and away from it",
          [](S & s) -> auto& { return s.streets.lot; }),
      real<S>(
          "streets.street", 1, 1000, "m from facade to facade",
          [](S & s) -> auto& { return s.streets.street; }),
      real<S>(
          "streets.avenue", 1, 1000, "m from facade to facade",
          [](S & s) -> auto& { return s.streets.avenue; }),
      whole<S>(
          "streets.avenue_every", 1, 1000, "each so many-th street is an avenue, the first is one",
          [](S & s) -> auto& { return s.streets.avenue_every; }),
      real<S>(
          "streets.pavement", 0, 100, "m in front of the facades, within the street",
          [](S & s) -> auto& { return s.streets.pavement; }),
      whole<S>(
          "streets.variants", 0, 100000,
          "different buildings of each style, shared by all; 0: each building is one of its own",
          [](S & s) -> auto& { return s.streets.variants; }),
  };
  return table;
}

const std::vector<Key<CityStyle>>& style_keys() {
  using S = CityStyle;
  static const std::vector<Key<S>> table = {
      existing_file<S>(
          "rules.file", "a style (docs/city-rules.md)", [](S & s) -> auto& { return s.file; }),
      real<S>(
          "rules.weight", 0, 1e6, "how often it is chosen; 0: never",
          [](S & s) -> auto& { return s.architecture.weight; }),
      pair<S>(
          "rules.floors", true, 1, 200, "from, to; where the plan does not say",
          [](S & s) -> auto& { return s.architecture.floors; }),
      pair<S>(
          "rules.depth", true, 2, 1000, "m from the street to the rear wall; from, to; with [streets]",
          [](S & s) -> auto& { return s.architecture.depth; }),
      real<S>(
          "rules.gap", 0, 100, "m between the sides and the lot's; 0: walls touch; with [streets]",
          [](S & s) -> auto& { return s.architecture.gap; }),
      real<S>(
          "rules.courtyard", 0, 1, "share of buildings with a courtyard; with [streets]",
          [](S & s) -> auto& { return s.architecture.courtyard; }),
  };
  return table;
}

}  // namespace veduta::city
