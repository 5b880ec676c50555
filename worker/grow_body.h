// Growing a convex body in sealed space: an intersection of half-spaces that keeps off every exposed piece.
#pragma once

#include <optional>
#include <vector>

#include "worker/convex_body.h"
#include "worker/eroded_samples.h"
#include "worker/obstacles.h"

namespace veduta {

/// What a body grows for.
struct Growth {
  glm::dvec3 window_m{0};              ///< w: the body eroded by [-w, w] is what will hide
  Box within;                          ///< m: obstacles are known in here; the body stays inside
  std::vector<glm::dvec3> directions;  ///< unit normals to try: of the walls and roofs around
  glm::dvec3 sample_m{1};              ///< what a sample stands for: edges of a box around it
  double sill_m = 0;                   ///< two seeds: a side moves by this rather than that a new one is made
  double room_m = 0;                   ///< left for rounding between the body and what it keeps off
};

/// A convex body P in sealed space whose erosion by the window holds `seed`, bounded by planes of exposed
/// pieces where that pays. Obstacles are taken nearest first; one that the half-spaces so far do not keep off
/// adds the half-space that loses the fewest of `samples` (after C-space regions of Deits & Tedrake, IRIS
/// 2015, with planes chosen by count). In the end every obstacle in `within` lies outside of some half-space,
/// so P meets none; it holds a sealed point and is connected, so all of it is sealed. \return nothing when an
/// obstacle passes the seed's window. `samples` keeps those whose windows lie in P.
std::optional<std::vector<HalfSpace>> grow_body(const Obstacles& obstacles, const Growth& growth,
                                                const glm::dvec3& seed, std::vector<glm::dvec3>& samples);

}  // namespace veduta
