// The skyline of the occluders chosen so far on a side face of a panorama, by columns.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec3.hpp>
#include <utility>

#include "scene/box.h"

namespace veduta {

/// Keeps, for each column of a side face, the highest up / forward below which nearer bodies hide everything:
/// they reach down below the eye. Only used to leave occluders out, which errs towards visible; so it need
/// not be exact: what stands in an arch of a body that is not convex counts as hidden by it.
class Horizon {
 public:
  Horizon() {
    slope_.fill(none);
    top_.fill(none), bottom_.fill(-none);
  }

  /// The slope below which all columns of a box (in face coordinates, nearest depth `nearest_m` > 0) between
  /// `left` and `right` (right / forward) are hidden already.
  float hidden_below(const Box& b, float nearest_m, float left = -1, float right = 1) const {
    const float lower = b.lower.x / (b.lower.x < 0 ? nearest_m : b.upper.z);
    const float upper = b.upper.x / (b.upper.x > 0 ? nearest_m : b.upper.z);
    return hidden_between(std::clamp(lower, left, right), std::clamp(upper, left, right));
  }

  /// The same for the columns between two right / forward, left <= right.
  float hidden_between(float left, float right) const {
    const auto column = [&](float ratio) {
      return static_cast<int>((std::clamp(ratio, -1.0f, 0.99999f) + 1.0f) * (0.5f * count));
    };
    return *std::min_element(slope_.begin() + column(left), slope_.begin() + column(right) + 1);
  }

  /// The highest slope under which a box is seen.
  static float highest(const Box& b, float nearest_m) {
    return b.upper.y / (b.upper.y > 0 ? nearest_m : b.upper.z);
  }

  /// An edge of a polygon that is drawn, in face coordinates; all the edges of a body's drawn polygons, then
  /// end_body.
  void add_edge(glm::vec3 a, glm::vec3 b, float depth_limit_m) {
    if (!clip(a, b, depth_limit_m)) return;
    if (a.x * b.z > b.x * a.z) std::swap(a, b);  // from left to right
    const float left = place(a), right = place(b);
    // Edges of columns in (left, right]; both are more than -4, so that whole numbers are cut off downwards.
    const int first = std::max(static_cast<int>(left + 4) - 3, 0),
              last = std::min(static_cast<int>(right + 4) - 4, count);
    if (first > last) return;
    // Straight lines are straight in the picture.
    const float slope_a = a.y / a.z, slope_b = b.y / b.z;
    const float step = right > left ? (slope_b - slope_a) / (right - left) : 0;
    for (int c = first; c <= last; ++c) {
      const float slope = slope_a + (static_cast<float>(c) - left) * step;
      top_[c] = std::max(top_[c], slope), bottom_[c] = std::min(bottom_[c], slope);
    }
    first_ = std::min(first_, first), last_ = std::max(last_, last);
  }

  /// Raises the columns that the body fills from edge to edge, to where it does on both of their edges: a
  /// convex body fills what is in between. Bodies that float above the eye hide no ground.
  void end_body() {
    for (int c = first_; c < last_; ++c) {
      if (std::max(bottom_[c], bottom_[c + 1]) <= 0)
        slope_[c] = std::max(slope_[c], std::min(top_[c], top_[c + 1]));
    }
    for (int c = first_; c <= last_; ++c) top_[c] = none, bottom_[c] = -none;
    first_ = count, last_ = 0;
  }

 private:
  static constexpr int count = 512;
  static constexpr float none = -1e30f;

  /// Where a point lies among the edges of columns: edge c is at right / forward = c / 256 - 1.
  static float place(const glm::vec3& p) { return (p.x / p.z + 1) * (0.5f * count); }

  /// The part of the edge in front of the eye, as far as it is drawn and hardly beside the face. \return
  /// false for none.
  static bool clip(glm::vec3& a, glm::vec3& b, float depth_limit_m) {
    constexpr float beside = 1.01f, nearest_m = 1e-3f;
    if (!clip(a, b, a.z - nearest_m, b.z - nearest_m) ||
        !clip(a, b, depth_limit_m - a.z, depth_limit_m - b.z))
      return false;
    a.z = std::max(a.z, nearest_m), b.z = std::max(b.z, nearest_m);  // of a long edge, rounded
    return clip(a, b, beside * a.z - a.x, beside * b.z - b.x) &&
           clip(a, b, beside * a.z + a.x, beside * b.z + b.x);
  }
  static bool clip(glm::vec3& a, glm::vec3& b, float inside_a, float inside_b) {
    if (inside_a < 0 && inside_b < 0) return false;
    if (inside_a < 0) a = b + (a - b) * (inside_b / (inside_b - inside_a));
    if (inside_b < 0) b = a + (b - a) * (inside_a / (inside_a - inside_b));
    return true;
  }

  std::array<float, count> slope_;
  std::array<float, count + 1> top_, bottom_;  // of the body at hand, at the edges of columns
  int first_ = count, last_ = 0;               // edges of columns that it touches
};

}  // namespace veduta
