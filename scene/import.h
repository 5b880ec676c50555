// Reading city models from disk into a Scene, and saying what was found and what was dropped.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace veduta {

struct ImportOptions {
  /// Edge of the square tiles that terrain is cut into, in m: each becomes an object of its own, so that a
  /// row can leave out the terrain that a cell cannot see. Triangles go whole to the tile of their centroid.
  /// 0: do not cut.
  double terrain_tile_m = 64.0;
};

/// What an import found and dropped. Nothing is dropped silently.
struct ImportReport {
  std::string format;  ///< "CityJSON 1.1", "CityJSONSeq 2.0", "OBJ"
  uint64_t bytes_read = 0;
  std::map<std::string, uint64_t> objects_by_kind;
  uint64_t parts = 0;
  uint64_t polygons = 0, polygons_with_holes = 0;
  uint64_t skirt_triangles = 0;  ///< added: walls below the open edges of terrain (terrain_skirt.h)
  /// Reason ("degenerate polygon", "duplicate triangle", "polygon that cannot be triangulated", "LoD 1 beside
  /// LoD 2", "unsupported geometry MultiPoint", ...) and how many, with the place of the first one of each
  /// reason.
  struct Dropped {
    uint64_t count = 0;
    std::string first_place;  ///< e.g. "denhaag.city.json: CityObjects/GUID_1/geometry/0"
  };
  std::map<std::string, Dropped> dropped;
};

struct ImportResult {
  Scene scene;
  ImportReport report;
};

/// Reads one or more model files into one scene. The reader is chosen by content, then by extension:
/// CityJSON 1.0, 1.1, 2.0 (.json), CityJSONSeq (.jsonl), Wavefront OBJ (.obj). The scene origin is the centre
/// of the models' horizontal extent and their lowest z, rounded to whole metres. Deterministic: the same
/// files give the same bytes. \throw Error(bad_input) for a file that cannot be used (missing, truncated, a
/// NaN or infinite coordinate, an index out
///   of range, no triangle at all): "FILE: PLACE: what; what to do".
ImportResult import_scene(const std::vector<std::filesystem::path>& files, const ImportOptions& options = {});

/// The report as people read it (`veduta import MODEL --info`): several lines, numbers with units.
std::string describe(const ImportResult& result);

}  // namespace veduta
