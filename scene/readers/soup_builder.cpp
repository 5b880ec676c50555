#include "scene/readers/soup_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "scene/names.h"
#include "scene/readers/numbers.h"

namespace veduta {
namespace {

constexpr std::string_view blanks = " \t\r\v\f";

}  // namespace

SoupBuilder::SoupBuilder(const InputFile& file, const std::string& format, ImportReport& report)
    : file_(file), report_(report) {
  model_.file = file.name;
  model_.format = format;
  model_.has_objects = false;
}

Error SoupBuilder::error(const SoupPlace& place, const std::string& what) const {
  return bad_input(file_.name, place.text(), what);
}

void SoupBuilder::drop(const std::string& reason, const SoupPlace& place, uint64_t count) {
  if (count > 0) count_dropped(report_, reason, file_.name + ": " + place.text(), count);
}

void SoupBuilder::add_vertex(const glm::dvec3& p, const SoupPlace& place) {
  if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
    throw error(place, "a coordinate is not a finite number; repair the vertex");
  if (model_.vertices.size() >= std::numeric_limits<uint32_t>::max())
    throw error(place, "more than 4 billion vertices; cut the model into tiles");
  model_.vertices.push_back(p);
}

void SoupBuilder::add_polygon(std::span<const double> corners, const SoupPlace& place) {
  const auto count = static_cast<double>(model_.vertices.size());
  for (const double index : corners)
    if (!(index >= 0 && index < count) || index != std::floor(index))
      throw error(place, "corner " + fmt::format("{}", index) + " is not the index of one of the " +
                             std::to_string(model_.vertices.size()) +
                             " vertices before it; check the export");
  if (corners.size() < 3) {
    drop("polygon of fewer than three corners", place);
    return;
  }
  for (const double index : corners) model_.ring_vertex.push_back(static_cast<uint32_t>(index));
  model_.ring_end.push_back(model_.ring_vertex.size());
  const bool has_line = std::string_view(place.unit) == "line";
  const auto line = std::min<uint64_t>(place.number, std::numeric_limits<uint32_t>::max());
  model_.polygons.push_back(
      {model_.ring_end.size(), has_line ? static_cast<uint32_t>(line) : 0, Material::unknown});
}

RawModel SoupBuilder::take() {
  RawObject object;
  object.name = file_.stem;
  object.kind = kind_of_name(file_.stem);
  object.place = file_.name;
  if (!model_.polygons.empty()) object.patches.push_back({"", file_.name, 0, model_.polygons.size()});
  model_.objects.push_back(std::move(object));
  return std::move(model_);
}

bool SoupText::next_line() {
  while (!rest_.empty()) {
    const size_t end = rest_.find('\n');
    words_ = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    line_ = next_line_++;
    if (comments_) words_ = words_.substr(0, words_.find('#'));
    if (words_.find_first_not_of(blanks) != std::string_view::npos) return true;
  }
  words_ = {};
  return false;
}

std::string_view SoupText::word() {
  words_.remove_prefix(std::min(words_.find_first_not_of(blanks), words_.size()));
  const std::string_view found = words_.substr(0, words_.find_first_of(blanks));
  words_.remove_prefix(found.size());
  return found;
}

std::string_view SoupText::word_anywhere() {
  std::string_view found = word();
  while (found.empty() && next_line()) found = word();
  return found;
}

double SoupText::number(std::string_view word) const {
  if (const std::optional<double> found = parse_number(word)) return *found;
  throw builder_.error(place(), word.empty() ? std::string("a number is missing (truncated?)")
                                             : "'" + printable(word, 40) + "' is not a number; repair it");
}

uint64_t SoupText::count(std::string_view word) const {
  uint64_t found = 0;
  const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), found);
  if (!word.empty() && status == std::errc() && end == word.data() + word.size()) return found;
  throw builder_.error(place(), "'" + printable(word, 40) + "' is not a count; check the export");
}

}  // namespace veduta
