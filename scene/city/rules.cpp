#include "scene/city/rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "scene/city/rule_states.h"
#include "scene/text.h"

namespace veduta::city {
namespace {

using TerminalIndex = std::map<std::string, uint32_t>;

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

Terminal make_terminal(const std::string& name, const WrittenTerminal& written, const std::string& wall_layer,
                       std::vector<std::string>& layers) {
  if (written.path.empty())
    return plain_terminal(name, layer_index(layers, written.layer.empty() ? lower(name) : written.layer));
  if (std::error_code ignored; !std::filesystem::is_regular_file(written.path, ignored))
    throw written.place.error(fmt::format("terminal '{}': there is no file '{}'; check file=\"...\"", name,
                                          printable(written.path.lexically_normal().string(), 300)));
  return load_terminal(name, written.path, wall_layer, written.layer, layers);
}

// The layers and terminals of the style, and where each terminal is.
TerminalIndex make_terminals(const RulesDocument& document, RuleSet& rules) {
  std::map<std::string, WrittenTerminal> terminals = document.terminals;
  const WrittenTerminal& wall =
      terminals.try_emplace("Wall", WrittenTerminal{{}, "", document.place}).first->second;
  const std::string wall_layer = wall.layer.empty() ? "wall" : wall.layer;
  rules.wall_layer = layer_index(rules.layers, wall_layer);
  rules.ground_layer = layer_index(rules.layers, "ground");
  rules.roof.layer = layer_index(rules.layers, document.roof_layer);
  for (const WrittenCourse& written : document.courses) {
    rules.courses.push_back(written.course);
    rules.courses.back().layer = layer_index(rules.layers, written.layer);
  }
  TerminalIndex index;
  for (const auto& [name, terminal] : terminals) {
    if (const auto shape = document.shapes.find(name); shape != document.shapes.end())
      throw shape->second.place.error(
          fmt::format("'{}' is a terminal as well as a shape with rules; rename one", name));
    index[name] = static_cast<uint32_t>(rules.terminals.size());
    rules.terminals.push_back(make_terminal(name, terminal, wall_layer, rules.layers));
  }
  rules.wall = index.at("Wall");
  return index;
}

}  // namespace

RuleSet load_rules(const std::filesystem::path& file) {
  const RulesDocument document = read_rules_document(file);
  RuleSet rules = document.settings;
  const TerminalIndex terminals = make_terminals(document, rules);
  const AttributeTable attributes = attributes_of(document);
  check_names(document, terminals, attributes);
  make_states(document, terminals, attributes, rules);
  return rules;
}

uint32_t RuleSet::start(int floor, int floor_count, Side side) const {
  const size_t level = floor == 0 ? 0 : floor == floor_count - 1 ? 2 : 1;
  const auto place = [](const std::vector<int>& numbers, int number) {
    return static_cast<size_t>(std::find(numbers.begin(), numbers.end(), number) - numbers.begin());
  };
  const size_t storey = place(storeys, floor), top = place(from_top, floor_count - 1 - floor);
  const size_t row = (level * (storeys.size() + 1) + storey) * (from_top.size() + 1) + top;
  return starts[row * 3 + static_cast<size_t>(side)];
}

std::vector<double> floor_heights_m(const RuleSet& rules, int floors, double height_m) {
  std::vector<double> heights(static_cast<size_t>(std::max(floors, 1)), rules.floor_height_m);
  if (heights.size() > 1) heights.back() = rules.top_height_m;
  heights.front() = rules.ground_height_m;
  double sum = 0;
  for (const double height : heights) sum += height;
  if (height_m > 0)
    for (double& height : heights) height *= height_m / sum;
  return heights;
}

}  // namespace veduta::city
