#include "scene/city/xml_element.h"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <cmath>

#include "scene/nearest_word.h"

namespace veduta::city {
namespace {

constexpr size_t most_attributes = 1000;

}

Error Place::error(const std::string& what) const {
  return bad_input(*file, fmt::format("line {}", line), what);
}

XmlFile::XmlFile(const std::filesystem::path& path)
    : input_(read_input(path)), name_(std::make_shared<const std::string>(input_.name)) {
  const std::string_view content = input_.content();
  for (size_t i = 0; i < content.size(); ++i)
    if (content[i] == '\n') line_ends_.push_back(i);
  const pugi::xml_parse_result result = document_.load_buffer(content.data(), content.size());
  if (!result)
    throw bad_input(*name_, fmt::format("line {}", line_of(result.offset)),
                    fmt::format("is not well-formed XML ({}); close every element and quote every value",
                                result.description()));
}

pugi::xml_node XmlFile::root() const {
  return document_.document_element();
}

Place XmlFile::place(pugi::xml_node node) const {
  return {name_, line_of(node.offset_debug())};
}

size_t XmlFile::line_of(ptrdiff_t offset) const {
  const auto at = static_cast<size_t>(std::max<ptrdiff_t>(offset, 0));
  const auto line = std::lower_bound(line_ends_.begin(), line_ends_.end(), at);
  return 1 + static_cast<size_t>(line - line_ends_.begin());
}

std::vector<XmlElement> XmlElement::children() const {
  std::vector<XmlElement> found;
  for (const pugi::xml_node child : node_.children())
    if (child.type() == pugi::node_element) found.emplace_back(*file_, child);
  return found;
}

std::string XmlElement::text(const char* attribute, const std::string& otherwise) const {
  return has(attribute) ? printable(node_.attribute(attribute).value(), 1000) : otherwise;
}

WrittenNumber written_number(std::string_view text) {
  WrittenNumber number;
  double value = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  const std::string_view unit(end, static_cast<size_t>(text.data() + text.size() - end));
  if (status != std::errc() || !std::isfinite(value) || (!unit.empty() && unit != "m")) return number;
  number.value = value;
  number.is_metres = unit == "m";
  return number;
}

double XmlElement::number(const char* attribute, double otherwise, double least, double most) const {
  if (!has(attribute)) return otherwise;
  const double value = written_number(node_.attribute(attribute).value()).value;
  if (!(value >= least && value <= most))
    throw place().error(fmt::format("{}=\"{}\" of <{}>; give a number from {} to {}", attribute,
                                    printable(node_.attribute(attribute).value(), 40), name(), least, most));
  return value;
}

Attributes XmlElement::attributes() const {
  Attributes found;
  for (const pugi::xml_attribute a : node_.attributes()) {
    if (found.size() >= most_attributes)
      throw place().error(
          fmt::format("<{}> has more than {} attributes; remove some", name(), most_attributes));
    for (const auto& [known, value] : found)
      if (known == a.name())
        throw place().error(fmt::format("<{}> has {} twice; remove one", name(), printable(a.name(), 60)));
    found.emplace_back(printable(a.name(), 60), printable(a.value(), 60));
  }
  return found;
}

void XmlElement::allow_only(std::initializer_list<const char*> known) const {
  for (const auto& [attribute, value] : attributes())
    if (std::find(known.begin(), known.end(), attribute) == known.end())
      throw place().error(fmt::format("<{}> knows no attribute '{}'{}", name(), attribute,
                                      did_you_mean(attribute, {known.begin(), known.end()})));
}

size_t XmlElement::one_of(const char* attribute, std::initializer_list<const char*> known) const {
  const std::string value = text(attribute, *known.begin());
  const auto found = std::find(known.begin(), known.end(), value);
  if (found != known.end()) return static_cast<size_t>(found - known.begin());
  throw place().error(fmt::format("{}=\"{}\" of <{}>; give one of: {}", attribute, value, name(),
                                  fmt::join(known.begin(), known.end(), ", ")));
}

std::string did_you_mean(const std::string& name, const std::set<std::string>& known) {
  return known.empty() ? "" : fmt::format("; did you mean '{}'?", nearest_word(name, known));
}

}  // namespace veduta::city
