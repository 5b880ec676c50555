#include "scene/import.h"

#include <cmath>
#include <string_view>

#include "scene/assemble.h"
#include "scene/readers/cityjson.h"
#include "scene/readers/obj.h"
#include "scene/text.h"

namespace veduta {
namespace {

// The first word of the first line that says something; empty for what is not text.
std::string_view first_word(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos) return {};
  text.remove_prefix(begin);
  return text.substr(0, text.find_first_of(" \t\r\n"));
}

RawModel read(const std::filesystem::path& path, ImportReport& report) {
  const InputFile file = read_input(path);
  report.bytes_read += file.content().size();
  const std::string_view word = first_word(file.content());
  if (word.starts_with('{') || file.extension == ".json" || file.extension == ".jsonl")
    return read_cityjson(file, report);
  if (word.starts_with('<'))
    throw bad_input(file.name, "line 1",
                    "this is XML; convert CityGML to CityJSON (citygml-tools to-cityjson)");
  const bool looks_like_obj =
      word.starts_with('#') || word == "v" || word == "o" || word == "g" || word == "mtllib";
  if (file.extension == ".obj" || looks_like_obj) return read_obj(file, report);
  throw bad_input(file.name, "line 1",
                  "neither CityJSON (.json, .jsonl) nor Wavefront OBJ (.obj); convert it");
}

}  // namespace

ImportResult import_scene(const std::vector<std::filesystem::path>& files, const ImportOptions& options) {
  if (files.empty()) throw Error(ExitStatus::usage, "import: no model file is given; name one or more");
  if (!(options.terrain_tile_m == 0 ||
        (options.terrain_tile_m >= 1 && std::isfinite(options.terrain_tile_m))))
    throw Error(ExitStatus::usage, "import: terrain_tile_m is neither 0 nor at least 1 m");
  ImportReport report;
  std::vector<RawModel> models;
  for (const std::filesystem::path& path : files) {
    models.push_back(read(path, report));
    if (report.format.find(models.back().format) == std::string::npos)
      report.format += (report.format.empty() ? "" : ", ") + models.back().format;
  }
  return assemble(models, options, std::move(report));
}

}  // namespace veduta
