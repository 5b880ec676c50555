#include "worker/octree_forest.h"

#include <memory>

namespace veduta {
namespace {

constexpr uint32_t none = 0, all = 1, mixed = 2;

/// For every block of 2^level voxels of a root: is all of it set, is any of it set. One word a column, of
/// which the lowest 64 >> level bits count.
struct Level {
  std::vector<uint64_t> all, any;
};

/// Brings the even bits together.
uint64_t even_bits(uint64_t x) {
  x &= 0x5555555555555555;
  x = (x | x >> 1) & 0x3333333333333333;
  x = (x | x >> 2) & 0x0f0f0f0f0f0f0f0f;
  x = (x | x >> 4) & 0x00ff00ff00ff00ff;
  x = (x | x >> 8) & 0x0000ffff0000ffff;
  return (x | x >> 16) & 0x00000000ffffffff;
}

std::array<Level, root_depth + 1> contract_levels(const VoxelCube& voxels) {
  std::array<Level, root_depth + 1> levels;
  levels[0].all.assign(voxels.begin(), voxels.end());
  levels[0].any = levels[0].all;
  for (int level = 1; level <= root_depth; ++level) {
    const Level& fine = levels[level - 1];
    Level& coarse = levels[level];
    const size_t edge = static_cast<size_t>(root_voxels) >> level;
    coarse.all.resize(edge * edge), coarse.any.resize(edge * edge);
    for (size_t y = 0; y < edge; ++y) {
      for (size_t x = 0; x < edge; ++x) {
        const size_t a = 2 * y * 2 * edge + 2 * x, b = a + 2 * edge;
        const uint64_t every = fine.all[a] & fine.all[a + 1] & fine.all[b] & fine.all[b + 1];
        const uint64_t some = fine.any[a] | fine.any[a + 1] | fine.any[b] | fine.any[b + 1];
        coarse.all[y * edge + x] = even_bits(every & every >> 1);
        coarse.any[y * edge + x] = even_bits(some | some >> 1);
      }
    }
  }
  return levels;
}

uint32_t state_of(const Level& level, size_t edge, size_t x, size_t y, size_t z) {
  if (level.all[y * edge + x] >> z & 1) return all;
  return level.any[y * edge + x] >> z & 1 ? mixed : none;
}

}  // namespace

ForestBuilder::ForestBuilder(const GridFrame& lattice) {
  empty_.lower = glm::vec3(static_cast<float>(-lattice.aside_m));
  empty_.leaf_size_m = static_cast<float>(lattice.size_m);
  empty_.depth = root_depth;
}

ForestBuilder::Tree ForestBuilder::contract(const VoxelCube& voxels) {
  const auto levels = contract_levels(voxels);
  struct Node {
    int level;
    size_t x, y, z;
  };
  Tree tree;
  std::vector<Node> queue{{root_depth, 0, 0, 0}};
  for (size_t q = 0; q < queue.size(); ++q) {
    const Node node = queue[q];
    const int level = node.level - 1;
    const size_t edge = static_cast<size_t>(root_voxels) >> level, first = queue.size();
    uint32_t states = 0;
    for (uint32_t c = 0; c < 8; ++c) {
      const size_t x = 2 * node.x + (c & 1), y = 2 * node.y + (c >> 1 & 1), z = 2 * node.z + (c >> 2);
      const uint32_t state = state_of(levels[level], edge, x, y, z);
      states |= state << 2 * c;
      if (state == mixed) queue.push_back({level, x, y, z});
    }
    tree.states.push_back(static_cast<uint16_t>(states));
    tree.first_child.push_back(queue.size() > first ? static_cast<uint32_t>(first) : 0);
  }
  return tree;
}

void ForestBuilder::fill(const Tree& tree, VoxelCube& voxels) {
  struct Node {
    uint32_t index;
    int level, x, y, z;
  };
  std::vector<Node> open{{0, root_depth, 0, 0, 0}};
  while (!open.empty()) {
    const Node node = open.back();
    open.pop_back();
    const int edge = 1 << (node.level - 1);
    uint32_t child = tree.first_child[node.index];
    for (int c = 0; c < 8; ++c) {
      const uint32_t state = tree.states[node.index] >> 2 * c & 3;
      const int x = node.x + (c & 1) * edge, y = node.y + (c >> 1 & 1) * edge, z = node.z + (c >> 2) * edge;
      if (state == mixed) open.push_back({child++, node.level - 1, x, y, z});
      if (state != all) continue;
      for (int b = y; b < y + edge; ++b) {
        for (int a = x; a < x + edge; ++a) voxels[b * root_voxels + a] |= run_mask(0, z, z + edge - 1);
      }
    }
  }
}

void ForestBuilder::place(const glm::ivec3& root, Tree tree) {
  const auto [here, placed] = trees_.try_emplace({root.z, root.y, root.x}, std::move(tree));
  if (placed) return;
  // Two parts of a root, where the edge of a tile passes through it.
  const auto both = std::make_unique<VoxelCube>();
  both->fill(0);
  fill(here->second, *both);
  fill(tree, *both);
  here->second = contract(*both);
}

void ForestBuilder::add(const glm::ivec3& root, const VoxelCube& voxels) {
  uint64_t some = 0;
  for (const uint64_t word : voxels) some |= word;
  if (some != 0) place(root, contract(voxels));
}

void ForestBuilder::add(const OctreeForest& forest) {
  for (uint32_t r = 0; r < forest.roots.size(); ++r) {
    Tree tree;
    std::vector<uint32_t> queue{r};
    for (size_t q = 0; q < queue.size(); ++q) {
      const uint16_t states = forest.states[queue[q]];
      const auto first = static_cast<uint32_t>(queue.size());
      uint32_t child = forest.first_child[queue[q]];
      for (int c = 0; c < 8; ++c)
        if ((states >> 2 * c & 3) == mixed) queue.push_back(child++);
      tree.states.push_back(states);
      tree.first_child.push_back(queue.size() > first ? first : 0);
    }
    place(forest.roots[r], std::move(tree));
  }
}

OctreeForest ForestBuilder::finish() const {
  OctreeForest forest = empty_;
  for (const auto& [number, tree] : trees_) {
    forest.roots.emplace_back(number[2], number[1], number[0]);
    forest.states.push_back(tree.states[0]);
    forest.first_child.push_back(tree.first_child[0]);
  }
  size_t r = 0;
  for (const auto& [number, tree] : trees_) {
    // Node n of the tree, but the root, becomes node offset + n.
    const auto offset = static_cast<uint32_t>(forest.states.size() - 1);
    const auto moved = [&](size_t n) { return tree.first_child[n] == 0 ? 0 : tree.first_child[n] + offset; };
    forest.first_child[r++] = moved(0);
    for (size_t n = 1; n < tree.states.size(); ++n) {
      forest.states.push_back(tree.states[n]);
      forest.first_child.push_back(moved(n));
    }
  }
  return forest;
}

}  // namespace veduta
