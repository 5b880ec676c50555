// The occluders of a city in one GL buffer, in clusters that are culled against a face before they are drawn.
#pragma once

#include <epoxy/gl.h>

#include <vector>

#include "gl/handle.h"
#include "worker/shrink.h"

namespace veduta {

class OccluderStore {
 public:
  explicit OccluderStore(const std::vector<Ring>& rings);

  size_t ring_count() const { return rings_.size(); }
  float depth_limit_m(size_t ring) const { return rings_[ring].depth_limit_m; }

  /// Draws the boxes of a ring that can matter in a face: those that reach into its frustum, begin before the ring's depth limit
  /// and do not end before the limit of the ring before, which draws the same occluders with less taken off.
  void draw(size_t ring, int face, const glm::vec3& eye) const;

 private:
  struct Cluster {
    Box bounds;
    uint32_t first, count;  // instances
  };
  struct RingClusters {
    float depth_from_m, depth_limit_m;
    std::vector<Cluster> clusters;
  };
  std::vector<RingClusters> rings_;
  GlBuffer boxes_, indices_;
  GlVertexArray vertex_array_;
};

}  // namespace veduta
