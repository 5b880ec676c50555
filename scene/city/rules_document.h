// A rules file as it is written, before names are resolved. Between rules_xml.cpp and rules.cpp.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "scene/city/rules.h"
#include "scene/error.h"

namespace veduta::city {

/// Where something is written.
struct Place {
  std::shared_ptr<const std::string> file;
  size_t line = 0;
  Error error(const std::string& what) const;
};

using Attributes = std::vector<std::pair<std::string, std::string>>;

/// A shape that a rule creates.
struct WrittenElement {
  std::string name;
  Attributes attributes;
  double weight = 1;
  Place place;
};

struct WrittenRule {
  std::string name;
  Attributes attributes;  ///< a value may list alternatives: "ground|top", "!2|3"
  double weight = 1;
  Split split;
  std::vector<WrittenElement> elements;
  Place place;
};

struct WrittenShape {
  std::vector<WrittenRule> rules;
  Place place;
};

struct WrittenTerminal {
  std::filesystem::path path;  ///< empty: a plain quad
  std::string layer;           ///< empty: as the file says
  Place place;
};

struct WrittenCourse {
  Course course;
  std::string layer = "cornice";
};

struct RulesDocument {
  std::map<std::string, WrittenShape> shapes;
  std::map<std::string, WrittenTerminal> terminals;
  std::vector<WrittenCourse> courses;
  std::string roof_layer = "roof";
  Place place;
  RuleSet settings;  ///< name, heights, roof and so on
};

/// \throw Error(bad_input) as load_rules does
RulesDocument read_rules_document(const std::filesystem::path& file);

/// "; did you mean 'Window'?", or nothing where no name is known.
std::string did_you_mean(const std::string& name, const std::set<std::string>& known);

}  // namespace veduta::city
