#include "worker/reference/occlusion_reference.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "worker/cube_face.h"

namespace veduta::reference {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct FaceBox {
  glm::dvec3 lower, upper;  // right, up, forward
};

FaceBox face_box(int face, const glm::dvec3& lower, const glm::dvec3& upper) {
  const glm::dmat3 m(face_from_world(face));
  const glm::dvec3 a = m * lower, b = m * upper;
  return {glm::min(a, b), glm::max(a, b)};
}

/// Planar depth at which the ray (x, y, 1) * depth enters the box, infinity if it does not or if it starts
/// inside of it.
double entry_depth(const FaceBox& box, double x, double y) {
  double enter = -infinity, leave = infinity;
  const glm::dvec3 direction(x, y, 1);
  for (int a = 0; a < 3; ++a) {
    if (direction[a] == 0) {
      if (box.lower[a] > 0 || box.upper[a] < 0) return infinity;
      continue;
    }
    const double t0 = box.lower[a] / direction[a], t1 = box.upper[a] / direction[a];
    enter = std::max(enter, std::min(t0, t1)), leave = std::min(leave, std::max(t0, t1));
  }
  return enter <= leave && enter > 0 ? enter : infinity;
}

}  // namespace

Panorama::Panorama(const std::vector<Ring>& rings, int resolution, const glm::dvec3& eye, double near_m)
    : size_(resolution),
      eye_(eye),
      near_m_(near_m),
      depth_(static_cast<size_t>(face_count) * resolution * resolution, infinity) {
  for (int face = 0; face < face_count; ++face) {
    for (const Ring& ring : rings) {
      for (const Box& world : ring.boxes) {
        const FaceBox box = face_box(face, glm::dvec3(world.lower) - eye, glm::dvec3(world.upper) - eye);
        if (box.upper.z <= 0) continue;
        for (int y = 0; y < size_; ++y) {
          for (int x = 0; x < size_; ++x) {
            const double depth = entry_depth(box, (2 * x + 1.0) / size_ - 1, (2 * y + 1.0) / size_ - 1);
            double& nearest = depth_[(static_cast<size_t>(face) * size_ + y) * size_ + x];
            if (depth >= near_m && depth <= ring.depth_limit_m) nearest = std::min(nearest, depth);
          }
        }
      }
    }
  }
}

bool Panorama::hidden(const Box& box, const glm::dvec3& half_extent_m, const Strictness& strictness) const {
  const glm::dvec3 center = 0.5 * (glm::dvec3(box.lower) + glm::dvec3(box.upper)) - eye_;
  const glm::dvec3 half =
      glm::max(0.5 * (glm::dvec3(box.upper) - glm::dvec3(box.lower)) - half_extent_m, glm::dvec3(0));
  for (int face = 0; face < 6; ++face) {
    const FaceBox b = face_box(face, center - half, center + half);
    const double nearest = std::max({b.lower.x, -b.upper.x, b.lower.y, -b.upper.y, b.lower.z, 0.0});
    if (nearest > b.upper.z) continue;
    if (face == 5 || nearest < near_m_) return false;
    const auto pixel = [&](double ratio) {
      return static_cast<int>(std::floor((std::clamp(ratio, -1.0, 1.0) + 1) * 0.5 * size_));
    };
    const int x0 = pixel(b.lower.x / (b.lower.x < 0 ? nearest : b.upper.z)),
              x1 = pixel(b.upper.x / (b.upper.x > 0 ? nearest : b.upper.z));
    const int y0 = pixel(b.lower.y / (b.lower.y < 0 ? nearest : b.upper.z)),
              y1 = pixel(b.upper.y / (b.upper.y > 0 ? nearest : b.upper.z));
    const int out = strictness.outward_pixels;
    for (int y = std::max(y0 - out, 0); y <= std::min(y1 + out, size_ - 1); ++y) {
      for (int x = std::max(x0 - out, 0); x <= std::min(x1 + out, size_ - 1); ++x) {
        if (!(depth_m(face, x, y) < nearest * (1 - strictness.nearer_by))) return false;
      }
    }
  }
  return true;
}

}  // namespace veduta::reference
