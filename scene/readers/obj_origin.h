// OBJ files of one building each, local to a place on earth: the exports of polygon-city (Linz).
//
// Their first line is "# {json}" with "id", "origin" [longitude, latitude] and "elevation"; where it is
// missing, an index.geojson in a folder above may have it in the feature whose "models" name the file. y is
// up and z points south, from the origin, in metres.
//
// South of what: of the national grid that the city was surveyed in, which the files do not name. Linz:
// 14,627 of 35,000 vertices of three tiles have a vertex of another building within 1 mm when the origins are
// projected to MGI / Austria GK Central (EPSG:31255) and the offsets added; with UTM 33 it is 30, and 840
// when the offsets are also turned by the convergence between the two (0.71 + 0.53 degrees; the scale
// differs). So offsets are those of the Austrian grid in Austria. Elsewhere the UTM zone is taken.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/model_files.h"
#include "scene/raw_model.h"

namespace veduta {

struct ObjOrigin {
  std::string id;
  double longitude_deg = 0, latitude_deg = 0;
  double elevation_m = 0;
};

/// What the first line of the file says. \throw Error(bad_input) for an origin that is no place on earth.
std::optional<ObjOrigin> origin_in_comment(const InputFile& file);

/// What an index.geojson in the folder of `name` or above says of it. \throw Error(bad_input) likewise.
std::optional<ObjOrigin> origin_in_index(const ModelFiles& files, const std::string& name);

/// Makes one object of the model, named after the id, or after the file; its groups become parts.
void name_after(const ObjOrigin& origin, const std::string& stem, RawModel& model);

/// Whether an OBJ file that nothing places is local all the same: all within 10 km of (0, 0, 0), where no
/// grid has a city. Of Linz 41 files are, 5 of them in its core: index.geojson knows none of these.
bool is_local(const RawModel& model);

/// The grid in which offsets from the origin are ("EPSG:31255").
std::string grid_of(const ObjOrigin& origin);

/// Brings models from their origins into `grid`, z up, and says so in them.
/// \param models, origins of the same length
/// \param up of the files; from_file: y
/// \throw Error(bad_input) when an origin has no place in the grid
void move_to_grid(const std::vector<RawModel*>& models, const std::vector<ObjOrigin>& origins,
                  const std::string& grid, UpAxis up);

}  // namespace veduta
