#include "worker/settings_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/error.h"

namespace veduta {
namespace {

std::string toml_text(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      out += '\\', out += c;
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      out += fmt::format("\\u{:04X}", static_cast<unsigned char>(c));
    else
      out += c;
  }
  return out + '"';
}

std::string text_of(const toml::node& node, const Place& place, const char* what) {
  const auto value = node.is_string() ? node.value<std::string>() : std::nullopt;
  if (!value) place.refuse(node, fmt::format("'{}' must be {}", place.key, what));
  return *value;
}

using DoubleField = std::function<double&(Settings&)>;
using IntField = std::function<int&(Settings&)>;
using TextField = std::function<std::string&(Settings&)>;

Key real(std::string path, double low, double high, std::string unit, std::string help,
         const DoubleField& field) {
  const std::string range = fmt::format("{} to {} {}", low, high, unit);
  return {std::move(path),
          "number",
          range,
          std::move(help),
          [=](Settings& s, const toml::node& node, const Place& place) {
            const double value = finite_number(node, place);
            if (value < low || value > high)
              place.refuse(node, fmt::format("'{}' is {}; it must be {}", place.key, value, range));
            field(s) = value;
          },
          [=](const Settings& s) {
            Settings copy = s;
            return number_text(field(copy));
          }};
}

Key whole(std::string path, int low, int high, bool power_of_two, std::string help, const IntField& field) {
  const std::string range = fmt::format("{} to {}{}", low, high, power_of_two ? ", a power of two" : "");
  return {std::move(path),
          "whole number",
          range,
          std::move(help),
          [=](Settings& s, const toml::node& node, const Place& place) {
            if (!node.is_integer()) place.refuse(node, fmt::format("'{}' must be a whole number", place.key));
            const int64_t value = node.value<int64_t>().value_or(0);
            if (value < low || value > high || (power_of_two && (value & (value - 1)) != 0))
              place.refuse(node, fmt::format("'{}' is {}; it must be {}", place.key, value, range));
            field(s) = static_cast<int>(value);
          },
          [=](const Settings& s) {
            Settings copy = s;
            return std::to_string(field(copy));
          }};
}

Key choice(std::string path, std::vector<std::string> choices, std::string help, const TextField& field) {
  std::string range;
  for (const auto& each : choices) range += (range.empty() ? "" : ", ") + toml_text(each);
  return {std::move(path),
          "text",
          range,
          std::move(help),
          [=](Settings& s, const toml::node& node, const Place& place) {
            const std::string value = text_of(node, place, "a text");
            if (std::find(choices.begin(), choices.end(), value) == choices.end())
              place.refuse(node, fmt::format("'{}' is {}; it must be {}{}", place.key, toml_text(value),
                                             choices.size() > 1 ? "one of " : "", range));
            field(s) = value;
          },
          [=](const Settings& s) {
            Settings copy = s;
            return toml_text(field(copy));
          }};
}

Key text(std::string path, std::string range, std::string help, const TextField& field) {
  return {std::move(path),
          "text",
          std::move(range),
          std::move(help),
          [=](Settings& s, const toml::node& node, const Place& place) {
            field(s) = text_of(node, place, "a text");
          },
          [=](const Settings& s) {
            Settings copy = s;
            return toml_text(field(copy));
          }};
}

Key models() {
  return {"scene.model",
          "text or array of texts",
          "one model or more",
          "files, folders or archives of models (docs/importing.md); relative to this file",
          [](Settings& s, const toml::node& node, const Place& place) {
            std::vector<std::string> files;
            const auto add = [&](const toml::node& each) {
              const std::string file = text_of(each, place, "the name of a file or an array of them");
              if (file.empty())
                place.refuse(each, fmt::format("'{}' is empty; name a model file", place.key));
              files.push_back(std::filesystem::absolute(place.base / file).lexically_normal().string());
            };
            if (const toml::array* array = node.as_array())
              for (const toml::node& each : *array) add(each);
            else
              add(node);
            if (files.empty()) place.refuse(node, fmt::format("'{}' is empty; name a model file", place.key));
            s.scene.model = files;
          },
          [](const Settings& s) {
            std::string out = "[";
            for (const auto& file : s.scene.model) out += (out.size() > 1 ? ", " : "") + toml_text(file);
            return out + "]";
          }};
}

}  // namespace

