// A block as the shrinking methods see it, out of the tiles that it and its halo touch.
#include <algorithm>

#include "worker/tile_state.h"
#include "worker/tile_triangles.h"

namespace veduta {

SealedBlock load_block(const RunPaths& run, const PreparationPlan& plan, uint32_t block) {
  const LatticeRect core = plan.block(block), around = plan.grown(core, plan.halo_voxels);
  SealedBlock loaded{load_region(run, plan, around),
                     // A tile has the triangles around it as far as any of its blocks looks.
                     read_tile_triangles(run, plan, plan.tile_of_block(block)), core.i0 - around.i0,
                     core.i1 - around.i0, core.j0 - around.j0, core.j1 - around.j0};
  const GridFrame& f = loaded.region.frame();
  const double margin = 1e-3 * f.size_m;  // more than the seed test's: what it marked is there
  std::erase_if(loaded.triangles, [&](const PlacedTriangle& triangle) {
    const Box box = bounds(triangle);
    return box.upper.x < f.x(0) - margin || box.upper.y < f.y(0) - margin ||
           box.lower.x > f.x(f.nx) + margin || box.lower.y > f.y(f.ny) + margin;
  });
  return loaded;
}

}  // namespace veduta
