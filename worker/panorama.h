// Occlusion from one part of a view-cell at a time: the shrunk occluders drawn once into the faces of a cube,
// every occludee tested against them in compute shaders (DESIGN §7, "panorama"; §4, T1-T3).
#pragma once

#include <memory>
#include <vector>

#include "scene/box.h"
#include "worker/occluders.h"
#include "worker/occlusion_method.h"
#include "worker/slices.h"

namespace veduta {

/// Holds a city's occluders and test boxes in GL buffers. Needs a current GL 4.3 context, the same for its
/// whole life.
class Panorama {
 public:
  /// `object_boxes` [N] m; `slices` as made by slice_boxes for the same objects; `windows`: occluders for
  /// every size of parts; `resolution`: R, pixels along the edge of a cube face, a power of two, for which
  /// the occluders were made.
  Panorama(const std::vector<Box>& object_boxes, const SliceBoxes& slices,
           const std::vector<WindowOccluders>& windows, int resolution);
  ~Panorama();

  /// Forgets what was found: everything counts as hidden until a part sees it.
  void begin_cell();
  /// Draws the occluders of the smallest window that holds a part of this half-extent (eye margin included)
  /// around its centre, and unites what the part sees with what the others saw. Where no window holds it,
  /// nothing is hidden from it. Does not wait.
  void add_part(const glm::vec3& center, const glm::dvec3& half_extent_m);
  /// Reads all answers of the cell back, at once.
  const Occlusion& finish_cell();

  /// The depth of a face after add_part, R*R values near/z (0: nothing), row 0 lowest; for tests. Faces: +x
  /// -x +y -y +z.
  std::vector<float> read_face(int face) const;

  static constexpr float near_m = 0.05f;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace veduta
