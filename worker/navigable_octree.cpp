// Building and asking the octree of navigable space (thesis §3.1.4: contraction of the free cells into larger
// blocks).
#include <algorithm>
#include <array>
#include <cmath>

#include "worker/view_cells.h"

namespace veduta {
namespace {

constexpr uint32_t none = 0, all = 1, mixed = 2;

/// Contracts from the top: a node is only opened where cells lie, so the cost follows the cells and not the
/// city.
class Builder {
 public:
  Builder(const BitGrid& free, const std::vector<Box>& cells) : free_(free), cells_(cells) {}

  FreeOctree build() {
    const GridFrame& frame = free_.frame();
    FreeOctree tree;
    tree.lower = {static_cast<float>(frame.x(0)), static_cast<float>(frame.y(0)),
                  static_cast<float>(frame.z(0))};
    tree.leaf_size_m = static_cast<float>(frame.size_m);
    tree.depth = 1;
    while ((1 << tree.depth) < std::max({frame.nx, frame.ny, frame.nz})) ++tree.depth;
    std::vector<uint32_t> candidates(cells_.size());
    for (uint32_t c = 0; c < cells_.size(); ++c) candidates[c] = c;
    const uint32_t state = node(0, 0, 0, static_cast<int>(tree.depth), candidates);
    if (state != mixed) {  // nothing navigable: a tree without nodes. (All of a cube cannot be: its border is
                           // padding.)
      return tree;
    }
    // Breadth first, so that the mixed children of a node are consecutive.
    std::vector<uint32_t> queue{static_cast<uint32_t>(nodes_.size() - 1)};
    for (size_t q = 0; q < queue.size(); ++q) {
      const Node& from = nodes_[queue[q]];
      tree.states.push_back(from.states);
      tree.first_child.push_back(static_cast<uint32_t>(queue.size()));
      for (int k = 0; k < 8; ++k) {
        if ((from.states >> 2 * k & 3) == mixed) queue.push_back(from.child[k]);
      }
    }
    return tree;
  }

 private:
  struct Node {
    uint16_t states = 0;
    std::array<uint32_t, 8> child{};
  };

  uint32_t node(int i, int j, int k, int level, const std::vector<uint32_t>& candidates) {
    const GridFrame& frame = free_.frame();
    if (candidates.empty() || i >= frame.nx || j >= frame.ny || k >= frame.nz) return none;
    const int edge = 1 << level;
    if (level == 0) return free_.get(i, j, k) ? all : none;
    Node here;
    bool any_all = false, any_none = false, any_mixed = false;
    for (int c = 0; c < 8; ++c) {
      const int half = edge / 2;
      const int ci = i + (c & 1) * half, cj = j + (c >> 1 & 1) * half, ck = k + (c >> 2) * half;
      const Box box = frame.box(ci, ci + half - 1, cj, cj + half - 1, ck, ck + half - 1);
      std::vector<uint32_t> inside;
      for (const uint32_t cell : candidates) {
        const Box& b = cells_[cell];
        // Sharing only a face is not lying in it.
        if (b.lower.x < box.upper.x && b.upper.x > box.lower.x && b.lower.y < box.upper.y &&
            b.upper.y > box.lower.y && b.lower.z < box.upper.z && b.upper.z > box.lower.z) {
          inside.push_back(cell);
        }
      }
      const uint32_t state = node(ci, cj, ck, level - 1, inside);
      here.states |= static_cast<uint16_t>(state << 2 * c);
      if (state == mixed) here.child[c] = static_cast<uint32_t>(nodes_.size() - 1);
      any_all |= state == all, any_none |= state == none, any_mixed |= state == mixed;
    }
    if (!any_mixed && !any_none) return all;
    if (!any_mixed && !any_all) return none;
    nodes_.push_back(here);
    return mixed;
  }

  const BitGrid& free_;
  const std::vector<Box>& cells_;
  std::vector<Node> nodes_;  // children before parents; the root is last
};

/// Extends `found` by what of a node's navigable leaves, grown by `margin`, lies in the box.
void collect(const FreeOctree& tree, uint32_t node, glm::vec3 lower, float edge, const Box& box, float margin,
             Box& found) {
  uint32_t next_child = tree.first_child[node];
  for (int k = 0; k < 8; ++k) {
    const uint32_t state = tree.states[node] >> 2 * k & 3;
    const uint32_t child = state == mixed ? next_child++ : 0;
    if (state == none) continue;
    const glm::vec3 l = lower + 0.5f * edge * glm::vec3(k & 1, k >> 1 & 1, k >> 2);
    const Box inside{glm::max(l - margin, box.lower), glm::min(l + 0.5f * edge + margin, box.upper)};
    if (inside.empty()) continue;
    if (state == all) {
      found.extend(inside);
    } else {
      collect(tree, child, l, 0.5f * edge, box, margin, found);
    }
  }
}

}  // namespace

FreeOctree navigable_octree(const BitGrid& free, const std::vector<Box>& cells) {
  return Builder(free, cells).build();
}

Box navigable_part(const FreeOctree& octree, const Box& box, float margin_m) {
  Box found;
  if (octree.states.empty()) return found;
  collect(octree, 0, octree.lower, octree.leaf_size_m * static_cast<float>(1u << octree.depth), box, margin_m,
          found);
  return found;
}

}  // namespace veduta
