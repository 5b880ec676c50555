// The attributes of shapes and rules: which there are, and what values rules ask for.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scene/city/rules_document.h"

namespace veduta::city {

/// Attributes that every floor has, with the words that they can be; Storey and FromTop are numbers.
enum BuiltIn : size_t { floor_attribute, storey_attribute, from_top_attribute, side_attribute };
inline constexpr const char* built_in_attributes[] = {"Floor", "Storey", "FromTop", "Side"};
inline constexpr const char* level_words[] = {"ground", "middle", "top"};  ///< by Level
inline constexpr const char* side_words[] = {"front", "street", "court"};  ///< by Side

/// "a|b": a or b. "!a|b": neither a nor b.
struct WantedValues {
  explicit WantedValues(const std::string& text);
  bool allow(const std::string& value) const;
  std::vector<std::string> words;
  bool excluded = false;
};

/// The attributes that rules ask for, numbered; the built-in ones come first.
struct AttributeTable {
  std::vector<std::string> names;
  std::map<std::string, size_t> index;
  std::vector<int> storeys, from_top;  ///< numbers that rules ask for, ascending
};

/// \throw Error(bad_input) for a rule that asks for a value which a built-in attribute never has
AttributeTable attributes_of(const RulesDocument& document);

/// Every element that a rule creates is a shape or a terminal, and every attribute has two sides: a rule that
/// asks for it, and a shape that has it. \throw Error(bad_input) where not
void check_names(const RulesDocument& document, const std::map<std::string, uint32_t>& terminals,
                 const AttributeTable& attributes);

}  // namespace veduta::city
