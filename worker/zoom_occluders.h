// The shrunk occluders of one window in GL buffers, drawn as far as they reach into a view.
#pragma once

#include <vector>

#include "gl/handle.h"
#include "worker/occluders.h"
#include "worker/zoom_view.h"

namespace veduta {

/// One shrunk model of the city (thesis §4.2.1: occluders are shrunk once). Needs a current GL context.
class ZoomOccluders {
 public:
  explicit ZoomOccluders(const OccluderMesh& mesh);

  /// Draws with the current program, whose attribute 0 is a corner: bodies whose bounds reach into the
  /// frustum. \return how many triangles those have
  uint64_t draw(const ZoomFrustum& frustum);

 private:
  struct Body {
    Box bounds;
    uint32_t first_index;
  };
  struct Cluster {
    Box bounds;
    uint32_t first, count;  // bodies
  };
  void add_range(uint32_t first_index, uint32_t end_index);

  std::vector<Body> bodies_;  // neighbours follow each other; and one more, which ends the last
  std::vector<Cluster> clusters_;
  GlVertexArray vertices_;
  GlBuffer corners_, indices_;
  // What to draw: ranges of indices, their begins in bytes.
  std::vector<GLsizei> counts_;
  std::vector<const void*> begins_;
  uint32_t end_of_last_ = 0;
};

}  // namespace veduta
