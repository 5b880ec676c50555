// What somebody may have meant who mistyped a name.
#pragma once

#include <set>
#include <string>

namespace veduta {

/// The word that the fewest changed letters make of `word`; of several the first. \param known not empty
std::string nearest_word(const std::string& word, const std::set<std::string>& known);

}  // namespace veduta
