#include "scene/readers/gltf_document.h"

#include <simdjson.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>

namespace veduta {
namespace {

using std::string_view;

// A chunk of JSON in a GLB: 12 bytes of header, then its length and type.
constexpr size_t glb_json_at = 20;

// Extensions whose data we read, or that change only how surfaces look.
constexpr auto known_extensions = std::to_array<string_view>(
    {"KHR_mesh_quantization", "EXT_mesh_gpu_instancing", "EXT_mesh_features", "EXT_structural_metadata",
     "EXT_instance_features", "EXT_feature_metadata", "CESIUM_RTC", "CESIUM_primitive_outline",
     "KHR_lights_punctual", "KHR_techniques_webgl", "KHR_xmp", "KHR_xmp_json_ld", "KHR_animation_pointer"});
constexpr auto known_prefixes =
    std::to_array<string_view>({"KHR_materials_", "KHR_texture_", "EXT_texture_", "MSFT_texture_"});

bool known(string_view extension) {
  return std::find(known_extensions.begin(), known_extensions.end(), extension) != known_extensions.end() ||
         std::any_of(known_prefixes.begin(), known_prefixes.end(),
                     [&](string_view prefix) { return extension.starts_with(prefix); });
}

string_view text_of(const simdjson::dom::element& element) {
  string_view text;
  return element.get(text) == simdjson::SUCCESS ? text : string_view();
}

class Loader {
 public:
  Loader(string_view content, const std::string& name, const FindFile& find, ImportReport& report)
      : content_(content), name_(name), find_(find), report_(report) {}

  std::shared_ptr<const tinygltf::Model> load() {
    binary_ = content_.starts_with("glTF");
    check(json());
    auto model = std::make_shared<tinygltf::Model>();
    tinygltf::TinyGLTF parser;
    parser.SetImageLoader(
        [](tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*, int, void*) {
          return true;  // not decoded
        },
        nullptr);
    parser.SetFsCallbacks({&Loader::file_exists, [](const std::string& path, void*) { return path; },
                           &Loader::read_file, nullptr, this});
    std::string error, warning;
    bool done = false;
    const auto size = static_cast<unsigned>(content_.size());
    try {
      done = binary_
                 ? parser.LoadBinaryFromMemory(model.get(), &error, &warning,
                                               reinterpret_cast<const unsigned char*>(content_.data()), size)
                 : parser.LoadASCIIFromString(model.get(), &error, &warning, content_.data(), size, "");
    } catch (const Error&) {
      throw;  // of the files it refers to
    } catch (const std::exception& exception) {
      error = exception.what();
    }
    while (error.ends_with('\n')) error.pop_back();
    if (!done) throw bad_input(name_, "glTF", printable(error, 200) + "; export the model again");
    return model;
  }

 private:
  string_view json() const {
    constexpr size_t largest = 0xFFFFFFFF;  // tinygltf counts in 32 bits
    if (content_.size() > largest)
      throw bad_input(name_, "file", "is larger than 4 GiB; cut the model into tiles");
    if (!binary_) return content_;
    uint32_t header[5] = {};
    if (content_.size() < sizeof header)
      throw bad_input(name_, "GLB header",
                      "ends after " + std::to_string(content_.size()) + " bytes; export the model again");
    std::memcpy(header, content_.data(), sizeof header);
    if (header[1] != 2)
      throw bad_input(name_, "GLB header",
                      "version " + std::to_string(header[1]) + " is not read; convert it to glTF 2.0");
    if (header[2] > content_.size() || header[3] > content_.size() - glb_json_at)
      throw bad_input(name_, "GLB header", "states more bytes than the file has; export the model again");
    return content_.substr(glb_json_at, header[3]);
  }

  // simdjson refuses deep nesting, which tinygltf would follow until the stack ends.
  void check(string_view json) {
    simdjson::dom::parser parser;
    simdjson::dom::element document;
    if (const auto error = parser.parse(json.data(), json.size(), false).get(document))
      throw bad_input(name_, "JSON",
                      std::string(simdjson::error_message(error)) + "; export the model again");
    simdjson::dom::element item;
    if (document.at_pointer("/asset/version").get(item) != simdjson::SUCCESS)
      throw bad_input(name_, "asset/version", "is missing; is this a glTF file?");
    if (!text_of(item).starts_with("2."))
      throw bad_input(name_, "asset/version",
                      "glTF " + printable(text_of(item), 20) + " is not read; convert it to glTF 2.0");
    check_extensions(document);
    simdjson::dom::array buffers;
    if (document["buffers"].get(buffers) != simdjson::SUCCESS) return;
    for (const simdjson::dom::element buffer : buffers) {
      uint64_t size = 0;
      simdjson::dom::element uri;
      if (buffer["uri"].get(uri) == simdjson::SUCCESS && !text_of(uri).starts_with("data:") &&
          buffer["byteLength"].get(size) == simdjson::SUCCESS)
        external_.try_emplace(as_tinygltf_asks(text_of(uri)), External{decode_uri(text_of(uri)), size});
    }
  }

