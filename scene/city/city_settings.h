// The configuration of a generated city: one declaration of every key, from which reading and help are made.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scene/city/footprint_plan.h"
#include "scene/city/street_plan.h"

namespace veduta::city {

/// One [[rules]] entry: a style and how it is dealt out.
struct CityStyle {
  std::filesystem::path file;  ///< absolute
  Architecture architecture;   ///< depth, gap and courtyard count in made-up plans only
};

/// Either `plan` names a file or `streets` is to be made up. Lengths in m.
struct CitySettings {
  uint64_t seed = 1;
  std::filesystem::path plan_file;  ///< absolute; empty: `streets`
  ImportOptions plan_import;        ///< CRS, unit, names of fields
  FootprintOptions footprints;      ///< without styles and seed
  StreetOptions streets;            ///< without styles and seed
  std::vector<CityStyle> styles;
};

/// Reads a TOML file. Paths are relative to it.
/// \throw Error(usage) with file and line for an unknown key (naming the nearest known one), a wrong type, a
///   value out of range, buildings that do not fit their lots; Error(bad_input) with file and line when a
///   file that it names is missing; Error(input_output) when it cannot be read itself
CitySettings load_city_settings(const std::filesystem::path& file);

/// The same from text; `name` stands for the file in messages, paths are relative to `base`.
CitySettings parse_city_settings(const std::string& text, const std::string& name,
                                 const std::filesystem::path& base);

/// Every key with range, default and help, for `veduta city --help-config` and docs/city.md.
std::string describe_city_settings();

}  // namespace veduta::city
