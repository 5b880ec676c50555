// From what the readers found to the Scene.
#pragma once

#include <vector>

#include "scene/import.h"
#include "scene/raw_model.h"

namespace veduta {

/// Chooses the origin, triangulates, rounds to float32, drops what is degenerate or there twice, cuts the
/// terrain. `report` is what the readers have counted so far. \throw Error(bad_input) for a model without a
/// triangle, or one larger than 10,000 km.
ImportResult assemble(const std::vector<RawModel>& models, const ImportOptions& options, ImportReport report);

}  // namespace veduta
