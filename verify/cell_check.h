// One view-cell against rays.
#pragma once

#include "scene/ray_scene.h"
#include "verify/verify.h"

namespace veduta {

/// What the rays from one cell found.
struct CellCheck {
  bool has_eye = false;  ///< else nothing below is filled in
  uint64_t rays = 0, hits = 0;
  uint64_t cleared = 0;  ///< hits on undrawn triangles that exact arithmetic did not confirm
  /// What was seen and is not drawn.
  struct Missing {
    double share = 0;        ///< of solid angle, over all eye points
    double worst_share = 0;  ///< of solid angle, at the worst eye point
    uint64_t objects = 0, triangles = 0;
    std::vector<FalseInvisible> examples;  ///< the nearest of each object, by object
  };
  Missing wrong;   ///< false invisible
  Missing narrow;  ///< seen through nothing but narrow gaps; its objects are not in `wrong`
  uint64_t pvs_objects = 0, seen_objects = 0, pvs_buildings = 0, seen_buildings = 0;
  uint64_t pvs_triangles = 0, seen_triangles = 0;
  uint64_t whole_triangles = 0;       ///< of the listed objects, drawn or not
  uint64_t seen_whole_triangles = 0;  ///< of the seen objects, seen or not
  uint64_t tightest_triangles = 0;    ///< of the smallest row that draws all that was seen
};

/// Half of the rays go all over the sphere, half at what the row does not draw. Depends on nothing but its
/// arguments.
CellCheck check_cell(const PvsFile& file, uint32_t cell, const VerifyOptions& options, const RayScene& rays,
                     double narrow_gap_limit_m);

}  // namespace veduta
