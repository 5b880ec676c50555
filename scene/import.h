// Reading city models from disk into a Scene, and saying what was found and what was dropped.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace veduta {

/// Which axis of a file points up.
enum class UpAxis { from_file, y, z };

struct ImportOptions {
  /// Edge of the square tiles that terrain is cut into, in m: each becomes an object of its own, so that a
  /// row can leave out the terrain that a cell cannot see. Triangles go whole to the tile of their centroid.
  /// 0: do not cut.
  double terrain_tile_m = 64.0;
  /// from_file: what the file or its format says (glTF: y), else z. y: x stays, z becomes -y (right-handed).
  UpAxis up = UpAxis::from_file;
  /// Metres in a unit of the file; 0: what the file or its format says, else 1.
  double unit_m = 0;
  /// The scene's CRS ("EPSG:3946"). Files that state another are transformed to it; files that state none are
  /// taken to be in it. Empty: the CRS of the first file that states one; when that is in degrees or
  /// feet, the UTM zone of its middle.
  std::string crs = {};
  /// Names of the attributes of footprints that hold the height in m and the number of floors; empty: the
  /// usual names are tried (scene/footprints.h).
  std::string height_field = {}, floors_field = {};
  /// Height of a floor in m, where a footprint states floors and no height.
  double floor_height_m = 3.0;
};

/// What an import found and dropped. Nothing is dropped silently.
struct ImportReport {
  std::string format;  ///< "CityJSON 1.1", "CityJSONSeq 2.0", "OBJ"
  uint64_t files = 0;  ///< models; what these refer to is counted in bytes_read alone
  uint64_t bytes_read = 0;
  std::map<std::string, uint64_t> objects_by_kind;
  uint64_t parts = 0;
  uint64_t instances = 0;  ///< objects that share a mesh with others
  uint64_t polygons = 0, polygons_with_holes = 0;
  uint64_t skirt_triangles = 0;    ///< added: walls below the open edges of terrain (terrain_skirt.h)
  std::vector<std::string> added;  ///< what else the files do not hold ("ground of 12 triangles ...")
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

/// Reads one or more models into one scene. A model is a file, a folder or an archive (scene/model_files.h);
/// the files of the last two are read in the order of their names. The reader of a file is chosen by content,
/// then by extension: CityJSON 1.0, 1.1, 2.0 (.json), CityJSONSeq (.jsonl), Wavefront OBJ (.obj). The scene
/// origin is the centre of the models' horizontal extent and their lowest z, rounded to whole metres.
/// Deterministic: the same files give the same bytes, with any number of threads. \throw Error(bad_input) for
/// a file that cannot be used (missing, truncated, a NaN or infinite coordinate, an index out
///   of range, no triangle at all): "FILE: PLACE: what; what to do".
ImportResult import_scene(const std::vector<std::filesystem::path>& files, const ImportOptions& options = {});

/// The report as people read it (`veduta import MODEL --info`): several lines, numbers with units.
std::string describe(const ImportResult& result);

/// The same as a JSON object: "format", "files", "bytes", "crs", "objects" (by kind), "instances", "parts",
/// "polygons", "triangles", "vertices", "lower" and "upper" (m, in the CRS), "origin", "added",
/// "dropped" (an array of "reason", "count", "first_place").
std::string describe_json(const ImportResult& result);

}  // namespace veduta
