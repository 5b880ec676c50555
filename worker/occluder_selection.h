// Which occluders one face of a panorama needs ("model only what a scene needs"), and what of them can face
// the eye. No GL.
#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "worker/clustered_occluders.h"
#include "worker/horizon.h"

namespace veduta {

/// A corner of a quad to draw: position relative to the eye, m, and the depth limit of its ring, m.
using OccluderVertex = glm::vec4;

/// A rectangle of a face, as right / forward and up / forward.
struct FaceView {
  float left = -1, right = 1, bottom = -1, top = 1;
};

/// The occluders of one size of window.
class OccluderSelection {
 public:
  /// Of one of the windows.
  OccluderSelection(ClusteredOccluders occluders, size_t window);

  /// The polygons that matter to a face, of the nearest bodies first, as quads of four vertices each: a
  /// polygon of more corners is a fan of quads, and one with an odd number of corners ends with a quad whose
  /// last two are the same. Bodies that reach into the face's frustum, begin before their ring's depth limit,
  /// do not end before the limit of the ring before (which draws the same occluders with less taken off), and
  /// stand out above the horizon of the nearer ones; of each, the polygons that face the eye. To leave an
  /// occluder out errs towards visible. Valid until the next call, which reuses its memory.
  /// \param view what of the face is drawn: bodies beside it are left out.
  const std::vector<OccluderVertex>& select(int face, const glm::vec3& eye, const FaceView& view = {});

 private:
  struct RingClusters {
    float depth_from_m, depth_limit_m;
    uint32_t first;  // cluster
    std::span<const Box> bounds;
  };
  struct Near {
    float depth_m;
    uint32_t index;
    bool operator<(const Near& other) const {
      return depth_m < other.depth_m || (depth_m == other.depth_m && index < other.index);
    }
  };

  void select_ring(const RingClusters& ring, int face, const glm::vec3& eye, const FaceView& view,
                   Horizon& horizon);
  void draw_body(const OccluderCluster& cluster, uint32_t body, int face, const glm::vec3& eye,
                 float depth_limit_m, const FaceView& view, Horizon* horizon);

  ClusteredOccluders occluders_;
  std::vector<RingClusters> rings_;
  std::vector<Near> clusters_by_depth_, bodies_by_depth_;
  std::vector<glm::vec3> turned_;  // corners of the polygon at hand, in face coordinates
  std::vector<OccluderVertex> vertices_;
};

}  // namespace veduta
