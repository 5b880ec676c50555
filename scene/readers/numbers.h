// Numbers in the text of model files.
#pragma once

#include <optional>
#include <string_view>

namespace veduta {

/// A whole word as a number, correctly rounded, whatever the locale. One leading '+' is allowed; "nan" and
/// "inf" are numbers, and what is too large for a double is infinite.
std::optional<double> parse_number(std::string_view word);

}  // namespace veduta
