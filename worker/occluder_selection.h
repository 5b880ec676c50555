// Which occluders one face of a panorama needs ("model only what a scene needs"), and what of them can face
// the eye. No GL.
#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "worker/horizon.h"
#include "worker/shrink.h"

namespace veduta {

/// A corner of a quad to draw: position relative to the eye, m, and the depth limit of its ring, m.
using OccluderVertex = glm::vec4;

class OccluderSelection {
 public:
  explicit OccluderSelection(const std::vector<Ring>& rings);

  /// Most vertices that one call can give.
  size_t capacity() const { return boxes_.size() * vertices_per_box; }

  /// The quads that matter to a face, nearest boxes first, four vertices a quad, in order around it. Boxes
  /// that reach into the face's frustum, begin before their ring's depth limit, do not end before the limit
  /// of the ring before (which draws the same occluders with less taken off), and stand out above the horizon
  /// of the nearer ones; of each, the sides that face the eye. To leave an occluder out errs towards visible.
  /// Valid until the next call; allocates nothing.
  const std::vector<OccluderVertex>& select(int face, const glm::vec3& eye);

 private:
  static constexpr size_t vertices_per_box = 12;  // three sides of a box at most face a point
  struct Cluster {
    Box bounds;
    uint32_t first, count;  // boxes
  };
  struct RingClusters {
    float depth_from_m, depth_limit_m;
    std::vector<Cluster> clusters;
  };
  struct Near {
    float depth_m;
    uint32_t index;
    bool operator<(const Near& other) const {
      return depth_m < other.depth_m || (depth_m == other.depth_m && index < other.index);
    }
  };

  void select_ring(const RingClusters& ring, int face, const glm::vec3& eye, Horizon& horizon);
  void add_sides(const Box& relative, float depth_limit_m);

  std::vector<RingClusters> rings_;
  std::vector<Box> boxes_;
  std::vector<Near> clusters_by_depth_, boxes_by_depth_;
  std::vector<OccluderVertex> vertices_;
};

}  // namespace veduta
