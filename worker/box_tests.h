// Tests of boxes against the faces of a panorama, in compute shaders (DESIGN §7; §4, T2 and T3). All of it
// GL.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "gl/handle.h"
#include "gl/program.h"
#include "scene/box.h"
#include "worker/face_panes.h"

namespace veduta {

/// From where boxes are tested, and what of the faces was drawn.
struct TestView {
  glm::vec3 eye{0}, half_extent_m{0};
  float near_m = 0;
  int resolution = 0;
  const FacePanes::Rows& rows;
};

/// Holds the boxes of a city, of objects and of slices. Questions and answers are in the buffers bound to
/// PanoramaBinding; answers go to the places of their questions, those of slices to `first_answer` on.
class BoxTests {
 public:
  BoxTests(const std::vector<Box>& object_boxes, const std::vector<Box>& slice_boxes);

  /// \pre the faces are drawn and reduced (DepthFaces). Asks the questions [first, first + count).
  void objects(const TestView& view, uint32_t first, uint32_t count) const;
  void slices(const TestView& view, uint32_t first, uint32_t count, size_t first_answer) const;

 private:
  struct Test {
    explicit Test(const char* kind);
    void run(const TestView& view, uint32_t first, uint32_t count) const;

    Program program;
    GLint depth, eye, half_extent, near, outward, resolution, rows, strip_width, first, count;
  };

  Test objects_, slices_;
  GLint first_answer_, first_slice_box_;
  size_t object_count_;
  GlBuffer boxes_;
};

}  // namespace veduta
