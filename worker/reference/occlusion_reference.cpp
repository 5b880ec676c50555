#include "worker/reference/occlusion_reference.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

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

glm::dvec3 area_vector(const std::vector<glm::dvec3>& polygon) {
  glm::dvec3 sum(0);
  for (size_t c = 1; c + 1 < polygon.size(); ++c)
    sum += glm::cross(polygon[c] - polygon[0], polygon[c + 1] - polygon[0]);
  return sum;
}

}  // namespace

Panorama::Panorama(const std::vector<OccluderRing>& rings, int resolution, const glm::dvec3& eye,
                   double near_m, double slack_pixels)
    : size_(resolution),
      slack_(1e-12 + 2 * slack_pixels / resolution),
      eye_(eye),
      near_m_(near_m),
      depth_(static_cast<size_t>(face_count) * resolution * resolution, infinity) {
  for (int face = 0; face < face_count; ++face) {
    const glm::dmat3 rotation(face_from_world(face));
    for (const OccluderRing& ring : rings) {
      const OccluderMesh& mesh = ring.occluders;
      for (size_t f = 0; f < mesh.faces(); ++f) {
        std::vector<glm::dvec3> polygon;
        for (uint32_t c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c)
          polygon.push_back(rotation * (glm::dvec3(mesh.corners[c]) - eye));
        draw(face, polygon, ring.depth_limit_m);
      }
    }
  }
}

void Panorama::draw(int face, const std::vector<glm::dvec3>& polygon, double depth_limit_m) {
  const glm::dvec3 normal = area_vector(polygon);
  const double away = glm::dot(normal, polygon[0]);
  const auto behind = [](const glm::dvec3& corner) { return corner.z <= 0; };
  if (away >= 0 || std::all_of(polygon.begin(), polygon.end(), behind)) return;
  // The planes through the eye and each side. The polygon is closed: rounding leaves no crack to the next.
  std::vector<glm::dvec3> sides;
  for (size_t c = 0; c < polygon.size(); ++c)
    sides.push_back(glm::normalize(glm::cross(polygon[c], polygon[(c + 1) % polygon.size()])));
  // The pixels that it can touch: all, unless all of it is before the eye.
  glm::dvec2 lower(-1), upper(1);
  if (std::none_of(polygon.begin(), polygon.end(), behind)) {
    std::swap(lower, upper);
    for (const glm::dvec3& c : polygon)
      lower = glm::min(lower, glm::dvec2(c) / c.z), upper = glm::max(upper, glm::dvec2(c) / c.z);
  }
  const auto pixel = [&](double ratio) {
    return static_cast<int>(std::floor((std::clamp(ratio, -1.0, 1.0) + 1) * 0.5 * size_));
  };
  for (int y = std::max(pixel(lower.y) - 1, 0); y <= std::min(pixel(upper.y) + 1, size_ - 1); ++y) {
    for (int x = std::max(pixel(lower.x) - 1, 0); x <= std::min(pixel(upper.x) + 1, size_ - 1); ++x) {
      const glm::dvec3 direction((2 * x + 1.0) / size_ - 1, (2 * y + 1.0) / size_ - 1, 1);
      const bool meets = std::all_of(sides.begin(), sides.end(), [&](const glm::dvec3& side) {
        return !(glm::dot(side, direction) > slack_);
      });
      const double depth = away / glm::dot(normal, direction);
      double& nearest = depth_[(static_cast<size_t>(face) * size_ + y) * size_ + x];
      if (meets && depth >= near_m_ && depth <= depth_limit_m) nearest = std::min(nearest, depth);
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
    const auto pixel = [&](double ratio, double out) {
      return static_cast<int>(std::floor((std::clamp(ratio, -1.0, 1.0) + 1) * 0.5 * size_ + out));
    };
    const double out = strictness.outward_pixels;
    const int x0 = pixel(b.lower.x / (b.lower.x < 0 ? nearest : b.upper.z), -out),
              x1 = pixel(b.upper.x / (b.upper.x > 0 ? nearest : b.upper.z), out);
    const int y0 = pixel(b.lower.y / (b.lower.y < 0 ? nearest : b.upper.z), -out),
              y1 = pixel(b.upper.y / (b.upper.y > 0 ? nearest : b.upper.z), out);
    for (int y = std::max(y0, 0); y <= std::min(y1, size_ - 1); ++y) {
      for (int x = std::max(x0, 0); x <= std::min(x1, size_ - 1); ++x) {
        if (!(depth_m(face, x, y) < nearest * (1 - strictness.nearer_by))) return false;
      }
    }
  }
  return true;
}

}  // namespace veduta::reference
