// Texts and figures as a page shows them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace veduta {

/// Foreign text as it may stand in an element or in a quoted attribute: no markup, no control characters, at
/// most `max_bytes`.
std::string escaped(std::string_view text, size_t max_bytes = 200);

/// Three digits that count: "0", "0.0123", "1.53", "1,640", "3.21·10⁻⁷".
std::string figure(double value);

/// A round number: "0.25", "3", "3,000", "2·10⁻⁶".
std::string round_figure(double value);

/// "1,640"
std::string count(uint64_t value);

/// A coordinate in a picture: one decimal.
std::string px(double value);

}  // namespace veduta
