#include "scene/model_format.h"

#include <algorithm>
#include <array>

namespace veduta {
namespace {

using std::string_view;

// What a text starts with, when blanks and a byte order mark are passed over.
string_view after_blanks(string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const size_t begin = text.find_first_not_of(" \t\r\n");
  return begin == string_view::npos ? string_view() : text.substr(begin);
}

string_view first_word(string_view text) {
  return text.substr(0, text.find_first_of(" \t\r\n"));
}

bool holds(string_view text, string_view what) {
  return text.find(what) != string_view::npos;
}

ModelFormat format_of_signature(string_view content) {
  using std::string_view_literals::operator""sv;
  if (content.starts_with("glTF")) return ModelFormat::gltf;
  for (const char* tile : {"b3dm", "i3dm", "cmpt", "pnts"})
    if (content.starts_with(tile)) return ModelFormat::tiles_3d;
  if (content.starts_with("\0\0\x27\x0a"sv)) return ModelFormat::shapefile;
  if (content.starts_with("AutoCAD Binary DXF")) return ModelFormat::dxf;
  if (content.starts_with("ply\n") || content.starts_with("ply\r")) return ModelFormat::polygon_soup;
  return ModelFormat::unknown;
}

ModelFormat format_of_json(string_view content, const std::string& extension) {
  if (extension == ".gltf") return ModelFormat::gltf;
  if (holds(content, "\"CityJSON")) return ModelFormat::cityjson;
  if (holds(content, "\"asset\""))
    return holds(content, "\"geometricError\"") ? ModelFormat::tiles_3d : ModelFormat::gltf;
  if (holds(content, "\"FeatureCollection\"") || holds(content, "\"Feature\"") || extension == ".geojson")
    return holds(content, "\"models\"") ? ModelFormat::model_index : ModelFormat::geojson;
  return ModelFormat::unknown;
}

ModelFormat format_of_extension(const std::string& extension) {
  constexpr std::pair<string_view, ModelFormat> table[] = {
      {".json", ModelFormat::cityjson},    {".jsonl", ModelFormat::cityjson},
      {".obj", ModelFormat::obj},          {".dxf", ModelFormat::dxf},
      {".geojson", ModelFormat::geojson},  {".shp", ModelFormat::shapefile},
      {".gml", ModelFormat::citygml},      {".citygml", ModelFormat::citygml},
      {".ply", ModelFormat::polygon_soup}, {".off", ModelFormat::polygon_soup},
      {".stl", ModelFormat::polygon_soup}, {".gltf", ModelFormat::gltf},
      {".glb", ModelFormat::gltf},         {".b3dm", ModelFormat::tiles_3d}};
  for (const auto& [known, format] : table)
    if (extension == known) return format;
  return ModelFormat::unknown;
}

}  // namespace

ModelFormat format_of(string_view content, const std::string& extension) {
  if (const ModelFormat found = format_of_signature(content); found != ModelFormat::unknown) return found;
  const string_view text = after_blanks(content);
  if (text.starts_with('{'))
    if (const ModelFormat found = format_of_json(text, extension); found != ModelFormat::unknown)
      return found;
  if (text.starts_with('<')) return ModelFormat::citygml;
  if (const ModelFormat found = format_of_extension(extension); found != ModelFormat::unknown) return found;
  if (text.starts_with('{')) return ModelFormat::cityjson;  // which says what is missing
  const string_view word = first_word(text);
  if (word == "0" && first_word(after_blanks(text.substr(1))) == "SECTION") return ModelFormat::dxf;
  if (word == "OFF" || word == "COFF" || word == "NOFF") return ModelFormat::polygon_soup;
  if (word == "solid" && holds(text.substr(0, 1000), "facet")) return ModelFormat::polygon_soup;
  const bool looks_like_obj =
      word.starts_with('#') || word == "v" || word == "o" || word == "g" || word == "mtllib";
  return looks_like_obj ? ModelFormat::obj : ModelFormat::unknown;
}

bool is_model_extension(const std::string& extension) {
  return format_of_extension(extension) != ModelFormat::unknown;
}

}  // namespace veduta
