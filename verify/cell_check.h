// One view-cell against rays.
#pragma once

#include <functional>
#include <span>

#include "verify/checked_city.h"
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
  struct Seen {
    uint64_t rays = 0, objects = 0, buildings = 0, triangles = 0;
  };
  std::vector<Seen> seen;  ///< after 1/8, 1/4, 1/2 and all of the rays
  uint64_t pvs_objects = 0, pvs_buildings = 0, pvs_triangles = 0;
  uint64_t whole_triangles = 0;       ///< of the listed objects, drawn or not
  uint64_t seen_whole_triangles = 0;  ///< of the seen objects, seen or not
  uint64_t tightest_triangles = 0;    ///< of the smallest row that draws all that was seen
  VerifyTimes times;                  ///< of this cell; without set_up_s
};

/// Rays of a kind that follow each other, as they were traced.
using RaySink = std::function<void(std::span<const Ray>)>;

/// Depends on nothing but the file and the options. \param sink gets all rays, for whom it may concern.
CellCheck check_cell(const CheckedCity& city, uint32_t cell, const VerifyOptions& options,
                     const RaySink& sink = {});

}  // namespace veduta
