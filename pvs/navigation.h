// Where a viewer can be: an octree of navigable space and a terrain height field (DESIGN §3, thesis §3.1.4).
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace veduta {

/// A linear octree over a cube. Each inner node has eight children, numbered x + 2y + 4z; the state of child
/// k is bits 2k, 2k+1 of `states`: 0 not navigable, 1 navigable, 2 mixed. The mixed children of a node are
/// consecutive, in order, from `first_child`. Node 0 is the root; a tree without nodes has no navigable
/// space.
struct FreeOctree {
  glm::vec3 lower{0};                 ///< corner of the cube, m, relative to the scene origin
  float leaf_size_m = 1;              ///< edge of the smallest leaf (the seed size)
  uint32_t depth = 0;                 ///< the cube's edge is leaf_size_m * 2^depth
  std::vector<uint16_t> states;       ///< [M]
  std::vector<uint32_t> first_child;  ///< [M]

  /// Is the point in navigable space? Constant time: `depth` steps.
  bool contains(const glm::vec3& point) const;
};

/// Ground heights on a regular grid. Sample (i, j) stands for the square of edge step_m at lower + step_m *
/// (i, j) and holds the highest ground in it, in m relative to the scene origin; NaN where there is no
/// ground.
struct HeightField {
  float lower_x = 0, lower_y = 0, step_m = 1;
  uint32_t nx = 0, ny = 0;
  std::vector<float> height;  ///< [ny * nx], x fastest

  /// Ground at a point, NaN outside.
  float at(float x, float y) const;
};

struct Navigation {
  FreeOctree free;
  HeightField ground;
};

}  // namespace veduta
