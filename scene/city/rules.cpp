// Names become indices, and attributes become states: every combination of a temporary shape and the values
// of its attributes that can be reached from a floor is a state, with the rules that apply to it. So a
// derivation looks at no name and no attribute, and what cannot end or has no rule is found here, before any
// building.
#include "scene/city/rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <span>

#include "scene/city/rules_document.h"
#include "scene/text.h"

namespace veduta::city {
namespace {

constexpr size_t most_states = 20000;
constexpr const char* levels[] = {"ground", "middle", "top"};
constexpr const char* sides[] = {"front", "street", "court"};

// A shape's name and the value of each attribute that a rule asks for; "" where it has none.
struct Situation {
  std::string shape;
  std::vector<std::string> values;
  auto operator<=>(const Situation&) const = default;
};

bool excludes(const std::string& value) {
  return value.starts_with('!');
}

// "a|b" and "!a|b" list a and b.
std::vector<std::string> alternatives(const std::string& value) {
  std::vector<std::string> words(1);
  for (const char c : value.substr(excludes(value) ? 1 : 0)) {
    if (c == '|') {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  return words;
}

class Compiler {
 public:
  explicit Compiler(RulesDocument document) : document_(std::move(document)) {}

  RuleSet compile() {
    rules_ = document_.settings;
    make_layers_and_terminals();
    collect_attributes();
    check_names();
    make_starts();
    while (done_ < situations_.size()) expand(static_cast<uint32_t>(done_++));
    check_that_it_ends();
    return std::move(rules_);
  }

 private:
  void make_layers_and_terminals() {
    const auto wall = document_.terminals.find("Wall");
    const bool own_wall = wall != document_.terminals.end();
    const std::string wall_layer = own_wall && !wall->second.layer.empty() ? wall->second.layer : "wall";
    rules_.wall_layer = layer_index(rules_.layers, wall_layer);
    rules_.ground_layer = layer_index(rules_.layers, "ground");
    rules_.roof.layer = layer_index(rules_.layers, document_.roof_layer);
    for (const WrittenCourse& written : document_.courses) {
      rules_.courses.push_back(written.course);
      rules_.courses.back().layer = layer_index(rules_.layers, written.layer);
    }
    if (!own_wall) add_terminal("Wall", {{}, "wall", document_.place}, wall_layer);
    for (const auto& [name, terminal] : document_.terminals) add_terminal(name, terminal, wall_layer);
    rules_.wall = terminal_index_.at("Wall");
  }

  void add_terminal(const std::string& name, const WrittenTerminal& written, const std::string& wall_layer) {
    if (const auto shape = document_.shapes.find(name); shape != document_.shapes.end())
      throw shape->second.place.error(
          fmt::format("'{}' is a terminal as well as a shape with rules; rename one", name));
    terminal_index_[name] = static_cast<uint32_t>(rules_.terminals.size());
    if (written.path.empty()) {
      std::string layer = written.layer.empty() ? name : written.layer;
      if (written.layer.empty())
        std::transform(layer.begin(), layer.end(), layer.begin(),
                       [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
      rules_.terminals.push_back(plain_terminal(name, layer_index(rules_.layers, layer)));
      return;
    }
    if (!std::filesystem::is_regular_file(written.path))
      throw written.place.error(fmt::format("terminal '{}': there is no file '{}'; check file=\"...\"", name,
                                            printable_path(written.path)));
    rules_.terminals.push_back(load_terminal(name, written.path, wall_layer, written.layer, rules_.layers));
  }

  static std::string printable_path(const std::filesystem::path& path) {
    return printable(path.lexically_normal().string(), 300);
  }

  void collect_attributes() {
    for (const char* builtin : {"Floor", "Storey", "FromTop", "Side"}) attributes_.push_back(builtin);
    for (const auto& [shape_name, shape] : document_.shapes)
      for (const WrittenRule& rule : shape.rules)
        for (const auto& [name, value] : rule.attributes) {
          if (attribute(name) == attributes_.size()) attributes_.push_back(name);
          if (name == "Storey") add_numbers(rule, value, rules_.storeys);
          if (name == "FromTop") add_numbers(rule, value, rules_.from_top);
          if (name == "Floor") check_words(rule, name, value, levels);
          if (name == "Side") check_words(rule, name, value, sides);
        }
  }

  static void add_numbers(const WrittenRule& rule, const std::string& value, std::vector<int>& numbers) {
    for (const std::string& word : alternatives(value)) {
      if (word.empty() || word.size() > 3 || word.find_first_not_of("0123456789") != std::string::npos)
        throw rule.place.error(
            fmt::format("'{}' does not count floors; give 0, 1, 2, or several as \"1|3\"", word));
      const int number = std::stoi(word);
      if (std::find(numbers.begin(), numbers.end(), number) == numbers.end()) numbers.push_back(number);
    }
  }

  static void check_words(const WrittenRule& rule, const std::string& name, const std::string& value,
                          std::span<const char* const> known) {
    for (const std::string& word : alternatives(value))
      if (std::find(known.begin(), known.end(), word) == known.end())
        throw rule.place.error(fmt::format("{}=\"{}\" is never so{}; give one of: {}", name, word,
                                           did_you_mean(word, {known.begin(), known.end()}),
                                           fmt::join(known, ", ")));
  }

  size_t attribute(const std::string& name) const {
    return static_cast<size_t>(std::find(attributes_.begin(), attributes_.end(), name) - attributes_.begin());
  }

  // Every element that a rule creates is a shape or a terminal, and every attribute has two sides: a rule
  // that asks for it, and a shape that has it.
  void check_names() const {
    std::vector<std::string> known, given{"Floor", "Storey", "FromTop", "Side"};
    for (const auto& [name, shape] : document_.shapes) known.push_back(name);
    for (const auto& [name, index] : terminal_index_) known.push_back(name);
    for (const auto& [shape_name, shape] : document_.shapes)
      for (const WrittenRule& rule : shape.rules)
        for (const WrittenElement& element : rule.elements) {
          if (std::find(known.begin(), known.end(), element.name) == known.end())
            throw element.place.error(
                fmt::format("'{}' is neither a shape nor a terminal{}; define it below the root, or in "
                            "<Terminals>",
                            element.name, did_you_mean(element.name, known)));
          if (terminal_index_.contains(element.name) && !element.attributes.empty())
            throw element.place.error(
                fmt::format("terminal '{}' has the attribute '{}'; only shapes with rules have attributes",
                            element.name, element.attributes[0].first));
          for (const auto& [name, value] : element.attributes) {
            if (attribute(name) == attributes_.size())
              throw element.place.error(fmt::format("no rule asks for the attribute '{}'{}; remove it", name,
                                                    did_you_mean(name, attributes_)));
            given.push_back(name);
          }
        }
    for (const auto& [shape_name, shape] : document_.shapes)
      for (const WrittenRule& rule : shape.rules)
        for (const auto& [name, value] : rule.attributes)
          if (std::find(given.begin(), given.end(), name) == given.end())
            throw rule.place.error(fmt::format("no shape has the attribute '{}' of rule '{}'{}; remove it",
                                               name, rule.name, did_you_mean(name, given)));
  }

  void make_starts() {
    if (!document_.shapes.contains("Floor"))
      throw document_.place.error("no shape 'Floor'; every derivation starts with it: add <Floor>");
    std::sort(rules_.storeys.begin(), rules_.storeys.end());
    std::sort(rules_.from_top.begin(), rules_.from_top.end());
    for (const char* level : levels)
      for (size_t storey = 0; storey <= rules_.storeys.size(); ++storey)
        for (size_t top = 0; top <= rules_.from_top.size(); ++top)
          for (const char* side : sides) {
            Situation floor{"Floor", std::vector<std::string>(attributes_.size())};
            floor.values[0] = level;
            floor.values[1] = number_or_other(rules_.storeys, storey);
            floor.values[2] = number_or_other(rules_.from_top, top);
            floor.values[3] = side;
            rules_.starts.push_back(is_possible(floor) ? state_of(floor, {}) : 0);
          }
  }

  // Ground floors, and only they, are storey 0; top floors are 0 from the top, and middle floors are not.
  bool is_possible(const Situation& floor) const {
    const bool asks_storey = !rules_.storeys.empty() && rules_.storeys[0] == 0;
    const bool asks_top = !rules_.from_top.empty() && rules_.from_top[0] == 0;
    const bool ground = floor.values[0] == "ground", top = floor.values[0] == "top";
    if (floor.values[1] == "0" ? !ground : ground && (asks_storey || floor.values[1] != "other"))
      return false;
    if (floor.values[2] == "0") return ground || top;
    return !top || (!asks_top && floor.values[2] == "other");
  }

  static std::string number_or_other(const std::vector<int>& numbers, size_t i) {
    return i < numbers.size() ? std::to_string(numbers[i]) : "other";
  }

  uint32_t state_of(const Situation& situation, const WrittenElement* element) {
    const auto [known, added] = index_.try_emplace(situation, static_cast<uint32_t>(situations_.size()));
    if (added) {
      if (situations_.size() >= most_states)
        throw document_.place.error(fmt::format(
            "more than {} combinations of shapes and attributes; use fewer attributes", most_states));
      situations_.push_back(situation);
      created_by_.push_back(element ? element->place : document_.shapes.at(situation.shape).place);
      rules_.states.emplace_back();
      same_size_.emplace_back();
    }
    return known->second;
  }

  // An attribute that both have eliminates the rule unless the values agree.
  bool applies(const WrittenRule& rule, const Situation& situation) const {
    return std::all_of(rule.attributes.begin(), rule.attributes.end(), [&](const auto& wanted) {
      const std::string& value = situation.values[attribute(wanted.first)];
      const std::vector<std::string> words = alternatives(wanted.second);
      const bool listed = std::find(words.begin(), words.end(), value) != words.end();
      return value.empty() || listed != excludes(wanted.second);
    });
  }

  void expand(uint32_t state) {
    const Situation situation = situations_[state];
    double weights = 0;
    for (const WrittenRule& rule : document_.shapes.at(situation.shape).rules) {
      if (rule.weight == 0 || !applies(rule, situation)) continue;
      weights += rule.weight;
      Choice choice;
      choice.split = split_index(rule);
      choice.weight = rule.weight;
      const bool may_stay = rule.split.type != Split::Type::fixed || rule.elements.size() == 1;
      for (const WrittenElement& element : rule.elements) {
        choice.cells.push_back(successor(situation, element));
        choice.cell_weights.push_back(element.weight);
        if (may_stay && !choice.cells.back().is_terminal)
          same_size_[state].push_back({choice.cells.back().index, &rule});
      }
      rules_.states[state].choices.push_back(std::move(choice));
    }
    if (!(weights > 0))
      throw created_by_[state].error(
          fmt::format("no rule applies to shape '{}'{}; add one without attributes", situation.shape,
                      described(situation)));
  }

  Successor successor(const Situation& parent, const WrittenElement& element) {
    if (const auto terminal = terminal_index_.find(element.name); terminal != terminal_index_.end())
      return {terminal->second, true};
    Situation child{element.name, parent.values};
    for (const auto& [name, value] : element.attributes) child.values[attribute(name)] = value;
    return {state_of(child, &element), false};
  }

  std::string described(const Situation& situation) const {
    std::string text;
    for (size_t i = 0; i < attributes_.size(); ++i)
      if (!situation.values[i].empty() && situation.values[i] != "other")
        text += fmt::format("{} {}=\"{}\"", text.empty() ? " with" : "", attributes_[i], situation.values[i]);
    return text;
  }

  uint32_t split_index(const WrittenRule& rule) {
    const auto [known, added] = split_of_.try_emplace(&rule, static_cast<uint32_t>(rules_.splits.size()));
    if (added) rules_.splits.push_back(rule.split);
    return known->second;
  }

  // A round of rules that each may leave the whole rectangle to the next never ends.
  void check_that_it_ends() const {
    std::vector<uint8_t> colour(situations_.size());  // 0 new, 1 on the path, 2 ends
    std::vector<std::pair<uint32_t, size_t>> path;
    for (uint32_t start = 0; start < situations_.size(); ++start) {
      if (colour[start] == 0) path.emplace_back(start, 0);
      while (!path.empty()) {
        auto& [state, next] = path.back();
        colour[state] = 1;
        if (next == same_size_[state].size()) {
          colour[state] = 2;
          path.pop_back();
          continue;
        }
        const auto [child, rule] = same_size_[state][next++];
        if (colour[child] == 1)
          throw rule->place.error(fmt::format(
              "rule '{}' of shape '{}' never ends: it leads back to '{}' without getting smaller; "
              "let one rule of the round split the shape or replace it by a terminal",
              rule->name, situations_[state].shape, situations_[child].shape));
        if (colour[child] == 0) path.emplace_back(child, 0);
      }
    }
  }

  struct SameSize {
    uint32_t state;
    const WrittenRule* rule;
  };

  RulesDocument document_;
  RuleSet rules_;
  std::map<std::string, uint32_t> terminal_index_;
  std::vector<std::string> attributes_;
  std::map<Situation, uint32_t> index_;
  std::vector<Situation> situations_;
  std::vector<Place> created_by_;                 // [states]
  std::vector<std::vector<SameSize>> same_size_;  // [states] what may be as large
  std::map<const WrittenRule*, uint32_t> split_of_;
  size_t done_ = 0;
};

}  // namespace

RuleSet load_rules(const std::filesystem::path& file) {
  return Compiler(read_rules_document(file)).compile();
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
