// Which of the files of a folder are models. Names settle most of it, so that 50,000 files need not be opened
// twice; what a glTF or a tileset refers to is looked up.
#include <algorithm>
#include <array>
#include <filesystem>
#include <set>

#include "scene/model_format.h"
#include "scene/model_references.h"
#include "scene/raw_model.h"

namespace veduta {
namespace {

namespace fs = std::filesystem;

// Beside models: materials, pictures, indices and tables of plans, texts.
constexpr auto companions = std::to_array<std::string_view>(
    {".mtl",  ".png", ".jpg", ".jpeg", ".tga", ".bmp",  ".tif",  ".tiff", ".webp",
     ".ktx2", ".dds", ".bin", ".dbf",  ".shx", ".prj",  ".cpg",  ".qix",  ".sbn",
     ".sbx",  ".qpj", ".txt", ".md",   ".pdf", ".html", ".yaml", ".yml",  ".toml"});
constexpr auto plain_texts = std::to_array<std::string_view>({"README", "LICENSE", "LICENCE", "COPYING"});
constexpr auto tile_contents =
    std::to_array<std::string_view>({".b3dm", ".i3dm", ".cmpt", ".pnts", ".gltf", ".glb"});

template <typename List>
bool among(const List& list, std::string_view text) {
  return std::find(list.begin(), list.end(), text) != list.end();
}

bool is_companion(const fs::path& name) {
  return among(companions, extension_of(name)) || among(plain_texts, name.filename().string());
}

class Chooser {
 public:
  Chooser(const ModelFiles& files, ImportReport& report) : files_(files), report_(report) {}

  std::vector<std::string> choose() {
    for (const std::string& name : files_.names()) {
      if (fs::path(name).filename() == "tileset.json") tileset_folders_.insert(folder_of(name));
      if (fs::path(name).filename() == "tileset.json" || extension_of(name) == ".gltf") follow(name);
    }
    std::vector<std::string> chosen;
    for (const std::string& name : files_.names())
      if (is_model(name)) chosen.push_back(name);
    for (const std::string& name : files_.not_files())
      count_dropped(report_, "link, pipe or device, not read", files_.shown(name));
    return chosen;
  }

 private:
  static std::string folder_of(const std::string& name) {
    return fs::path(name).parent_path().generic_string();
  }

  // What `first` refers to, and what that refers to: tilesets of tilesets. A loop ends, as each is read once;
  // a chain may be as long as there are files.
  void follow(const std::string& first) {
    std::vector<std::string> waiting{first};
    while (!waiting.empty()) {
      const std::string from = std::move(waiting.back());
      waiting.pop_back();
      if (!followed_.insert(from).second) continue;
      for (const std::string& reference : references_of(from)) {
        const auto name = ModelFiles::resolve(from, reference);
        if (!name || *name == from) continue;
        referred_.insert(*name);
        const std::string extension = extension_of(*name);
        if (std::binary_search(files_.names().begin(), files_.names().end(), *name) &&
            (extension == ".json" || extension == ".gltf"))
          waiting.push_back(*name);
      }
    }
  }

  std::vector<std::string> references_of(const std::string& from) const {
    try {
      return references_of_json(files_.read(from).content());
    } catch (const Error&) {
      return {};  // its reader will say so
    }
  }

  bool is_model(const std::string& name) {
    if (referred_.count(name) > 0) return false;
    const std::string extension = extension_of(name);
    if (among(tile_contents, extension) && beneath_a_tileset(name)) {
      count_dropped(report_, "tile that no tileset refers to", files_.shown(name));
      return false;
    }
    if (is_model_extension(extension) && extension != ".json") return true;
    if (is_companion(name)) return false;
    if (extension == ".json" || looks_like_a_model(name, extension)) return true;
    count_dropped(report_, "file that is no model", files_.shown(name));
    return false;
  }

  bool beneath_a_tileset(const std::string& name) const {
    for (fs::path folder = folder_of(name);; folder = folder.parent_path()) {
      if (tileset_folders_.count(folder.generic_string()) > 0) return true;
      if (folder.empty()) return false;
    }
  }

  // By its first bytes alone, as it may be large. XML is a model only where it says so: records of metadata
  // lie beside many models.
  bool looks_like_a_model(const std::string& name, const std::string& extension) const {
    const std::string head = files_.head(name, 4096);
    const ModelFormat format = format_of(head, extension);
    if (format == ModelFormat::citygml) return head.find("CityModel") != std::string::npos;
    if (format == ModelFormat::obj) return head.find("\nv ") != std::string::npos;
    return format != ModelFormat::unknown;
  }

  const ModelFiles& files_;
  ImportReport& report_;
  std::set<std::string> tileset_folders_, referred_, followed_;
};

}  // namespace

std::vector<std::string> choose_models(const ModelFiles& files, ImportReport& report) {
  if (files.form() == ModelFiles::Form::file) return files.names();
  return Chooser(files, report).choose();
}

}  // namespace veduta
