// Objects for files that name none.
#pragma once

#include "scene/raw_model.h"

namespace veduta {

/// Takes the one object of a model apart into its connected components: polygons are connected when they have
/// a corner at the same place. Objects are named "NAME/1", "NAME/2" ... in the order of their first polygons;
/// a model that is all connected keeps its object, and so does terrain, road, water and vegetation. So does a
/// soup, whose polygons mostly touch nothing: more than 1,000 components of fewer than two polygons on
/// average are no buildings. A component that faces up everywhere, less steep than 60 degrees, more than half
/// as wide and as deep as the model, with nothing more than 0.5 m below it, is terrain.
/// \param model in m, z up
void take_apart(RawModel& model);

}  // namespace veduta
