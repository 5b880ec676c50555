// One declaration of every configuration key: from it reading, writing and help are made. For settings.cpp
// alone.
#pragma once

#include <toml++/toml.h>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "worker/settings.h"

namespace veduta {

/// Where a value stands, for messages.
struct Place {
  const std::string& name;
  const std::filesystem::path& base;
  std::string key;

  [[noreturn]] void refuse(const toml::node& node, const std::string& what) const;
};

/// One key: its declaration, and how it is taken from TOML and written back.
struct Key {
  std::string path, type, range, help;
  std::function<void(Settings&, const toml::node&, const Place&)> set;
  std::function<std::string(const Settings&)> get;
};

/// A number of either kind. Refuses what is none, NaN and infinity.
double finite_number(const toml::node& node, const Place& place);
/// The shortest text that reads back as the same double, and reads as a float in TOML.
std::string number_text(double value);

Key region_key();

/// Every key, in the order of run.toml; defaults are those of Settings.
const std::vector<Key>& settings_keys();

}  // namespace veduta
