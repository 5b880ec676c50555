// Is something seen only because a ray slips through a gap that a bake may take for closed?
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "scene/ray_scene.h"

namespace veduta {

/// A gap on the way of a ray.
struct NarrowGap {
  float distance_m = 0;  ///< from the eye
  float width_m = 0;     ///< where it is widest over a stretch as long as that
};

/// The first gap narrower than `limit_m` that the ray passes between `limit_m` from the eye and `limit_m`
/// before the hit. A gap is where surfaces lie on opposite sides of the ray: in the plane across it, a line
/// through the ray meets one on either side, `width_m` apart, and a disc of four fifths of that width between
/// the two is free of surfaces (so the corner between a wall and the ground is no gap: surfaces at more than
/// some 75 degrees are not opposite). It must be so over a stretch of the ray at least as long as the gap is
/// wide: neither grazing one corner nor passing two that lie apart is a gap, nor a hole in a wall thinner
/// than the hole is wide. Finds fewer gaps than there are, never more: lines are tried at 5 degrees from each
/// other, places at an eighth of the limit.
std::optional<NarrowGap> narrow_gap(const Scene& scene, const RayScene& rays, const glm::vec3& eye,
                                    const glm::vec3& direction, float hit_distance_m, double limit_m);

/// Two seeds, m: gaps narrower than this may count as closed (DESIGN §3). From the configuration of a bake;
/// 0, so that nothing is excused, where that does not say.
double narrow_gap_limit_m(const std::string& config_toml);

}  // namespace veduta
