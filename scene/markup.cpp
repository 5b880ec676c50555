#include "scene/markup.h"

#include <fmt/format.h>

#include <cmath>

#include "scene/text.h"

namespace veduta {
namespace {

std::string superscript(int exponent) {
  constexpr const char* digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out = exponent < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(exponent))) out += digits[digit - '0'];
  return out;
}

}  // namespace

std::string escaped(std::string_view text, size_t max_bytes) {
  std::string out;
  for (const char c : printable(text, max_bytes)) switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  return out;
}

std::string count(uint64_t value) {
  std::string out = std::to_string(value);
  for (size_t at = out.size(); at > 3;) out.insert(at -= 3, ",");
  return out;
}

std::string figure(double value) {
  if (value == 0) return "0";
  if (value < 0) return "−" + figure(-value);
  // What it is after rounding decides how it is written: 9.996 is 10.0.
  const std::string rounded = fmt::format("{:.2e}", value);
  const size_t e = rounded.find('e');
  const int exponent = std::stoi(rounded.substr(e + 1));
  if (exponent < -3 || exponent > 8) return rounded.substr(0, e) + "·10" + superscript(exponent);
  if (exponent >= 2) return count(static_cast<uint64_t>(std::llround(value)));
  return fmt::format("{:.{}f}", value, 2 - exponent);
}

std::string round_figure(double value) {
  std::string out = figure(value);
  const size_t end = std::min(out.find("·"), out.size());  // of the digits
  if (out.find('.') >= end) return out;
  const size_t last = out.find_last_not_of('0', end - 1);
  return out.erase(last + (out[last] == '.' ? 0 : 1), end - last - (out[last] == '.' ? 0 : 1));
}

std::string px(double value) {
  return fmt::format("{:.1f}", value);
}

}  // namespace veduta
