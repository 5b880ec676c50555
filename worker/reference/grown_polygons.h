// Segments against convex polygons that are grown by boxes, in double: exact up to rounding, and slow.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "worker/occluders.h"

namespace veduta::reference {

/// A set of convex polygons, each of them grown by a box [-g, g] of its own (their Minkowski sum).
class GrownPolygons {
 public:
  /// Adds the polygons of all bodies.
  void add(const OccluderMesh& mesh, const glm::dvec3& grown_by_m);
  /// After the last add, before the first question.
  void build();

  /// Does the segment meet any of them? One that passes within `slack_m` of one counts as meeting it. A
  /// segment with both ends inside of a body does not meet the polygons around it: ask from an end that is
  /// outside.
  bool meet(const glm::dvec3& from, const glm::dvec3& to, double slack_m = 1e-6) const;

 private:
  struct Bounds {
    glm::dvec3 lower, upper;
  };
  struct Polygon {
    uint32_t first, count;  // corners
    glm::dvec3 grown_by_m;
    Bounds bounds;  // grown
  };
  struct Node {
    Bounds bounds;
    uint32_t first, count;  // polygons of a leaf; of an inner node 0, its children at `first` and after
  };

  void split(uint32_t node, uint32_t first, uint32_t last);
  bool meets(const Polygon& polygon, const glm::dvec3& middle, const glm::dvec3& half, double slack_m) const;

  std::vector<glm::dvec3> corners_;
  std::vector<Polygon> polygons_;
  std::vector<Node> nodes_;
};

}  // namespace veduta::reference