  void check_extensions(const simdjson::dom::element& document) {
    std::vector<string_view> required;
    simdjson::dom::array names;
    if (document["extensionsRequired"].get(names) == simdjson::SUCCESS)
      for (const simdjson::dom::element name : names) required.push_back(text_of(name));
    for (const string_view extension : required)
      if (!known(extension))
        throw bad_input(name_, "extensionsRequired",
                        printable(extension, 60) + " is not read; export the model without it");
    if (document["extensionsUsed"].get(names) != simdjson::SUCCESS) return;
    for (const simdjson::dom::element name : names)
      if (!known(text_of(name)))
        count_dropped(report_, "glTF extension that is not read",
                      name_ + ": " + printable(text_of(name), 60));
  }

  struct External {
    std::string path;
    uint64_t size = 0;  // that is used of it
  };

  // It takes a '+' for a space.
  static std::string as_tinygltf_asks(string_view uri) {
    std::string path(uri);
    std::replace(path.begin(), path.end(), '+', ' ');
    return decode_uri(path);
  }

  // tinygltf asks for images as well: only buffers are there.
  static bool file_exists(const std::string& path, void* self) {
    return static_cast<Loader*>(self)->external_.contains(path);
  }

  static bool read_file(std::vector<unsigned char>* out, std::string*, const std::string& path, void* self) {
    const Loader& loader = *static_cast<Loader*>(self);
    const auto& [uri, size] = loader.external_.at(path);
    const std::optional<InputFile> file = loader.find_(uri);
    if (!file)
      throw bad_input(loader.name_, "buffers", printable(uri) + " is missing; put it beside the model");
    if (file->content().size() < size)
      throw bad_input(file->name, "file",
                      "has " + std::to_string(file->content().size()) + " bytes, and " + loader.name_ +
                          " needs " + std::to_string(size) + "; export the model again");
    // Longer files are allowed; tinygltf would refuse them.
    out->assign(file->content().begin(), file->content().begin() + static_cast<ptrdiff_t>(size));
    return true;
  }

  const string_view content_;
  const std::string& name_;
  const FindFile& find_;
  ImportReport& report_;
  bool binary_ = false;
  std::map<std::string, External> external_;  // files of buffers
};

}  // namespace

std::shared_ptr<const tinygltf::Model> parse_gltf(std::string_view content, const std::string& name,
                                                  const FindFile& find, ImportReport& report) {
  return Loader(content, name, find, report).load();
}

glm::dvec3 rtc_center(const tinygltf::Model& gltf, const std::string& name) {
  const auto found = gltf.extensions.find("CESIUM_RTC");
  if (found == gltf.extensions.end()) return glm::dvec3(0);
  const tinygltf::Value& value = found->second;
  const tinygltf::Value center =
      value.IsObject() && value.Has("center") ? value.Get("center") : tinygltf::Value();
  glm::dvec3 point(0);
  bool good = center.IsArray() && center.ArrayLen() == 3;
  for (int axis = 0; good && axis < 3; ++axis) {
    const tinygltf::Value& number = center.Get(axis);
    good = number.IsNumber();
    if (good) point[axis] = number.GetNumberAsDouble();
    good = good && std::isfinite(point[axis]);
  }
  if (!good)
    throw bad_input(name, "extensions/CESIUM_RTC", "center is not 3 finite numbers; export it again");
  return point;
}

std::string decode_uri(std::string_view uri) {
  std::string path;
  for (size_t i = 0; i < uri.size(); ++i) {
    unsigned char byte = 0;
    const bool escaped = uri[i] == '%' && i + 2 < uri.size() &&
                         std::from_chars(&uri[i + 1], &uri[i + 1] + 2, byte, 16).ptr == &uri[i + 1] + 2;
    path.push_back(escaped ? static_cast<char>(byte) : uri[i]);
    if (escaped) i += 2;
  }
  return path;
}

}  // namespace veduta
