// The exposed surface as sections see it: how high one may build at a place, and what stands in the way
// there.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "worker/exposed_surface.h"
#include "worker/plan_polygon.h"

namespace veduta {

/// Points of the plan, at the middles of squares: where heights are sampled.
struct PlanSamples {
  glm::dvec2 lower{0};  ///< corner of the first square, m
  double spacing_m = 1;
  int nx = 0, ny = 0;

  size_t size() const { return static_cast<size_t>(nx) * static_cast<size_t>(ny); }
  glm::dvec2 point(int i, int j) const { return lower + spacing_m * glm::dvec2(i + 0.5, j + 0.5); }
  int first_x(double x) const;  ///< first sample at or beyond x, in [0, nx]
  int first_y(double y) const;
};

/// Heights over the samples of the plan; where `wanted` is 0, the others mean nothing.
struct SectionHeights {
  PlanSamples samples;
  std::vector<uint8_t> wanted;
  std::vector<float> from;  ///< a height at which the sample is in sealed space, -infinity: deep below
  std::vector<float> lower, upper;  ///< between which nothing exposed is within the window's reach sideways
  std::vector<float> covered;       ///< an upper up to here gains nothing
  std::vector<float> foot;          ///< below, the ground is not in the way where walls stand around
  explicit SectionHeights(const PlanSamples& over);
};

/// Calls visit(i0, i1, j) for the runs [i0, i1) of samples in a convex polygon.
template <typename Visit>
void visit_samples(const PlanSamples& samples, std::span<const glm::dvec2> polygon, const Visit& visit);

/// The exposed pieces of a block, in reach of a window.
class SectionPieces {
 public:
  /// \param reach half the window, m; sideways, pieces count as grown by it.
  SectionPieces(const ExposedSurface& surface, const glm::dvec3& reach, double wall_m);

  /// Moves `upper` and `lower` of each sample to where a piece comes within the window's reach sideways,
  /// going up and down from `from`. What is not steep does not count below `foot`. Estimates, that at most
  /// fall short.
  void limit_heights(SectionHeights& heights) const;

  /// What of the pieces lies in z in [lower, upper], of those that are not steep in [foot, upper], as seen
  /// from above, grown by the window, as far as it may meet `area`. \return how many of them are walls, steep
  /// and at least `wall_m` long: these come first.
  size_t obstacles(const PlanBounds& area, double lower, double foot, double upper, PlanPolygons& out) const;

 private:
  struct Piece {
    PlanBounds bounds;  // grown
    double lowest, highest;
    glm::dvec2 slope;  // dz/dx, dz/dy of its plane
    double at_zero;    // height of the plane at x = y = 0
    bool steep, wall;
  };

  void index_pieces();

  const ExposedSurface& surface_;
  glm::dvec2 half_;
  std::vector<Piece> pieces_;
  PlanPolygons grown_;  // whole pieces
  // A grid of buckets over the plan: pieces by the buckets that their bounds meet.
  PlanSamples buckets_;
  std::vector<uint32_t> bucket_begin_, bucket_pieces_;
};

template <typename Visit>
void visit_samples(const PlanSamples& samples, std::span<const glm::dvec2> polygon, const Visit& visit) {
  double y0 = polygon[0].y, y1 = polygon[0].y;
  for (const glm::dvec2& corner : polygon) y0 = std::min(y0, corner.y), y1 = std::max(y1, corner.y);
  for (int j = samples.first_y(y0); j < samples.ny; ++j) {
    const double y = samples.point(0, j).y;
    if (y > y1) return;
    double x0 = 0, x1 = 0;
    bool any = false;
    for (size_t n = 0; n < polygon.size(); ++n) {
      const glm::dvec2 &a = polygon[n], &b = polygon[(n + 1) % polygon.size()];
      if (std::min(a.y, b.y) > y || std::max(a.y, b.y) < y) continue;
      const double x = a.y == b.y ? a.x : a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
      const double other = a.y == b.y ? b.x : x;
      x0 = any ? std::min({x0, x, other}) : std::min(x, other);
      x1 = any ? std::max({x1, x, other}) : std::max(x, other);
      any = true;
    }
    if (!any) continue;
    const int i0 = samples.first_x(x0), i1 = samples.first_x(std::nextafter(x1, 1e300));
    if (i0 < i1) visit(i0, i1, j);
  }
}

}  // namespace veduta
