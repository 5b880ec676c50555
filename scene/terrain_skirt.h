// Closing the earth: walls from the open edges of a terrain down to the bottom of the scene.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "scene/draft.h"
#include "scene/vertex_pool.h"

namespace veduta {

/// A terrain model is a sheet: it ends at the rim, at water bodies that were cut out, and at steps between
/// its pieces. There one could look underneath it, and nobody can in a real city. Each edge that only one
/// triangle uses gets a wall, facing away from the sheet, down to `bottom` (m). The walls are part of the
/// model from then on: drawn, baked and verified like the rest. \param vertices of the scene; grows. \return
/// the walls' triangles; each has the patch and polygon of the triangle above it.
std::vector<Draft> terrain_skirt(const std::vector<Draft>& terrain, const std::vector<glm::vec3>& vertices,
                                 VertexPool& pool, float bottom);

}  // namespace veduta
