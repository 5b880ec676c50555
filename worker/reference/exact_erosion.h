// Erosion without approximation: solids minus the windows of their boundary, in exact arithmetic.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

namespace veduta::reference {

/// S = O eroded by the window X = [-half, half], as O minus (facet + X) for every facet of O's boundary: each
/// a convex hull, subtracted as Nef polyhedra (CGAL). O is the union of solids that may touch; below what of
/// them touches the ground (their lowest z) all is sealed (thesis fig. 4.16): solids go on downwards.
class ExactErosion {
 public:
  using Triangle = std::array<glm::vec3, 3>;

  /// \param solids each a closed 2-manifold that does not meet itself, triangles facing outwards or all
  /// inwards. Nothing is repaired. \throw Error(bad_input) for what is no such solid, or a union that meets
  /// itself along an edge alone; Error(usage) when there are more than most_facets in all: time and memory
  /// grow fast.
  ExactErosion(const std::vector<std::vector<Triangle>>& solids, const glm::dvec3& half_extent_m,
               size_t most_facets = 100);
  ~ExactErosion();

  double volume_m3() const;  ///< above the ground
  /// Is the point in S, its boundary included?
  bool contains(const glm::dvec3& point_m) const;

 private:
  struct Solid;
  std::unique_ptr<const Solid> eroded_;
};

}  // namespace veduta::reference
