// What checking all cells of a file takes once.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "pvs/pvs_file.h"
#include "scene/ray_scene.h"

namespace veduta {

/// A file, and what is found out about it once for all cells.
struct CheckedCity {
  /// The file must outlive it. \throw Error(bad_input) when the scene has no triangle.
  explicit CheckedCity(const PvsFile& file);

  const PvsFile& file;
  RayScene rays;
  double narrow_gap_limit_m;
  std::vector<uint32_t> object_of;  ///< [T]
  std::vector<glm::vec3> centers;   ///< [O] of the objects' bounds
};

}  // namespace veduta
