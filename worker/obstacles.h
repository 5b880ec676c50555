// The pieces of exposed surface around a place, quickly.
#pragma once

#include <vector>

#include "worker/exposed_surface.h"
#include "worker/plan_index.h"

namespace veduta {

/// An index of the pieces by their bounds, on a plan grid.
class Obstacles {
 public:
  /// \param surface  outlives the index
  Obstacles(const ExposedSurface& surface, double cell_m);

  size_t size() const { return index_.size(); }
  const Box& bounds(uint32_t piece) const { return index_.box(piece); }
  const glm::dvec3& normal(uint32_t piece) const { return surface_.normal[piece]; }
  /// Corners of a piece.
  const glm::dvec3* begin(uint32_t piece) const { return &surface_.corners[surface_.begin[piece]]; }
  const glm::dvec3* end(uint32_t piece) const {
    return begin(piece) + (surface_.begin[piece + 1] - surface_.begin[piece]);
  }
  /// The least dot(normal, p) over the piece.
  double nearest(uint32_t piece, const glm::dvec3& normal) const;
  /// The pieces whose bounds meet the box, by number.
  void find(const Box& box, std::vector<uint32_t>& found) const { index_.find(box, found); }

 private:
  const ExposedSurface& surface_;
  PlanIndex index_;
};

}  // namespace veduta