std::string number_text(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

double finite_number(const toml::node& node, const Place& place) {
  const bool is_number = node.is_floating_point() || node.is_integer();
  const double value = is_number ? node.value<double>().value_or(NAN) : NAN;
  if (!is_number) place.refuse(node, fmt::format("'{}' must be a number", place.key));
  if (!std::isfinite(value)) place.refuse(node, fmt::format("'{}' must be a finite number", place.key));
  return value;
}

void Place::refuse(const toml::node& node, const std::string& what) const {
  throw Error(ExitStatus::usage, fmt::format("{}: line {}: {}", name, node.source().begin.line, what));
}

const std::vector<Key>& settings_keys() {
  static const std::vector<Key> table = {
      models(),
      real("scene.terrain_tile", 1, 10000, "m", "terrain is cut into square objects of this edge",
           [](Settings& s) -> double& { return s.scene.terrain_tile_m; }),
      choice("scene.up", {"auto", "y", "z"}, "axis of the files that points up; auto: as they say, else z",
             [](Settings& s) -> std::string& { return s.scene.up; }),
      real("scene.unit", 0, 1e6, "m", "metres in a unit of the files; 0: as they say, else 1",
           [](Settings& s) -> double& { return s.scene.unit_m; }),
      text("scene.crs", "a CRS like \"EPSG:28992\", or empty",
           "of the scene, and of files that state none; empty: that of the first file that states one",
           [](Settings& s) -> std::string& { return s.scene.crs; }),
      text("scene.height_field", "the name of an attribute, or empty",
           "of footprints: their height in m; empty: the usual names are tried",
           [](Settings& s) -> std::string& { return s.scene.height_field; }),
      text("scene.floors_field", "the name of an attribute, or empty",
           "of footprints: their number of floors; empty: the usual names are tried",
           [](Settings& s) -> std::string& { return s.scene.floors_field; }),
      real("scene.floor_height", 1, 100, "m", "of a floor, where footprints state floors and no height",
           [](Settings& s) -> double& { return s.scene.floor_height_m; }),
      choice("navigation.mode", {"walk", "fly"},
             "walk: cells at eye height above ground; fly: cells over a range of heights above ground",
             [](Settings& s) -> std::string& { return s.navigation.mode; }),
      real("navigation.seed_size", 0.01, 10, "m",
           "a gap of two seeds stays open (of three, where it is turned against the axes), a narrower one "
           "may close; a voxel is four seeds",
           [](Settings& s) -> double& { return s.navigation.seed_size_m; }),
      real("navigation.eye_height", 0.1, 100, "m", "walk: of the eye above ground, +- 0.25 m",
           [](Settings& s) -> double& { return s.navigation.eye_height_m; }),
      real("navigation.fly_lowest", -1000, 10000, "m",
           "fly: where cells begin, above the lowest ground below",
           [](Settings& s) -> double& { return s.navigation.fly_lowest_m; }),
      real("navigation.fly_highest", -1000, 10000, "m",
           "fly: where cells end, above the highest ground below",
           [](Settings& s) -> double& { return s.navigation.fly_highest_m; }),
      real("cells.size", 0.1, 1000, "m", "horizontal edge of a view-cell",
           [](Settings& s) -> double& { return s.cells.size_m; }),
      real("cells.height", 0.1, 1000, "m",
           "vertical edge of a view-cell; cells stack where the ground varies more",
           [](Settings& s) -> double& { return s.cells.height_m; }),
      whole("cells.largest", 1, 64, true,
            "fly: in open space, cells are up to this many times as large in each direction",
            [](Settings& s) -> int& { return s.cells.largest; }),
      region_key(),
      whole("slices.max", 1, 127, false, "most slices per axis of an object",
            [](Settings& s) -> int& { return s.slices.max; }),
      choice("shrink.method", {"planes", "sections", "sealed", "vertex"},
             "how occluders are shrunk by the view-cell",
             [](Settings& s) -> std::string& { return s.shrink.method; }),
      choice("occlusion.method", {"panorama", "zoom"},
             "how hidden objects are found; zoom: as the thesis does, for comparison",
             [](Settings& s) -> std::string& { return s.occlusion.method; }),
      whole("occlusion.resolution", 64, 4096, true,
            "pixels along the edge of a cube face, for the smallest parts",
            [](Settings& s) -> int& { return s.occlusion.resolution; }),
      whole("occlusion.subdivide", 1, 32, true, "a cell is divided down to subdivide x subdivide parts",
            [](Settings& s) -> int& { return s.occlusion.subdivide; }),
      real(
          "occlusion.max_overestimate", 1, 1000, "times",
          "a cell is divided until its row has no more objects than this many times those that rays have met",
          [](Settings& s) -> double& { return s.occlusion.max_overestimate; }),
      real("stereo.eye_margin", 0, 1, "m", "half the interocular distance: one look-up serves both eyes",
           [](Settings& s) -> double& { return s.stereo.eye_margin_m; }),
  };
  return table;
}

}  // namespace veduta
