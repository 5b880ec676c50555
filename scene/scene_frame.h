// One frame for the models of a scene: metres, z up, one CRS.
#pragma once

#include <vector>

#include "scene/import.h"
#include "scene/raw_model.h"

namespace veduta {

/// Turns, scales and projects each model as the options and the model say (import.h). Instances stay
/// instances: their placements are turned and scaled. Where a model has to be projected, each becomes an
/// object with polygons of its own, as a projection bends a mesh.
/// \throw Error(bad_input) for a CRS that is not known, and for a point that has no place in the scene's
void bring_to_frame(std::vector<RawModel>& models, const ImportOptions& options);

/// Refuses a scene that can only be in another unit than metres, with a line that names scene.unit and
/// scene.crs: one larger than 1,000 km, or higher than 20 km (a town in millimetres); and one of several
/// objects that is less than 1 m wide (kilometres; with something higher than that: degrees). One object
/// alone may be as small as it likes. Not called where the user states the unit.
/// \throw Error(bad_input)
void require_size_of_city(const std::vector<RawModel>& models);

}  // namespace veduta
