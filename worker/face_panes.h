// Which pixels of a panorama the questions look at: what no question looks at need not be drawn ("model only
// what a scene needs").
#pragma once

#include <array>
#include <vector>

#include "worker/cube_face.h"

namespace veduta {

/// A rectangle of pixels of a face: columns [x0, x1), rows [y0, y1), row 0 lowest.
struct Pane {
  int face = 0, x0 = 0, x1 = 0, y0 = 0, y1 = 0;

  int pixels() const { return (x1 - x0) * (y1 - y0); }
};

/// The pixels that a box covers on a face, first and last in both directions, one pixel outward (T3).
struct PixelBounds {
  bool reaches = false;  ///< does the box reach into the face's frustum?
  bool at_eye = false;   ///< nearer than the near plane or on the lower face: visible, no pixel tells
  int x0 = 0, x1 = 0, y0 = 0, y1 = 0;
};

/// \param relative the box relative to the eye; \param face 0..5, 5 is what is straight below. As the test
/// shader has it, save for rounding.
PixelBounds pixel_bounds(const Box& relative, int face, int resolution, float near_m);

/// Gathers what is looked at in strips of columns, and makes few rectangles of it.
class FacePanes {
 public:
  /// Strips of a face and multiples of pixels that panes begin and end at (the coarsest texels of the
  /// pyramid).
  static constexpr int strips = 16, alignment = 16;
  /// Rows [lower, upper) that are drawn in each strip of each face; none where lower >= upper.
  using Rows = std::array<std::array<std::array<int, 2>, strips>, face_count>;

  /// Pixels along a face, a power of two, at least `alignment`.
  explicit FacePanes(int resolution) : resolution_(resolution) { clear(); }

  void clear();
  /// Everything on every face.
  void add_all();
  /// What a test of this box, taken relative to the eye, looks at.
  void add(const Box& relative, float near_m);

  static int strip_width(int resolution) { return std::max(resolution / strips, alignment); }
  const Rows& rows() const { return rows_; }
  /// Disjoint rectangles that hold all rows() and not much more. Valid until the next call; rows() is then
  /// what the panes hold.
  const std::vector<Pane>& make();

 private:
  int resolution_;
  Rows rows_;
  std::vector<Pane> panes_;
};

}  // namespace veduta
