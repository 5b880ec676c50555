// The panorama as a slow CPU kernel: one ray a pixel against every polygon of every occluder, in double;
// every pixel of an occludee looked at.
#pragma once

#include <vector>

#include "worker/occluders.h"

namespace veduta::reference {

/// How strictly `hidden` asks. The product: 1/64 of a pixel outward and depths nearer by 1e-5.
struct Strictness {
  double outward_pixels = 1.0 / 64;
  double nearer_by = 1e-5;
};

class Panorama {
 public:
  /// \param slack_pixels a pixel whose middle lies so far beside an occluder is covered, too: renderers round
  /// vertices, and T3's sigma allows for 1/128.
  Panorama(const std::vector<OccluderRing>& rings, int resolution, const glm::dvec3& eye, double near_m,
           double slack_pixels = 0);

  /// Planar depth at which the ray through the pixel's centre meets an occluder, m; infinity for none. Faces
  /// as cube_face.h.
  double depth_m(int face, int x, int y) const {
    return depth_[(static_cast<size_t>(face) * size_ + y) * size_ + x];
  }

  /// Is a box (m) hidden from every point eye + [-e, e]? T2 applied.
  bool hidden(const Box& box, const glm::dvec3& half_extent_m, const Strictness& strictness) const;

 private:
  void draw(int face, const std::vector<glm::dvec3>& polygon, double depth_limit_m);

  int size_;
  double slack_;
  glm::dvec3 eye_;
  double near_m_;
  std::vector<double> depth_;
};

}  // namespace veduta::reference
