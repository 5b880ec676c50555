// Keys of the configuration of a city: from this one table reading and help are made. For city_settings.cpp
// alone.
#pragma once

#include <toml++/toml.h>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "scene/city/city_settings.h"

namespace veduta::city {

/// Where a value stands, for messages.
struct Place {
  const std::string& name;
  const std::filesystem::path& base;
  std::string key;

  /// \throw Error(usage), "city.toml: line 12: what"
  [[noreturn]] void refuse(const toml::node& node, const std::string& what) const;
};

/// A key of a section, or of an entry of [[rules]].
template <typename Target>
struct Key {
  std::string path, range, initial, help;
  std::function<void(Target&, const toml::node&, const Place&)> set;
};

const std::vector<Key<CitySettings>>& city_keys();
const std::vector<Key<CityStyle>>& style_keys();

}  // namespace veduta::city
