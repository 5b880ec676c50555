// Making forests of octrees (pvs/navigation.h): contraction of voxels into larger and larger blocks (thesis
// §3.1.4).
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <map>

#include "pvs/navigation.h"
#include "worker/bit_grid.h"

namespace veduta {

inline constexpr int root_depth = 6;
inline constexpr int root_voxels = 1 << root_depth;  ///< along an edge: a column of a root is one word

/// The voxels of a root: bit k of word y * 64 + x is voxel (x, y, k).
using VoxelCube = std::array<uint64_t, root_voxels * root_voxels>;

/// Puts cubes and forests together, in any order.
class ForestBuilder {
 public:
  /// \param lattice whose planes the voxels lie between; its extent does not matter
  explicit ForestBuilder(const GridFrame& lattice);

  /// Adds the voxels of root (i, j, k): voxels 64 i .. 64 i + 63 of the lattice along x, and so on.
  void add(const glm::ivec3& root, const VoxelCube& voxels);
  /// Adds the voxels of a forest on the same lattice.
  void add(const OctreeForest& forest);
  OctreeForest finish() const;

 private:
  /// Nodes of one root, itself first.
  struct Tree {
    std::vector<uint16_t> states;
    std::vector<uint32_t> first_child;
  };
  void place(const glm::ivec3& root, Tree tree);
  static Tree contract(const VoxelCube& voxels);
  static void fill(const Tree& tree, VoxelCube& voxels);

  OctreeForest empty_;
  std::map<std::array<int, 3>, Tree> trees_;  // by z, y, x
};

}  // namespace veduta
