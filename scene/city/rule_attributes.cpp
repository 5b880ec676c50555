#include "scene/city/rule_attributes.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <span>

namespace veduta::city {
namespace {

void add_numbers(const WrittenRule& rule, const std::string& value, std::vector<int>& numbers) {
  for (const std::string& word : WantedValues(value).words) {
    const bool is_number =
        !word.empty() && word.size() <= 3 && word.find_first_not_of("0123456789") == std::string::npos;
    if (!is_number || (word.size() > 1 && word[0] == '0'))
      throw rule.place.error(
          fmt::format("'{}' does not count floors; give 0, 1, 2, or several as \"1|3\"", word));
    numbers.push_back(std::stoi(word));
  }
}

void check_words(const WrittenRule& rule, const std::string& name, const std::string& value,
                 std::span<const char* const> known) {
  for (const std::string& word : WantedValues(value).words)
    if (std::find(known.begin(), known.end(), word) == known.end())
      throw rule.place.error(
          fmt::format("{}=\"{}\" is never so; give one of: {}", name, word, fmt::join(known, ", ")));
}

void sort_unique(std::vector<int>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

}  // namespace

WantedValues::WantedValues(const std::string& text) : words(1), excluded(text.starts_with('!')) {
  for (const char c : text.substr(excluded ? 1 : 0)) {
    if (c == '|') {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
}

bool WantedValues::allow(const std::string& value) const {
  return (std::find(words.begin(), words.end(), value) != words.end()) != excluded;
}

AttributeTable attributes_of(const RulesDocument& document) {
  AttributeTable table;
  const auto add = [&](const std::string& name) {
    if (table.index.try_emplace(name, table.names.size()).second) table.names.push_back(name);
  };
  for (const char* name : built_in_attributes) add(name);
  for (const auto& [shape_name, shape] : document.shapes)
    for (const WrittenRule& rule : shape.rules)
      for (const auto& [name, value] : rule.attributes) {
        add(name);
        switch (table.index[name]) {
          case floor_attribute:
            check_words(rule, name, value, level_words);
            break;
          case storey_attribute:
            add_numbers(rule, value, table.storeys);
            break;
          case from_top_attribute:
            add_numbers(rule, value, table.from_top);
            break;
          case side_attribute:
            check_words(rule, name, value, side_words);
            break;
        }
      }
  sort_unique(table.storeys);
  sort_unique(table.from_top);
  return table;
}

void check_names(const RulesDocument& document, const std::map<std::string, uint32_t>& terminals,
                 const AttributeTable& attributes) {
  std::set<std::string> known, given(std::begin(built_in_attributes), std::end(built_in_attributes));
  for (const auto& [name, shape] : document.shapes) known.insert(name);
  for (const auto& [name, index] : terminals) known.insert(name);
  for (const auto& [shape_name, shape] : document.shapes)
    for (const WrittenRule& rule : shape.rules)
      for (const WrittenElement& element : rule.elements) {
        if (!known.contains(element.name))
          throw element.place.error(
              fmt::format("'{}' is neither a shape nor a terminal, below the root or in <Terminals>{}",
                          element.name, did_you_mean(element.name, known)));
        if (terminals.contains(element.name) && !element.attributes.empty())
          throw element.place.error(
              fmt::format("terminal '{}' has the attribute '{}'; only shapes with rules have attributes",
                          element.name, element.attributes[0].first));
        for (const auto& [name, value] : element.attributes) {
          if (!attributes.index.contains(name))
            throw element.place.error(
                fmt::format("no rule asks for the attribute '{}'{}", name,
                            did_you_mean(name, {attributes.names.begin(), attributes.names.end()})));
          given.insert(name);
        }
      }
  for (const auto& [shape_name, shape] : document.shapes)
    for (const WrittenRule& rule : shape.rules)
      for (const auto& [name, value] : rule.attributes)
        if (!given.contains(name))
          throw rule.place.error(fmt::format("no shape has the attribute '{}' of rule '{}'{}", name,
                                             rule.name, did_you_mean(name, given)));
}

}  // namespace veduta::city
