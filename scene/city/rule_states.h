// Attributes turned into states.
#pragma once

#include "scene/city/rule_attributes.h"

namespace veduta::city {

/// Every combination of a temporary shape and the values of its attributes that can be reached from a floor
/// becomes a state, with the rules that apply to it: a derivation looks at no name and no attribute. Fills
/// `states`, `splits` and `starts` of the rule set, with its `storeys` and `from_top`.
/// \throw Error(bad_input) for a state that no rule applies to, and for rules that never end
void make_states(const RulesDocument& document, const std::map<std::string, uint32_t>& terminals,
                 const AttributeTable& attributes, RuleSet& rules);

}  // namespace veduta::city
