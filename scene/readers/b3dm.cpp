#include "scene/readers/b3dm.h"

#include <simdjson.h>

#include <array>
#include <cmath>
#include <cstring>

#include "scene/text.h"

namespace veduta {
namespace {

using simdjson::dom::element;
using std::string_view;

constexpr auto name_fields = std::to_array<const char*>(
    {"id", "gml_id", "gml:id", "gmlid", "gmlId", "ID", "Id", "name", "Name", "NAME"});

uint32_t word(string_view bytes, size_t at) {
  uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

// An empty table is an empty object: some tilers write nothing at all.
element parse(simdjson::dom::parser& parser, string_view json, const std::string& file, const char* place) {
  static constexpr char empty[64] = "{}";
  element table;
  const bool nothing = json.find_first_not_of(" \0") == string_view::npos;
  const auto error =
      (nothing ? parser.parse(empty, 2, false) : parser.parse(json.data(), json.size(), false)).get(table);
  if (error)
    throw bad_input(file, place, std::string(simdjson::error_message(error)) + "; make the tile again");
  return table;
}

glm::dvec3 read_rtc_center(const element& table, string_view binary, const std::string& file) {
  glm::dvec3 center(0);
  element value;
  if (table["RTC_CENTER"].get(value) != simdjson::SUCCESS) return center;
  simdjson::dom::array numbers;
  uint64_t offset = 0;
  bool good = false;
  if (value.get(numbers) == simdjson::SUCCESS && numbers.size() == 3) {
    good = true;
    for (int axis = 0; axis < 3; ++axis)
      good = good && numbers.at(static_cast<size_t>(axis)).get(center[axis]) == simdjson::SUCCESS;
  } else if (value["byteOffset"].get(offset) == simdjson::SUCCESS && offset <= binary.size() &&
             binary.size() - offset >= 3 * sizeof(float)) {
    float stored[3];
    std::memcpy(stored, binary.data() + offset, sizeof stored);
    center = {stored[0], stored[1], stored[2]};
    good = true;
  }
  if (!good || !std::isfinite(center.x + center.y + center.z))
    throw bad_input(file, "feature table/RTC_CENTER", "is not 3 finite numbers; make the tile again");
  return center;
}

std::vector<std::string> read_names(const element& table) {
  std::vector<std::string> names;
  for (const char* field : name_fields) {
    simdjson::dom::array values;
    if (table[field].get(values) != simdjson::SUCCESS) continue;  // missing, or in the binary part
    for (const element value : values) {
      string_view text;
      names.push_back(
          printable(value.get(text) == simdjson::SUCCESS ? text : simdjson::minify(value), 10000));
    }
    break;
  }
  return names;
}

}  // namespace

BatchedModel read_b3dm(string_view tile, const std::string& file) {
  constexpr uint64_t header = 28;
  if (tile.size() < header)
    throw bad_input(file, "b3dm header",
                    "ends after " + std::to_string(tile.size()) + " bytes; make the tile again");
  if (word(tile, 4) != 1)
    throw bad_input(file, "b3dm header", "version " + std::to_string(word(tile, 4)) + " is not read; use 1");
  const uint64_t size = word(tile, 8);
  uint64_t ends[4] = {};  // of the feature table and its binary part, of the batch table and its
  uint64_t end = header;
  for (size_t i = 0; i < 4; ++i) ends[i] = end += word(tile, 12 + 4 * i);
  if (size > tile.size() || end > size)
    throw bad_input(file, "b3dm header",
                    "states " + std::to_string(std::max(size, end)) + " bytes, and " +
                        std::to_string(tile.size()) + " are there; fetch or make the tile again");
  simdjson::dom::parser parser;
  BatchedModel model;
  model.gltf = tile.substr(end, size - end);
  model.rtc_center =
      read_rtc_center(parse(parser, tile.substr(header, ends[0] - header), file, "feature table"),
                      tile.substr(ends[0], ends[1] - ends[0]), file);
  model.names = read_names(parse(parser, tile.substr(ends[1], ends[2] - ends[1]), file, "batch table"));
  return model;
}

std::vector<string_view> read_cmpt(string_view tile, const std::string& file) {
  constexpr size_t header = 16, least = 12;  // of a tile inside: magic, version, length
  const auto error = [&] {
    return bad_input(file, "cmpt header", "its tiles do not fit into it; fetch or make the tile again");
  };
  if (tile.size() < header || word(tile, 8) > tile.size()) throw error();
  std::vector<string_view> tiles;
  size_t at = header;
  for (uint32_t count = word(tile, 12); count > 0; --count) {
    if (tile.size() - at < least) throw error();
    const uint32_t size = word(tile, at + 8);
    if (size < least || size > tile.size() - at) throw error();
    tiles.push_back(tile.substr(at, size));
    at += size;
  }
  return tiles;
}

}  // namespace veduta
