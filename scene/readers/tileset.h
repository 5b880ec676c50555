// tileset.json of 3D Tiles 1.0 and 1.1: the tree of tiles, without their content.
#pragma once

#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/text.h"

namespace veduta {

struct Tile {
  glm::dmat4 parent_from_tile{1};
  bool adds = false;  ///< refine ADD: shown together with its children; else (REPLACE) they replace it
  std::vector<std::string> contents;  ///< URIs, as the file states them
  std::vector<Tile> children;
};

struct Tileset {
  std::string version;           ///< "1.0", "1.1"
  glm::dmat4 z_up_from_gltf{1};  ///< asset.gltfUpAxis of old tilesets, else y
  Tile root;
  bool on_globe = false;  ///< its bounding volume is a region, or lies on the ellipsoid: see earth_centred()
};

/// \throw Error(bad_input), "tileset.json: root/children/3/transform: ..."; also for implicit tiling, which
/// is not read
Tileset read_tileset(const InputFile& file);

}  // namespace veduta
