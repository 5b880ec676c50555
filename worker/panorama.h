// Occlusion from parts of view-cells: the shrunk occluders drawn once into the faces of a cube, occludees
// tested against them in compute shaders (DESIGN §7, "panorama"; §4, T1-T3).
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "scene/box.h"
#include "worker/clustered_occluders.h"
#include "worker/occlusion_method.h"
#include "worker/slices.h"

namespace veduta {

/// How high is a vertical slice occluded? Its lowest `low` z-slices are known to be, and whether more than
/// `high` are makes no difference.
struct SliceQuestion {
  static constexpr uint32_t always = ~uint32_t{0};
  uint32_t first_box = 0;  ///< VerticalSlice::first_box
  uint32_t low = 0, high = 0;
  uint32_t object =
      always;  ///< number in `objects` of the question for its object: if that is hidden, so is this
};

/// What is asked of some parts, all at once.
struct QuestionBatch {
  struct Part {
    glm::vec3 center{0};
    uint32_t window = 0;                     ///< what occluders hide for
    bool everywhere = false;                 ///< draw all of the faces, not only what the questions look at
    uint32_t first_object = 0, objects = 0;  ///< its questions in `objects`
    uint32_t first_slice = 0, slices = 0;    ///< and in `slices`
  };
  std::vector<Part> parts;
  std::vector<uint32_t> objects;  ///< is this object hidden?
  std::vector<SliceQuestion> slices;

  void clear() { parts.clear(), objects.clear(), slices.clear(); }
};

/// Holds a city's occluders and test boxes in GL buffers. Needs a current GL 4.3 context, the same for its
/// whole life.
class Panorama {
 public:
  /// Batches that may be under way at a time.
  static constexpr int slots = 4;
  static constexpr float near_m = 0.05f;

  /// `object_boxes` [N] m; `slices` as made by slice_boxes for the same objects; `occluders` for
  /// every size of parts; the pixels of a face follow from their rings. The boxes outlive it.
  Panorama(const std::vector<Box>& object_boxes, const SliceBoxes& slices,
           const ClusteredOccluders& occluders);
  ~Panorama();

  /// Draws each part and asks its questions. Does not wait; the batch is free again when it returns.
  /// \pre slot < slots, and its last answers were taken.
  void ask(const QuestionBatch& batch, int slot);
  /// For each object of the batch 0 (hidden from all of the part) or 1, then for each slice its occluded
  /// height. Waits where it must. Valid until the next call for this slot.
  const std::vector<uint32_t>& answers(int slot);

  /// The depth of a face after the last part asked, R*R values near/z (0: nothing), row 0 lowest; for tests.
  /// Faces: +x -x +y -y +z.
  std::vector<float> read_face(int face) const;
  /// Pixels along a face of a window: the fewest that its rings allow.
  int resolution(uint32_t window) const;

  const OcclusionCounters& counters() const;
  OcclusionCounters& counters();
  /// See OcclusionMethod::measure.
  void measure();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace veduta
