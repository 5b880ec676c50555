#include "scene/readers/numbers.h"

#include <charconv>
#include <cstdlib>
#include <string>

namespace veduta {

std::optional<double> parse_number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (status == std::errc::invalid_argument || end != word.data() + word.size()) return std::nullopt;
  // from_chars does not say whether a number is too large or too small for a double; strtod does.
  if (status != std::errc()) value = std::strtod(std::string(word).c_str(), nullptr);
  return value;
}

}  // namespace veduta
