#include "scene/readers/dxf_groups.h"

#include <simdjson.h>

#include <charconv>
#include <cmath>
#include <optional>

namespace veduta {
namespace {

bool blank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

template <typename Number>
std::optional<Number> parsed(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  Number number = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (status != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

void append_utf8(std::string& text, uint32_t character) {
  if (character < 0x80) {
    text.push_back(static_cast<char>(character));
  } else if (character < 0x800) {
    text.push_back(static_cast<char>(0xC0 | (character >> 6)));
    text.push_back(static_cast<char>(0x80 | (character & 0x3F)));
  } else {
    text.push_back(static_cast<char>(0xE0 | (character >> 12)));
    text.push_back(static_cast<char>(0x80 | ((character >> 6) & 0x3F)));
    text.push_back(static_cast<char>(0x80 | (character & 0x3F)));
  }
}

// The four hexadecimal digits of "\U+00E9" at the start of the text.
std::optional<uint32_t> escaped_character(std::string_view text) {
  if (!text.starts_with("\\U+") || text.size() < 7) return std::nullopt;
  uint32_t character = 0;
  const auto [end, status] = std::from_chars(text.data() + 3, text.data() + 7, character, 16);
  if (status != std::errc() || end != text.data() + 7) return std::nullopt;
  return character;
}

}  // namespace

DxfGroups::DxfGroups(const InputFile& file) : file_(file), rest_(file.content()) {
  if (rest_.starts_with("AutoCAD Binary DXF"))
    throw bad_input(file.name, "line 1", "is binary DXF; save it as ASCII DXF");
  if (rest_.starts_with("AC10")) throw bad_input(file.name, "line 1", "is DWG; save it as ASCII DXF");
  if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
  const std::string_view first = trim(rest_.substr(0, rest_.find('\n')));
  if (first != "0" && first != "999")
    throw bad_input(file.name, "line 1",
                    "'" + printable(first, 40) + "' does not begin a DXF file; export it again");
}

void DxfGroups::next() {
  do {
    const std::string_view code = take_line();
    const std::optional<int> number = parsed<int>(code);
    if (!number) throw error("'" + printable(code, 40) + "' is not a group code; export the file again");
    code_ = *number;
    value_ = take_line();
  } while (code_ == 999);
}

std::string_view DxfGroups::take_line() {
  ++line_;
  if (rest_.empty()) throw error("the file ends before its EOF mark; it was cut short, export it again");
  const size_t end = rest_.find('\n');
  const std::string_view line = rest_.substr(0, end);
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  return trim(line);
}

double DxfGroups::real() const {
  const std::optional<double> number = parsed<double>(value_);
  if (!number) throw error("'" + printable(value_, 40) + "' is not a number");
  if (!std::isfinite(*number))
    throw error("'" + printable(value_, 40) + "' is not a finite number; repair it");
  return *number;
}

int64_t DxfGroups::integer() const {
  const std::optional<int64_t> number = parsed<int64_t>(value_);
  if (!number) throw error("'" + printable(value_, 40) + "' is not a whole number");
  return *number;
}

Error DxfGroups::error(const std::string& what) const {
  return bad_input(file_.name, "line " + std::to_string(line_), what);
}

std::string DxfGroups::place() const {
  return file_.name + ": line " + std::to_string(line_);
}

std::string dxf_name(std::string_view value) {
  const bool utf8 = simdjson::validate_utf8(value.data(), value.size());
  std::string name;
  while (!value.empty()) {
    const std::optional<uint32_t> escaped = escaped_character(value);
    if (escaped || !utf8) {
      append_utf8(name, escaped.value_or(static_cast<unsigned char>(value.front())));
    } else {
      name.push_back(value.front());
    }
    value.remove_prefix(escaped ? 7 : 1);
  }
  return printable(name, 10000);
}

}  // namespace veduta
