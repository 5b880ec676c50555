// Navigable space and surfaces as forests of octrees (thesis §3.1.4, §3.2), and a question to such a forest.
#include <algorithm>
#include <functional>
#include <map>
#include <memory>

#include "worker/octree_forest.h"
#include "worker/view_cells.h"

namespace veduta {
namespace {

/// Bits [first, first + 63] of a column; `above` stands for what is above the grid.
uint64_t column_word(const BitGrid& grid, int i, int j, int first, bool above) {
  const uint64_t* bits = grid.column(i, j);
  const auto word = [&](int w) -> uint64_t {
    if (w < 0) return 0;
    const uint64_t beyond = above ? ~run_mask(w, 0, grid.frame().nz - 1) : 0;
    return w < grid.words() ? bits[w] | beyond : beyond;
  };
  const int w = first >> 6, shift = first & 63;
  return shift == 0 ? word(w) : word(w) >> shift | word(w + 1) << (64 - shift);
}

int root_of(int voxel) {
  return voxel >> root_depth;
}

/// The forest of the voxels word(i, j, first) of the columns, where bit n is voxel (i, j, first + n) of the
/// frame, in layers [k0, k1] of the frame.
OctreeForest make_forest(const GridFrame& frame, const ColumnRange& core, int k0, int k1,
                         const std::function<uint64_t(int, int, int)>& word) {
  ForestBuilder builder(frame);
  const auto cube = std::make_unique<VoxelCube>();
  for (int rk = root_of(frame.k0 + k0); rk <= root_of(frame.k0 + k1); ++rk) {
    for (int rj = root_of(frame.j0 + core.j0); rj <= root_of(frame.j0 + core.j1 - 1); ++rj) {
      for (int ri = root_of(frame.i0 + core.i0); ri <= root_of(frame.i0 + core.i1 - 1); ++ri) {
        cube->fill(0);
        const int x0 = ri * root_voxels - frame.i0, y0 = rj * root_voxels - frame.j0;
        for (int j = std::max(y0, core.j0); j < std::min(y0 + root_voxels, core.j1); ++j) {
          for (int i = std::max(x0, core.i0); i < std::min(x0 + root_voxels, core.i1); ++i)
            (*cube)[(j - y0) * root_voxels + i - x0] = word(i, j, rk * root_voxels - frame.k0);
        }
        builder.add({ri, rj, rk}, *cube);
      }
    }
  }
  return builder.finish();
}

/// Numbers of the squares in which each of `count` columns lies, from column `first` of the lattice on.
std::vector<VoxelRange> squares_of_columns(int first, int count, double size_m, const GridFrame& frame) {
  std::vector<VoxelRange> squares(count);
  const double lower = first * frame.size_m - frame.aside_m, upper = lower + count * frame.size_m;
  for (int s = static_cast<int>(std::floor(lower / size_m)); s * size_m < upper; ++s) {
    const VoxelRange columns = voxels_of(s * size_m, (s + 1) * size_m, frame);
    for (int c = std::max(columns.first - first, 0); c <= std::min(columns.last - first, count - 1); ++c) {
      if (squares[c].last < squares[c].first) squares[c].first = s;
      squares[c].last = s;
    }
  }
  return squares;
}

/// Extends `found` by what of a node's navigable leaves, grown by `margin`, lies in the box.
void collect(const OctreeForest& forest, uint32_t node, glm::vec3 lower, float edge, const Box& box,
             float margin, Box& found) {
  uint32_t next_child = forest.first_child[node];
  for (int k = 0; k < 8; ++k) {
    const uint32_t state = forest.states[node] >> 2 * k & 3;
    const uint32_t child = state == 2 ? next_child++ : 0;
    if (state == 0) continue;
    const glm::vec3 l = lower + 0.5f * edge * glm::vec3(k & 1, k >> 1 & 1, k >> 2);
    const Box inside{glm::max(l - margin, box.lower), glm::min(l + 0.5f * edge + margin, box.upper)};
    if (inside.empty()) continue;
    if (state == 1) {
      found.extend(inside);
    } else {
      collect(forest, child, l, 0.5f * edge, box, margin, found);
    }
  }
}

}  // namespace

OctreeForest navigable_forest(const CellSpace& space, const ColumnRange& core,
                              const std::vector<LatticeCell>& cells) {
  const GridFrame& frame = space.region.frame();
  const double size_m = space.options.size_m;
  std::map<std::pair<int, int>, std::vector<VoxelRange>> layers;  // of the cells of a square, in the frame
  int k0 = 0, k1 = -1;
  for (const LatticeCell& cell : cells) {
    VoxelRange range = voxels_of(cell.box.lower.z, cell.box.upper.z, frame);
    range.first = std::max(range.first - frame.k0, 0), range.last -= frame.k0;
    k0 = k1 < k0 ? range.first : std::min(k0, range.first), k1 = std::max(k1, range.last);
    auto& ranges = layers[{cell.i, cell.j}];
    if (!ranges.empty() && range.first <= ranges.back().last + 1)
      ranges.back().last = std::max(ranges.back().last, range.last);
    else
      ranges.push_back(range);
  }
  if (k1 < k0) return ForestBuilder(frame).finish();
  const auto squares_x = squares_of_columns(frame.i0, frame.nx, size_m, frame);
  const auto squares_y = squares_of_columns(frame.j0, frame.ny, size_m, frame);
  return make_forest(frame, core, k0, k1, [&](int i, int j, int first) {
    uint64_t inside = 0;
    for (int sj = squares_y[j].first; sj <= squares_y[j].last; ++sj) {
      for (int si = squares_x[i].first; si <= squares_x[i].last; ++si) {
        const auto here = layers.find({si, sj});
        if (here == layers.end()) continue;
        for (const VoxelRange& range : here->second)
          inside |= run_mask(0, range.first - first, range.last - first);
      }
    }
    return inside == 0 ? 0 : inside & column_word(space.region.free, i, j, first, true);
  });
}

OctreeForest surface_forest(const SeedRegion& region, const ColumnRange& core) {
  return make_forest(region.frame(), core, 0, region.frame().nz - 1, [&](int i, int j, int first) {
    const uint64_t word = column_word(*region.occupied, i, j, first, false);
    if (first > 0 || first <= -64 || (word >> -first & 1) == 0 || region.surface_in(i, j, 0)) return word;
    return word & ~(uint64_t{1} << -first);  // occupied only because it reaches below the scene
  });
}

Box navigable_part(const OctreeForest& forest, const Box& box, float margin_m) {
  Box found;
  if (box.empty() || forest.roots.empty()) return found;
  const float edge = forest.root_edge_m(), reach = margin_m + forest.leaf_size_m;
  const auto number = [&](const glm::vec3& p) { return glm::ivec3(glm::floor((p - forest.lower) / edge)); };
  const glm::ivec3 first = number(box.lower - reach), last = number(box.upper + reach);
  for (int k = first.z; k <= last.z; ++k) {
    for (int j = first.y; j <= last.y; ++j) {
      for (int i = first.x; i <= last.x; ++i) {
        const auto root = forest.find_root({i, j, k});
        if (root)
          collect(forest, *root, forest.lower + glm::vec3(i, j, k) * edge, edge, box, margin_m, found);
      }
    }
  }
  return found;
}

}  // namespace veduta
