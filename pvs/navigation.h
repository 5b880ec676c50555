// Where a viewer can be, and what is in the way: forests of octrees and a height field of the ground (DESIGN
// §3, thesis §3.1.4 and §3.2).
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace veduta {

/// Sets of voxels as a forest of octrees (thesis §3.1.4, §3.2). Its roots are cubes of 2^depth voxels on one
/// lattice, whatever the bounds of the city and however it was cut for the work; only roots with something in
/// them are listed. Each node has eight children, numbered x + 2y + 4z; the state of child k is bits 2k, 2k+1
/// of `states`: 0 nothing of it is in the set, 1 all of it, 2 mixed. Node r is root r. The mixed children of
/// a node are consecutive, in order, from `first_child`; nodes are in breadth-first order.
struct OctreeForest {
  glm::vec3 lower{0};                 ///< lower corner of root (0, 0, 0), m, relative to the scene origin
  float leaf_size_m = 1;              ///< edge of a voxel
  uint32_t depth = 1;                 ///< a root's edge is leaf_size_m * 2^depth
  std::vector<glm::ivec3> roots;      ///< [R] number of each root; ascending by z, then y, then x
  std::vector<uint16_t> states;       ///< [M], M >= R
  std::vector<uint32_t> first_child;  ///< [M]

  bool operator==(const OctreeForest&) const = default;
  float root_edge_m() const { return leaf_size_m * static_cast<float>(uint32_t{1} << depth); }
  /// The node of a root, nothing where no root is listed.
  std::optional<uint32_t> find_root(const glm::ivec3& number) const;
  /// Does the point lie in a voxel of the set? A search among the roots, then `depth` steps.
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
  OctreeForest free;      ///< where a viewer can be: the free voxels that lie in a view-cell
  OctreeForest surfaces;  ///< the voxels that a triangle passes: what a viewer runs into, or points at
  HeightField ground;
};

}  // namespace veduta
