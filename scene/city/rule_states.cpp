#include "scene/city/rule_states.h"

#include <fmt/format.h>

#include <algorithm>

namespace veduta::city {
namespace {

constexpr size_t most_states = 20000;
constexpr size_t most_links = 2'000'000;  // from states to what may stand in their cells

// A shape's name and the value of each attribute that a rule asks for; "" where it has none.
struct Situation {
  std::string shape;
  std::vector<std::string> values;
  auto operator<=>(const Situation&) const = default;
};

class StateMaker {
 public:
  StateMaker(const RulesDocument& document, const std::map<std::string, uint32_t>& terminals,
             const AttributeTable& attributes, RuleSet& rules)
      : document_(document), terminals_(terminals), attributes_(attributes), rules_(rules) {}

  void make() {
    rules_.storeys = attributes_.storeys;
    rules_.from_top = attributes_.from_top;
    make_starts();
    for (size_t done = 0; done < situations_.size(); ++done) expand(static_cast<uint32_t>(done));
    check_that_it_ends();
  }

 private:
  void make_starts() {
    if (!document_.shapes.contains("Floor"))
      throw document_.place.error("no shape 'Floor'; every derivation starts with it: add <Floor>");
    for (const char* level : level_words)
      for (size_t storey = 0; storey <= rules_.storeys.size(); ++storey)
        for (size_t top = 0; top <= rules_.from_top.size(); ++top)
          for (const char* side : side_words) {
            Situation floor{"Floor", std::vector<std::string>(attributes_.names.size())};
            floor.values[floor_attribute] = level;
            floor.values[storey_attribute] = number_or_other(rules_.storeys, storey);
            floor.values[from_top_attribute] = number_or_other(rules_.from_top, top);
            floor.values[side_attribute] = side;
            rules_.starts.push_back(is_possible(floor) ? state_of(floor, {}) : 0);
          }
  }

  // Ground floors, and only they, are storey 0; top floors are 0 from the top, and middle floors are not.
  bool is_possible(const Situation& floor) const {
    const bool asks_storey = !rules_.storeys.empty() && rules_.storeys[0] == 0;
    const bool asks_top = !rules_.from_top.empty() && rules_.from_top[0] == 0;
    const bool ground = floor.values[floor_attribute] == "ground",
               top = floor.values[floor_attribute] == "top";
    if (floor.values[storey_attribute] == "0"
            ? !ground
            : ground && (asks_storey || floor.values[storey_attribute] != "other"))
      return false;
    if (floor.values[from_top_attribute] == "0") return ground || top;
    return !top || (!asks_top && floor.values[from_top_attribute] == "other");
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
      const std::string& value = situation.values[attributes_.index.at(wanted.first)];
      return value.empty() || WantedValues(wanted.second).allow(value);
    });
  }

  void expand(uint32_t state) {
    const Situation situation = situations_[state];
    double weights = 0;
    for (const WrittenRule& rule : document_.shapes.at(situation.shape).rules) {
      if (rule.weight == 0 || !applies(rule, situation)) continue;
      weights += rule.weight;
      links_ += rule.elements.size();
      if (links_ > most_links)
        throw rule.place.error("too many elements for all combinations of attributes; use fewer of either");
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
    if (const auto terminal = terminals_.find(element.name); terminal != terminals_.end())
      return {terminal->second, true};
    Situation child{element.name, parent.values};
    for (const auto& [name, value] : element.attributes) child.values[attributes_.index.at(name)] = value;
    return {state_of(child, &element), false};
  }

  std::string described(const Situation& situation) const {
    std::string text;
    for (size_t i = 0; i < attributes_.names.size(); ++i)
      if (!situation.values[i].empty() && situation.values[i] != "other")
        text += fmt::format("{} {}=\"{}\"", text.empty() ? " with" : "", attributes_.names[i],
                            situation.values[i]);
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

  const RulesDocument& document_;
  const std::map<std::string, uint32_t>& terminals_;
  const AttributeTable& attributes_;
  RuleSet& rules_;
  std::map<Situation, uint32_t> index_;
  std::vector<Situation> situations_;
  std::vector<Place> created_by_;                 // [states]
  std::vector<std::vector<SameSize>> same_size_;  // [states] what may be as large
  std::map<const WrittenRule*, uint32_t> split_of_;
  size_t links_ = 0;
};

}  // namespace

void make_states(const RulesDocument& document, const std::map<std::string, uint32_t>& terminals,
                 const AttributeTable& attributes, RuleSet& rules) {
  StateMaker(document, terminals, attributes, rules).make();
}

}  // namespace veduta::city
