// Figures A.4 and A.5 of the thesis are the core of the format; docs/city-rules.md says what is beyond them.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "scene/city/xml_element.h"

namespace veduta::city {
namespace {

constexpr int most_includes_deep = 8;

double weight_of(const XmlElement& element) {
  if (element.has("weight") && element.has("probability"))
    throw element.place().error("both weight and probability; they mean the same: remove one");
  return element.number(element.has("weight") ? "weight" : "probability", 1, 0, 1e6);
}

Attributes without_weight(Attributes attributes) {
  std::erase_if(attributes, [](const auto& a) { return a.first == "weight" || a.first == "probability"; });
  return attributes;
}

// <xProportions x1="1" x2="0.5m"/>
std::vector<Length> proportions(const XmlElement& element, char axis) {
  std::vector<Length> lengths;
  for (const auto& [name, value] : element.attributes()) {
    const std::string expected = fmt::format("{}{}", axis, lengths.size() + 1);
    if (name != expected)
      throw element.place().error(
          fmt::format("<{}> has '{}' where '{}' should be; count from {}1 upwards without gaps",
                      element.name(), name, expected, axis));
    const WrittenNumber number = written_number(value);
    if (!(number.value > 0 && number.value <= 1e6))
      throw element.place().error(
          fmt::format("{}=\"{}\"; give a positive number: a proportion, or metres as \"0.5m\"", name, value));
    lengths.push_back({number.value, number.is_metres});
  }
  if (lengths.empty())
    throw element.place().error(fmt::format("<{}> without sizes; give {}1=\"1\"", element.name(), axis));
  if (std::all_of(lengths.begin(), lengths.end(), [](const Length& l) { return l.is_metres; }))
    throw element.place().error(fmt::format(
        "all sizes of <{}> are in metres; make one a proportion, so that the wall's own size fits",
        element.name()));
  return lengths;
}

WrittenElement read_element(const XmlElement& element) {
  if (!element.children().empty())
    throw element.children()[0].place().error(
        fmt::format("an element inside <{}>, which is created by a rule; define the shape {} on its own, "
                    "below the root",
                    element.name(), element.name()));
  return {element.name(), without_weight(element.attributes()), weight_of(element), element.place()};
}

void read_fixed(const XmlElement& fixed, WrittenRule& rule) {
  fixed.allow_only({});
  rule.split.columns = rule.split.rows = {Length{}};
  bool has_elements = false;
  std::vector<std::string> seen;
  for (const XmlElement& child : fixed.children()) {
    const std::string name = child.name();
    if (std::find(seen.begin(), seen.end(), name) != seen.end())
      throw child.place().error(fmt::format("a second <{}> in <Fixed>; remove one", name));
    seen.push_back(name);
    if (name == "xProportions") {
      rule.split.columns = proportions(child, 'x');
    } else if (name == "yProportions") {
      rule.split.rows = proportions(child, 'y');
    } else if (name == "Elements") {
      child.allow_only({});
      has_elements = true;
      for (const XmlElement& element : child.children()) rule.elements.push_back(read_element(element));
    } else {
      throw child.place().error(fmt::format(
          "<Fixed> knows no <{}>{}", name, did_you_mean(name, {"xProportions", "yProportions", "Elements"})));
    }
  }
  if (!has_elements) throw fixed.place().error("<Fixed> without <Elements>; list what stands in its cells");
  const size_t cells = rule.split.columns.size() * rule.split.rows.size();
  if (rule.elements.size() != cells)
    throw fixed.place().error(fmt::format(
        "{} elements for {} columns of {} rows; list {} of them, column by column, each from below",
        rule.elements.size(), rule.split.columns.size(), rule.split.rows.size(), cells));
}

void read_grid(const XmlElement& grid, WrittenRule& rule) {
  grid.allow_only({"minWidth", "minHeight"});
  rule.split.type = grid.name() == "Random" ? Split::Type::random : Split::Type::repeat;
  rule.split.min_width_m = grid.number("minWidth", 0, 0.05);
  rule.split.min_height_m = grid.number("minHeight", 0, 0.05);
  for (const XmlElement& element : grid.children()) rule.elements.push_back(read_element(element));
  double weights = 0;
  for (const WrittenElement& element : rule.elements) weights += element.weight;
  if (!(weights > 0))
    throw grid.place().error(
        fmt::format("<{}> without a shape to fill its cells; put one inside", grid.name()));
}

WrittenRule read_rule(const XmlElement& element, const std::string& shape) {
  WrittenRule rule{element.name(), without_weight(element.attributes()), weight_of(element), {}, {},
                   element.place()};
  rule.split.file = *rule.place.file;
  rule.split.place = fmt::format("line {}: rule '{}' of shape '{}'", rule.place.line, rule.name, shape);
  const std::vector<XmlElement> children = element.children();
  if (children.size() != 1)
    throw rule.place.error(
        fmt::format("rule '{}' of '{}' holds {} elements; it needs one: Fixed, Random, Repeat, or a shape "
                    "that replaces it",
                    rule.name, shape, children.size()));
  const XmlElement& body = children[0];
  if (body.name() == "Fixed") {
    read_fixed(body, rule);
  } else if (body.name() == "Random" || body.name() == "Repeat") {
    read_grid(body, rule);
  } else {
    rule.split.columns = rule.split.rows = {Length{}};
    rule.elements.push_back(read_element(body));
  }
  return rule;
}

void read_building(const XmlElement& element, RuleSet& settings) {
  element.allow_only({"groundHeight", "floorHeight", "topHeight", "minEdge", "vary"});
  settings.floor_height_m = element.number("floorHeight", 3, 0.5, 100);
  settings.ground_height_m = element.number("groundHeight", settings.floor_height_m, 0.5, 100);
  settings.top_height_m = element.number("topHeight", settings.floor_height_m, 0.5, 100);
  settings.min_edge_m = element.number("minEdge", 1, 0.05, 1000);
  settings.vary = static_cast<Vary>(element.one_of("vary", {"floor", "facade", "building"}));
}

void read_roof(const XmlElement& element, RulesDocument& document) {
  element.allow_only({"type", "pitch", "upperPitch", "height", "overhang", "parapet", "thickness", "layer"});
  Roof& roof = document.settings.roof;
  roof = Roof();
  roof.type = static_cast<Roof::Type>(element.one_of("type", {"flat", "gabled", "hipped", "mansard"}));
  roof.pitch_deg = element.number("pitch", roof.type == Roof::Type::mansard ? 70 : 35, 1, 85);
  roof.upper_pitch_deg = element.number("upperPitch", roof.upper_pitch_deg, 0, 85);
  roof.height_m = element.number("height", roof.height_m, 0.1, 100);
  roof.overhang_m = element.number("overhang", 0, 0, 5);
  roof.parapet_m = element.number("parapet", 0, 0, 10);
  roof.thickness_m = element.number("thickness", roof.thickness_m, 0.05, 2);
  document.roof_layer = element.text("layer", "roof");
}

WrittenCourse read_course(const XmlElement& element) {
  element.allow_only({"floor", "place", "height", "depth", "layer"});
  WrittenCourse written;
  if (element.has("floor")) written.course.levels = {false, false, false};
  std::string rest = element.text("floor");
  while (!rest.empty()) {
    const size_t end = std::min(rest.find('|'), rest.size());
    const std::string word = rest.substr(0, end);
    rest.erase(0, end + 1);
    const std::string words[] = {"ground", "middle", "top"};
    const auto found = std::find(std::begin(words), std::end(words), word);
    if (found == std::end(words))
      throw element.place().error(fmt::format(
          "floor=\"{}\" of <Course>; give ground, middle, top, or several as \"ground|top\"", word));
    written.course.levels[static_cast<size_t>(found - std::begin(words))] = true;
  }
  written.course.at_bottom = element.one_of("place", {"top", "bottom"}) == 1;
  written.course.height_m = element.number("height", written.course.height_m, 0.01, 10);
  written.course.depth_m = element.number("depth", written.course.depth_m, 0, 3);
  written.layer = element.text("layer", written.layer);
  return written;
}

void read_terminals(const XmlElement& list, RulesDocument& document, const std::filesystem::path& folder) {
  list.allow_only({});
  std::map<std::string, WrittenTerminal> read;
  for (const XmlElement& element : list.children()) {
    element.allow_only({"file", "layer"});
    WrittenTerminal terminal{{}, element.text("layer"), element.place()};
    if (element.has("file")) terminal.path = folder / element.text("file");
    if (!read.emplace(element.name(), terminal).second)
      throw element.place().error(fmt::format("terminal '{}' is there twice; remove one", element.name()));
  }
  for (auto& [name, terminal] : read) document.terminals.insert_or_assign(name, std::move(terminal));
}

// What this file says itself stands in place of what it includes, wherever the <Include> is.
void read_into(RulesDocument& document, const std::filesystem::path& path, int depth) {
  const XmlFile file(path);
  const XmlElement root(file, file.root());
  if (root.name() != "Rules")
    throw root.place().error(
        fmt::format("the root is <{}>; put all shapes of the style into <Rules>", root.name()));
  root.allow_only({"name"});
  const std::vector<XmlElement> children = root.children();
  for (const XmlElement& element : children) {
    if (element.name() != "Include") continue;
    element.allow_only({"file"});
    if (depth >= most_includes_deep)
      throw element.place().error(
          "files that include one another more than 8 deep; does one include itself?");
    const std::filesystem::path included = path.parent_path() / element.text("file");
    if (std::error_code ignored; !std::filesystem::is_regular_file(included, ignored))
      throw element.place().error(
          fmt::format("'{}' is not a file; check file=\"...\" of <Include>", element.text("file")));
    read_into(document, included, depth + 1);
  }
  document.place = root.place();
  document.settings.name = root.text("name", printable(path.stem().string()));
  std::set<std::string> own;
  std::vector<WrittenCourse> courses;
  for (const XmlElement& element : children) {
    const std::string name = element.name();
    if (name == "Include") continue;
    if (name == "Course") {
      courses.push_back(read_course(element));
      continue;
    }
    if (!own.insert(name).second)
      throw element.place().error(fmt::format("<{}> is there twice; put all of it into one", name));
    if (name == "Building") {
      read_building(element, document.settings);
    } else if (name == "Roof") {
      read_roof(element, document);
    } else if (name == "Terminals") {
      read_terminals(element, document, path.parent_path());
    } else {
      element.allow_only({});
      WrittenShape shape{{}, element.place()};
      for (const XmlElement& rule : element.children()) shape.rules.push_back(read_rule(rule, name));
      document.shapes.insert_or_assign(name, std::move(shape));
    }
  }
  if (!courses.empty()) document.courses = std::move(courses);
}

}  // namespace

RulesDocument read_rules_document(const std::filesystem::path& file) {
  RulesDocument document;
  read_into(document, file, 0);
  document.settings.file = *document.place.file;
  return document;
}

}  // namespace veduta::city
