#include "bench/grid_masks.h"

#include <openvdb/tools/LevelSetUtil.h>
#include <openvdb/tools/Prune.h>

#include <stdexcept>
#include <vector>

namespace veduta::bench {

using openvdb::Coord;
using openvdb::CoordBBox;

Mask mask_of(const BitGrid& grid) {
  Mask mask;
  openvdb::tree::ValueAccessor<Mask> accessor(mask);
  visit_set(grid, [&](int i, int j, int k) { accessor.setValueOn(Coord(i, j, k)); });
  openvdb::tools::prune(mask);
  return mask;
}

Mask mask_of(const BrickGrid& bricks, const BitGrid& occupied) {
  Mask mask;
  openvdb::tree::ValueAccessor<Mask> accessor(mask);
  visit_set(occupied, [&](int i, int j, int k) {
    for (Brick seeds = bricks.at(i, j, k); seeds != 0; seeds &= seeds - 1) {
      const int bit = std::countr_zero(seeds);
      accessor.setValueOn(Coord(4 * i + bit % 4, 4 * j + bit / 4 % 4, 4 * k + bit / 16));
    }
  });
  openvdb::tools::prune(mask);
  return mask;
}

openvdb::BoolTree::Ptr flood(const Mask& occupied, const CoordBBox& box) {
  Mask open;
  open.fill(box, true, true);
  open.topologyDifference(occupied);
  std::vector<openvdb::BoolTree::Ptr> parts;
  openvdb::tools::extractActiveVoxelSegmentMasks(open, parts);
  for (const openvdb::BoolTree::Ptr& part : parts) {
    if (!part->isValueOn(box.max())) continue;
    openvdb::tools::prune(*part);
    return part;
  }
  throw std::runtime_error("OpenVDB: no free space above the scene");
}

Mask flood_by_hand(const Mask& occupied, const CoordBBox& box) {
  Mask free;
  openvdb::tree::ValueAccessor<const Mask> wall(occupied);
  openvdb::tree::ValueAccessor<Mask> reached(free);
  std::vector<Coord> stack = {box.max()};
  reached.setValueOn(box.max());
  const Coord faces[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  while (!stack.empty()) {
    const Coord at = stack.back();
    stack.pop_back();
    for (const Coord& face : faces) {
      const Coord next = at + face;
      if (!box.isInside(next) || wall.isValueOn(next) || reached.isValueOn(next)) continue;
      reached.setValueOn(next);
      stack.push_back(next);
    }
  }
  openvdb::tools::prune(free);
  return free;
}

Mask sealed_with_floor(const BitGrid& sealed, int layers) {
  Mask mask = mask_of(sealed);
  const GridFrame& frame = sealed.frame();
  if (layers > 0) mask.fill({Coord(0, 0, -layers), Coord(frame.nx - 1, frame.ny - 1, -1)}, true, true);
  return mask;
}

}  // namespace veduta::bench
