// The occluders of a city, and which of them one face of a panorama needs ("model only what a scene needs").
#pragma once

#include <epoxy/gl.h>

#include <vector>

#include "gl/handle.h"
#include "worker/shrink.h"

namespace veduta {

/// Boxes of one ring to draw, in instances [first, first + count) of the store's buffer.
struct RingDraw {
  float depth_limit_m = 0;
  uint32_t first = 0, count = 0;
};

class OccluderStore {
 public:
  explicit OccluderStore(const std::vector<Ring>& rings);

  /// Chooses the boxes that matter to a face, nearest first, and uploads them: those that reach into its frustum, begin before
  /// their ring's depth limit, do not end before the limit of the ring before (which draws the same occluders with less taken off),
  /// and stand out above the horizon of the nearer ones. To leave an occluder out errs towards visible, so the horizon need
  /// not be exact. \return one entry per ring, valid until the next call.
  const std::vector<RingDraw>& select(int face, const glm::vec3& eye);

  void draw(const RingDraw& ring) const;

 private:
  struct Cluster {
    Box bounds;
    uint32_t first, count;  // boxes
  };
  struct RingClusters {
    float depth_from_m, depth_limit_m;
    std::vector<Cluster> clusters;
  };
  class Horizon;

  std::vector<RingClusters> rings_;
  std::vector<Box> boxes_;
  // Reused from call to call: nothing is allocated on the hot path once they have grown.
  struct Near {
    float depth_m;
    uint32_t index;
  };
  std::vector<Near> clusters_by_depth_, boxes_by_depth_;
  std::vector<Box> selected_;
  std::vector<RingDraw> draws_;
  GlBuffer instances_, indices_;
  GlVertexArray vertex_array_;
};

}  // namespace veduta
