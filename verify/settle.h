// Which triangle a ray meets first, in exact arithmetic.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "scene/scene.h"

namespace veduta {

/// The undrawn triangle that the ray meets strictly before every drawn one, exactly; nothing when a drawn
/// triangle is met first or at the same point (then the picture shows the same surface), or when nothing is
/// met. `candidates`: triangles to look at, at least all that the ray meets up to the hit in question.
/// `drawn`: [T], 0 or 1. A triangle is closed: its edges and corners belong to it. One that the ray lies in
/// covers no solid angle and is not met, nor is one that holds the eye itself. Of several undrawn ones at the
/// same point the first candidate is named.
std::optional<uint32_t> undrawn_met_first(const Scene& scene, const glm::vec3& eye,
                                          const glm::vec3& direction, std::span<const uint32_t> candidates,
                                          const std::vector<uint8_t>& drawn);

}  // namespace veduta
