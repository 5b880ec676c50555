// AutoCAD DXF (release 12, ASCII, metres), as AutoCAD and GDAL read it.
#pragma once

#include <glm/mat4x3.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "scene/writers/ordered_output.h"
#include "scene/writers/written_city.h"

namespace veduta::city {

/// Each building is a block of 3DFACEs and an INSERT of it, so that it stays one object; a mesh that several
/// share is one block. The layer of a 3DFACE is its material. A placement that INSERT cannot express is laid
/// out in the block. Ground is 3DFACEs on its layer. Names of blocks and layers keep letters, digits, '_',
/// '-' and '$'; a shared block is called after its first building. The names of the others are not kept.
void write_dxf(const WrittenCity& city, OrderedOutput& output);

/// What an INSERT can do: scale along the axes, then turn about z, then move.
struct Insert {
  glm::dvec3 at{0};
  glm::dvec3 scale{1};
  double degrees = 0;
};
std::optional<Insert> insert_of(const glm::dmat4x3& placement);

}  // namespace veduta::city
