// The surface that free space touches: the boundary of sealed space, as convex pieces of the city's own
// triangles.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "scene/box.h"
#include "worker/shrinker.h"

namespace veduta {

/// Convex planar polygons, flat in memory: triangles, and parts of triangles where only a part is exposed.
struct ExposedSurface {
  std::vector<glm::dvec3> corners;  ///< m, relative to the scene origin
  std::vector<uint32_t> begin{0};   ///< [P+1] first corner of a piece
  std::vector<glm::dvec3> normal;   ///< [P] of the piece's plane, unit length, either way

  size_t size() const { return normal.size(); }
};

/// The parts of the block's triangles that lie in seeds beside what the fill reached (over a face, edge or
/// corner): the boundary between free and sealed space is a subset of them. A piece reaches at most about two
/// seeds beyond the exposed part. Faces inside of buildings, party walls and ground under a house are not
/// exposed. Pieces end at the region's bounds.
///
/// This is what makes shrinking follow true walls and roofs: with F free space and X the window, F + X is F
/// and (its boundary + X), so sealed space eroded by X is what is sealed and not within X of an exposed
/// piece.
ExposedSurface exposed_surface(const SealedBlock& block);

}  // namespace veduta
