// Occlusion from one part of a view-cell at a time as the thesis finds it: a quadtree culled in 90-degree
// sections, then a frustum zoomed onto each candidate, with hardware occlusion queries (§4.2.2, Algorithms
// 4.1 and 4.2). docs/occlusion.md says where it follows the thesis, and what its answers are worth.
#pragma once

#include <memory>
#include <vector>

#include "scene/box.h"
#include "worker/clustered_occluders.h"
#include "worker/occlusion_method.h"
#include "worker/slices.h"

namespace veduta {

/// Needs a current GL 4.3 context, the same for its whole life. May share it with others: it leaves the
/// context's state as it finds it, but for depth test, depth clear value and clip control, which it sets as
/// the panorama does.
class Zoom {
 public:
  /// `object_boxes` [N] m; `slices` as made by slice_boxes for the same objects, `windows`: occluders for
  /// every size of parts, of which the first ring is taken. Both of these outlive the zoom.
  Zoom(const std::vector<Box>& object_boxes, const SliceBoxes& slices, ClusteredOccluders occluders);
  ~Zoom();

  /// Forgets what was found: everything counts as hidden until a part sees it.
  void begin_cell();
  /// Tests everything from a part of this half-extent (eye margin included) around its centre, with the
  /// occluders of the smallest window that holds it, and unites what it sees with what the others saw. Where
  /// no window holds it, nothing is hidden from it.
  void add_part(const glm::vec3& center, const glm::dvec3& half_extent_m);
  const Occlusion& finish_cell() const;

  const OcclusionCounters& counters() const;
  /// From now on stages are timed.
  void measure();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace veduta
