#include "verify/narrow_gap.h"

#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <numbers>
#include <vector>

namespace veduta {
namespace {

constexpr int lines = 36;               // through the ray, 5 degrees from each other
constexpr int stations_in_limit = 8;    // places along the ray that are looked at
constexpr int stations_in_search = 16;  // that share a search for what lies around
constexpr double free_disc = 0.8;       // of the width

using Segment = std::array<glm::dvec2, 2>;

double cross(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

double distance_to(const glm::dvec2& point, const Segment& s) {
  const glm::dvec2 along = s[1] - s[0];
  const double length2 = glm::dot(along, along);
  const double t = length2 > 0 ? std::clamp(glm::dot(point - s[0], along) / length2, 0.0, 1.0) : 0;
  return glm::distance(point, s[0] + t * along);
}

/// What is around a ray, in the planes across it.
class Across {
 public:
  Across(const Scene& scene, const glm::vec3& eye, const glm::vec3& direction)
      : scene_(scene), eye_(eye), along_(glm::normalize(glm::dvec3(direction))) {
    const glm::dvec3 other = std::abs(along_.z) < 0.7 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    right_ = glm::normalize(glm::cross(along_, other)), up_ = glm::cross(right_, along_);
    for (int k = 0; k < lines; ++k) {
      const double angle = std::numbers::pi * k / lines;
      lines_[static_cast<size_t>(k)] = {std::cos(angle), std::sin(angle)};
    }
  }

  void surround(const std::vector<uint32_t>& triangles) {
    corners_.clear();
    for (const uint32_t t : triangles) {
      std::array<glm::dvec3, 3>& corners = corners_.emplace_back();
      for (int k = 0; k < 3; ++k) {
        const glm::dvec3 p = glm::dvec3(scene_.vertices[scene_.triangles[t][k]]) - eye_;
        corners[static_cast<size_t>(k)] = {glm::dot(p, right_), glm::dot(p, up_), glm::dot(p, along_)};
      }
    }
  }

  /// The narrowest gap at a distance from the eye, infinity where there is none below the limit.
  double width_at(double distance_m, double limit_m) {
    cut(distance_m, limit_m);
    double narrowest = std::numeric_limits<double>::infinity();
    if (segments_.size() < 2) return narrowest;
    for (const glm::dvec2& line : lines_) {
      double ahead = limit_m, behind = limit_m;
      for (const Segment& s : segments_) {
        const double side0 = cross(line, s[0]), side1 = cross(line, s[1]);
        if ((side0 > 0) == (side1 > 0)) continue;
        const double at = glm::dot(line, s[0] + (s[1] - s[0]) * (side0 / (side0 - side1)));
        if (at > 0) ahead = std::min(ahead, at);
        if (at < 0) behind = std::min(behind, -at);
      }
      const double width = ahead + behind;
      if (width >= std::min(limit_m, narrowest)) continue;
      const glm::dvec2 middle = line * (0.5 * (ahead - behind));
      if (std::all_of(segments_.begin(), segments_.end(),
                      [&](const Segment& s) { return distance_to(middle, s) >= 0.5 * free_disc * width; }))
        narrowest = width;
    }
    return narrowest;
  }

 private:
  // Where the plane at a distance from the eye cuts the triangles around. Those that lie in it are left out.
  void cut(double distance_m, double limit_m) {
    segments_.clear();
    for (const std::array<glm::dvec3, 3>& c : corners_) {
      Segment segment{};
      size_t ends = 0;
      for (size_t k = 0; k < 3 && ends < 2; ++k) {
        const glm::dvec3 &a = c[k], &b = c[(k + 1) % 3];
        if ((a.z > distance_m) == (b.z > distance_m)) continue;
        segment[ends++] = glm::dvec2(glm::mix(a, b, (distance_m - a.z) / (b.z - a.z)));
      }
      if (ends == 2 && distance_to({0, 0}, segment) < limit_m) segments_.push_back(segment);
    }
  }

  const Scene& scene_;
  glm::dvec3 eye_, along_, right_{0}, up_{0};
  std::array<glm::dvec2, lines> lines_;
  std::vector<std::array<glm::dvec3, 3>> corners_;  // right, up, along from the eye
  std::vector<Segment> segments_;
};

/// Widths at places one step apart, as they come.
class Stretch {
 public:
  explicit Stretch(double step_m) : step_m_(step_m) {}

  /// The width of the gap that is as long as it is wide and ends here, infinity where none does.
  double add(double width_m) {
    if (std::isinf(width_m)) {
      widths_.clear();
      return width_m;
    }
    widths_.push_back(width_m);
    double widest = 0;
    for (size_t back = 0; back < widths_.size(); ++back) {
      widest = std::max(widest, widths_[widths_.size() - 1 - back]);
      if (static_cast<double>(back) * step_m_ >= widest) return widest;
    }
    return std::numeric_limits<double>::infinity();
  }

 private:
  double step_m_;
  std::vector<double> widths_;  // since the last place without a gap
};

}  // namespace

std::optional<NarrowGap> narrow_gap(const Scene& scene, const RayScene& rays, const glm::vec3& eye,
                                    const glm::vec3& direction, float hit_distance_m, double limit_m) {
  if (!(limit_m > 0)) return {};
  const double step_m = limit_m / stations_in_limit;
  const double first_m = limit_m, last_m = hit_distance_m - limit_m;
  const double half_search_m = 0.5 * stations_in_search * step_m;
  const auto radius_m = static_cast<float>(1.001 * std::hypot(limit_m, half_search_m));
  Across across(scene, eye, direction);
  Stretch stretch(step_m);
  for (int64_t station = 0; first_m + static_cast<double>(station) * step_m <= last_m; ++station) {
    const double distance_m = first_m + static_cast<double>(station) * step_m;
    if (station % stations_in_search == 0)
      across.surround(
          rays.triangles_around(eye + direction * static_cast<float>(distance_m + half_search_m), radius_m));
    const double width_m = stretch.add(across.width_at(distance_m, limit_m));
    if (width_m < limit_m) return NarrowGap{static_cast<float>(distance_m), static_cast<float>(width_m)};
  }
  return {};
}

double narrow_gap_limit_m(const std::string& config_toml) {
  try {
    return 2 * std::max(0.0, toml::parse(config_toml)["navigation"]["seed_size"].value_or(0.0));
  } catch (const toml::parse_error&) {
    return 0;
  }
}

}  // namespace veduta
