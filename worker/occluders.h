// Shrunk occluders, as every shrinking method gives them and the panorama draws them.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "scene/box.h"

namespace veduta {

/// Bodies bounded by planar convex polygons, flat in memory. Corners of a face go counter-clockwise seen from
/// outside, so that faces turned away from the eye need not be drawn. Any part of a body may be missing: to
/// leave out occluders errs towards visible.
struct OccluderMesh {
  std::vector<glm::vec3> corners;       ///< m, relative to the scene origin
  std::vector<uint32_t> face_begin{0};  ///< [F+1] first corner of a face
  std::vector<uint32_t> body_begin{0};  ///< [B+1] first face of a body

  size_t bodies() const { return body_begin.size() - 1; }
  size_t faces() const { return face_begin.size() - 1; }
  /// What is drawn: a face of n corners is n - 2 triangles.
  size_t triangles() const { return corners.size() - 2 * faces(); }
  Box bounds(size_t body) const;

  void add_box(const Box& box);
  /// Adds a face to the body that end_body will close; fewer than three corners are no face.
  void add_face(const std::vector<glm::vec3>& corners);
  void end_body();
  void append(const OccluderMesh& other);
};

/// What a pixel is taken to be wider by, for vertices are snapped to a grid finer than pixels (T3's sigma;
/// generous).
inline constexpr double snapping = 1.0 / 64;

/// The occluders of one ring: inside O eroded by the window [-(e + h), e + h], to be drawn up to
/// depth_limit_m (T3).
struct OccluderRing {
  double h_m = 0;           ///< what every pixel may be off by, sideways and in depth
  float depth_limit_m = 0;  ///< planar depth up to which a pixel is no wider than h
  OccluderMesh occluders;
};

/// What hides for every box of a size: whole cells or their parts.
struct WindowOccluders {
  glm::dvec3 half_extent_m{0};  ///< e, eye margin included
  std::vector<OccluderRing> rings;
};

/// Of windows of these half-extents the smallest that holds a part of this half-extent (eye margin included):
/// what its occluders hide from a centre is hidden from all of the part around it. None where all are too
/// small.
std::optional<uint32_t> smallest_window(const std::vector<glm::dvec3>& windows_m,
                                        const glm::dvec3& half_extent_m);

}  // namespace veduta
