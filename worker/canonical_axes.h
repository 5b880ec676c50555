// Axes that turn with the city, so that what is made on a lattice is the same, up to the turn, for a city
// that was rotated by 90 degrees or mirrored.
#pragma once

#include <utility>

#include "pvs/navigation.h"
#include "scene/box.h"
#include "worker/occluders.h"
#include "worker/placed_triangles.h"

namespace veduta {

/// A signed permutation of x and y, about the scene's origin. Canonical (x, y) is (+-x, +-y) of the scene,
/// then swapped or not. Exact in floating point.
struct CanonicalAxes {
  bool negate_x = false, negate_y = false;  ///< of the scene's axes
  bool swap = false;

  bool operator==(const CanonicalAxes&) const = default;
  bool mirrors() const { return negate_x ^ negate_y ^ swap; }

  template <typename Vector>
  Vector to_canonical(Vector v) const {
    if (negate_x) v.x = -v.x;
    if (negate_y) v.y = -v.y;
    if (swap) std::swap(v.x, v.y);
    return v;
  }
  template <typename Vector>
  Vector from_canonical(Vector v) const {
    if (swap) std::swap(v.x, v.y);
    if (negate_x) v.x = -v.x;
    if (negate_y) v.y = -v.y;
    return v;
  }

  Box to_canonical(const Box& box) const;
  /// Facing outwards as before.
  PlacedTriangle to_canonical(PlacedTriangle triangle) const;

  Box from_canonical(const Box& box) const;
  /// Faces go counter-clockwise seen from outside as before.
  void turn_back(OccluderMesh& mesh) const;
  HeightField from_canonical(const HeightField& field) const;
  OctreeForest from_canonical(const OctreeForest& forest) const;
};

/// The axes in which the wider spread of the triangles' corners is along x, and in which they lean (third
/// central moment) towards positive x and y. The same, up to the turn, for a scene turned by 90 degrees or
/// mirrored, whatever the order of its triangles. Where a moment does not decide, the scene's own axis stays:
/// of a symmetric scene all of them are alike.
CanonicalAxes choose_axes(const Scene& scene);

}  // namespace veduta
