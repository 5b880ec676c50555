#include "scene/model_references.h"

#include <simdjson.h>

#include <algorithm>

#include "scene/model_files.h"
#include "scene/text.h"

namespace veduta {
namespace {

namespace fs = std::filesystem;
namespace dom = simdjson::dom;

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  const char lower = static_cast<char>(c | 0x20);
  return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

std::string percent_decoded(std::string_view text) {
  std::string out;
  for (size_t i = 0; i < text.size(); ++i) {
    const bool code =
        text[i] == '%' && i + 2 < text.size() && hex_digit(text[i + 1]) >= 0 && hex_digit(text[i + 2]) >= 0;
    out += code ? static_cast<char>(16 * hex_digit(text[i + 1]) + hex_digit(text[i + 2])) : text[i];
    if (code) i += 2;
  }
  return out;
}

// The parser bounds the depth (1,024).
void collect(const dom::element& element, std::vector<std::string>& found) {
  dom::object object;
  dom::array array;
  if (element.get(object) == simdjson::SUCCESS) {
    for (const auto [key, value] : object) {
      std::string_view text;
      if ((key == "uri" || key == "url") && value.get(text) == simdjson::SUCCESS) {
        if (!text.starts_with("data:")) found.push_back(percent_decoded(text));
      } else {
        collect(value, found);
      }
    }
  } else if (element.get(array) == simdjson::SUCCESS) {
    for (const dom::element child : array) collect(child, found);
  }
}

}  // namespace

std::vector<std::string> references_of_json(std::string_view json) {
  std::vector<std::string> found;
  dom::parser parser;
  dom::element document;
  if (parser.parse(json.data(), json.size()).get(document) == simdjson::SUCCESS) collect(document, found);
  return found;
}

std::vector<std::string> siblings_of(const fs::path& model) {
  std::vector<std::string> siblings;
  const fs::path folder = fs::absolute(model).parent_path();
  const std::string extension = extension_of(model);
  std::error_code error;
  if (extension == ".gltf") {
    for (const std::string& reference : references_of_json(read_input(model).content()))
      if (const auto name = ModelFiles::resolve("", reference);
          name && fs::is_regular_file(folder / *name, error))
        siblings.push_back(*name);
  } else if (extension == ".shp") {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
      if (entry.path().stem() == model.stem() && entry.path().filename() != model.filename() &&
          entry.is_regular_file(error))
        siblings.push_back(entry.path().filename().string());
  }
  std::sort(siblings.begin(), siblings.end());
  siblings.erase(std::unique(siblings.begin(), siblings.end()), siblings.end());
  return siblings;
}

}  // namespace veduta
