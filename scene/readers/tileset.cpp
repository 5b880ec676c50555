#include "scene/readers/tileset.h"

#include <simdjson.h>

#include <cmath>
#include <glm/gtc/type_ptr.hpp>

#include "scene/readers/earth_centred.h"
#include "scene/readers/gltf_objects.h"

namespace veduta {
namespace {

using simdjson::dom::element;
using std::string_view;

class TilesetReader {
 public:
  explicit TilesetReader(const InputFile& file) : file_(file.name) {
    if (const auto error = parser_.parse(file.bytes.data(), file.content().size(), false).get(document_))
      throw bad_input(file_, "JSON", std::string(simdjson::error_message(error)) + "; fetch it again");
  }

  Tileset read() {
    Tileset tileset;
    string_view text;
    if (document_.at_pointer("/asset/version").get(text) != simdjson::SUCCESS)
      throw bad_input(file_, "asset/version", "is missing; is this a tileset.json?");
    tileset.version = printable(text, 20);
    if (tileset.version != "1.0" && tileset.version != "1.1" && tileset.version != "0.0")
      throw bad_input(file_, "asset/version", "3D Tiles " + tileset.version + " is not read; use 1.0 or 1.1");
    tileset.z_up_from_gltf = up_axis();
    element root;
    if (document_["root"].get(root) != simdjson::SUCCESS || !root.is_object())
      throw bad_input(file_, "root", "is missing; is this a tileset.json?");
    tileset.root = tile(root, "root", false);
    tileset.on_globe = on_globe(root, tileset.root.parent_from_tile);
    return tileset;
  }

 private:
  glm::dmat4 up_axis() const {
    string_view axis;
    if (document_.at_pointer("/asset/gltfUpAxis").get(axis) != simdjson::SUCCESS || axis == "Y" ||
        axis == "y")
      return z_up_from_y_up();
    if (axis == "Z" || axis == "z") return glm::dmat4(1);
    throw bad_input(file_, "asset/gltfUpAxis",
                    "'" + printable(axis, 20) + "' is neither Y nor Z; correct it");
  }

  // Nested no deeper than simdjson reads.
  Tile tile(const element& json, const std::string& place, bool parent_adds) const {
    if (!json.is_object()) throw bad_input(file_, place, "is not an object; fetch it again");
    element found;
    if (json["implicitTiling"].get(found) == simdjson::SUCCESS ||
        json.at_pointer("/extensions/3DTILES_implicit_tiling").get(found) == simdjson::SUCCESS)
      throw bad_input(file_, place, "implicit tiling is not read; write the tiles out (3d-tiles-tools)");
    Tile tile;
    tile.adds = parent_adds;
    string_view refine;
    if (json["refine"].get(refine) == simdjson::SUCCESS) tile.adds = refine == "ADD" || refine == "add";
    if (json["transform"].get(found) == simdjson::SUCCESS) {
      read_numbers(found, 16, glm::value_ptr(tile.parent_from_tile), place + "/transform");
    }
    if (json["content"].get(found) == simdjson::SUCCESS)
      tile.contents.push_back(uri(found, place + "/content"));
    simdjson::dom::array items;
    if (json["contents"].get(items) == simdjson::SUCCESS)
      for (const element item : items) tile.contents.push_back(uri(item, place + "/contents"));
    if (json["children"].get(items) == simdjson::SUCCESS)
      for (const element child : items)
        tile.children.push_back(
            this->tile(child, place + "/children/" + std::to_string(tile.children.size()), tile.adds));
    return tile;
  }

  std::string uri(const element& content, const std::string& place) const {
    string_view text;
    if (content["uri"].get(text) != simdjson::SUCCESS && content["url"].get(text) != simdjson::SUCCESS)
      throw bad_input(file_, place, "has no uri; fetch it again");
    return std::string(text);
  }

  void read_numbers(const element& json, size_t count, double* numbers, const std::string& place) const {
    simdjson::dom::array array;
    bool good = json.get(array) == simdjson::SUCCESS && array.size() == count;
    size_t i = 0;
    if (good)
      for (const element item : array) {
        good = good && item.get(numbers[i]) == simdjson::SUCCESS && std::isfinite(numbers[i]);
        ++i;
      }
    if (!good)
      throw bad_input(file_, place, "is not an array of " + std::to_string(count) + " finite numbers");
  }

  bool on_globe(const element& root, const glm::dmat4& world_from_root) const {
    element volume;
    if (root.at_pointer("/boundingVolume/region").get(volume) == simdjson::SUCCESS) return true;
    double numbers[12] = {};
    if (root.at_pointer("/boundingVolume/box").get(volume) == simdjson::SUCCESS)
      read_numbers(volume, 12, numbers, "root/boundingVolume/box");
    else if (root.at_pointer("/boundingVolume/sphere").get(volume) == simdjson::SUCCESS)
      read_numbers(volume, 4, numbers, "root/boundingVolume/sphere");
    return earth_centred(glm::dvec3(world_from_root * glm::dvec4(numbers[0], numbers[1], numbers[2], 1)));
  }

  const std::string& file_;
  simdjson::dom::parser parser_;
  element document_;
};

}  // namespace

Tileset read_tileset(const InputFile& file) {
  return TilesetReader(file).read();
}

}  // namespace veduta
