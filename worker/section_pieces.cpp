#include "worker/section_pieces.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

namespace veduta {
namespace {

int first_sample(double offset_m, double spacing_m, int count) {
  return static_cast<int>(std::clamp(std::ceil(offset_m / spacing_m - 0.5), 0.0, static_cast<double>(count)));
}

/// The corners of a planar convex polygon between two heights, seen from above.
void corners_between(std::span<const glm::dvec3> polygon, double lower, double upper,
                     std::vector<glm::dvec2>& out) {
  out.clear();
  for (size_t n = 0; n < polygon.size(); ++n) {
    const glm::dvec3 &a = polygon[n], &b = polygon[(n + 1) % polygon.size()];
    if (a.z >= lower && a.z <= upper) out.emplace_back(a);
    for (const double z : {lower, upper}) {
      if ((a.z < z && b.z > z) || (a.z > z && b.z < z))
        out.emplace_back(a + (z - a.z) / (b.z - a.z) * (b - a));
    }
  }
}

/// The lowest foot of wanted samples in squares of the plan: most ground lies below all near it.
class LowestFoot {
 public:
  LowestFoot(const PlanSamples& samples, const std::vector<uint8_t>& wanted, const std::vector<float>& foot)
      : samples_(samples),
        nx_(samples.nx / edge + 1),
        lowest_(static_cast<size_t>(nx_) * static_cast<size_t>(samples.ny / edge + 1),
                std::numeric_limits<float>::infinity()) {
    for (int j = 0; j < samples.ny; ++j) {
      for (int i = 0; i < samples.nx; ++i) {
        const size_t s = static_cast<size_t>(j) * static_cast<size_t>(samples.nx) + static_cast<size_t>(i);
        float& lowest = lowest_[at(i / edge, j / edge)];
        if (wanted[s] != 0) lowest = std::min(lowest, foot[s]);
      }
    }
  }

  /// Infinity where there is no wanted sample.
  float near(const PlanBounds& bounds) const {
    float lowest = std::numeric_limits<float>::infinity();
    const int i1 = (samples_.first_x(bounds.upper.x) - 1) / edge,
              j1 = (samples_.first_y(bounds.upper.y) - 1) / edge;
    for (int j = samples_.first_y(bounds.lower.y) / edge; j <= j1; ++j) {
      for (int i = samples_.first_x(bounds.lower.x) / edge; i <= i1; ++i)
        lowest = std::min(lowest, lowest_[at(i, j)]);
    }
    return lowest;
  }

 private:
  static constexpr int edge = 16;  // samples
  size_t at(int i, int j) const {
    return static_cast<size_t>(j) * static_cast<size_t>(nx_) + static_cast<size_t>(i);
  }
  const PlanSamples& samples_;
  int nx_;
  std::vector<float> lowest_;
};

}  // namespace

int PlanSamples::first_x(double x) const {
  return first_sample(x - lower.x, spacing_m, nx);
}
int PlanSamples::first_y(double y) const {
  return first_sample(y - lower.y, spacing_m, ny);
}

SectionHeights::SectionHeights(const PlanSamples& over)
    : samples(over),
      wanted(over.size(), 0),
      from(over.size(), -std::numeric_limits<float>::infinity()),
      lower(from),
      upper(from),
      covered(from),
      foot(from) {}

SectionPieces::SectionPieces(const ExposedSurface& surface, const glm::dvec3& reach, double wall_m)
    : surface_(surface), half_(reach) {
  std::vector<glm::dvec2> corners;
  for (size_t p = 0; p < surface.size(); ++p) {
    const std::span<const glm::dvec3> piece(surface.corners.data() + surface.begin[p],
                                            surface.corners.data() + surface.begin[p + 1]);
    Piece made{{glm::dvec2(piece[0]), glm::dvec2(piece[0])}, piece[0].z, piece[0].z, {0, 0}, 0, true, false};
    corners.clear();
    for (const glm::dvec3& corner : piece) {
      corners.emplace_back(corner);
      made.bounds.lower = glm::min(made.bounds.lower, glm::dvec2(corner));
      made.bounds.upper = glm::max(made.bounds.upper, glm::dvec2(corner));
      made.lowest = std::min(made.lowest, corner.z), made.highest = std::max(made.highest, corner.z);
    }
    const glm::dvec2 extent = made.bounds.upper - made.bounds.lower;
    made.bounds.lower -= half_, made.bounds.upper += half_;
    const glm::dvec3& normal = surface.normal[p];
    made.steep = !(std::abs(normal.z) >= 0.05);
    made.wall = made.steep && std::max(extent.x, extent.y) >= wall_m;
    if (!made.steep) {
      made.slope = -glm::dvec2(normal) / normal.z;
      made.at_zero = piece[0].z - made.slope.x * piece[0].x - made.slope.y * piece[0].y;
    }
    pieces_.push_back(made);
    add_grown(grown_, convex_hull(corners), half_);
  }
  index_pieces();
}

void SectionPieces::index_pieces() {
  if (pieces_.empty()) return;
  PlanBounds all = pieces_[0].bounds;
  for (const Piece& piece : pieces_) {
    all.lower = glm::min(all.lower, piece.bounds.lower), all.upper = glm::max(all.upper, piece.bounds.upper);
  }
  const glm::dvec2 extent = all.upper - all.lower;
  buckets_.lower = all.lower;
  // About as many buckets as pieces, and none smaller than the window.
  buckets_.spacing_m =
      std::max({half_.x, half_.y, std::sqrt(extent.x * extent.y / static_cast<double>(pieces_.size()))});
  buckets_.nx = static_cast<int>(extent.x / buckets_.spacing_m) + 1;
  buckets_.ny = static_cast<int>(extent.y / buckets_.spacing_m) + 1;
  const auto each_bucket = [&](const Piece& piece, const auto& visit) {
    const glm::ivec2 a((piece.bounds.lower - all.lower) / buckets_.spacing_m);
    const glm::ivec2 b((piece.bounds.upper - all.lower) / buckets_.spacing_m);
    for (int j = a.y; j <= b.y; ++j) {
      for (int i = a.x; i <= b.x; ++i)
        visit(static_cast<size_t>(j) * static_cast<size_t>(buckets_.nx) + static_cast<size_t>(i));
    }
  };
  bucket_begin_.assign(buckets_.size() + 1, 0);
  for (const Piece& piece : pieces_) each_bucket(piece, [&](size_t b) { ++bucket_begin_[b + 1]; });
  for (size_t b = 0; b < buckets_.size(); ++b) bucket_begin_[b + 1] += bucket_begin_[b];
  bucket_pieces_.resize(bucket_begin_.back());
  std::vector<uint32_t> next(bucket_begin_.begin(), bucket_begin_.end() - 1);
  for (uint32_t p = 0; p < pieces_.size(); ++p)
    each_bucket(pieces_[p], [&](size_t b) { bucket_pieces_[next[b]++] = p; });
}

void SectionPieces::limit_heights(SectionHeights& h) const {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const PlanSamples& samples = h.samples;
  const LowestFoot lowest_foot(samples, h.wanted, h.foot);
  for (size_t p = 0; p < pieces_.size(); ++p) {
    const Piece& piece = pieces_[p];
    const float lowest_near = lowest_foot.near(piece.bounds);
    if (piece.steep ? lowest_near == infinity : piece.highest < lowest_near) continue;
    const auto piece_lowest = static_cast<float>(piece.lowest),
               piece_highest = static_cast<float>(piece.highest);
    // Rounding in heights that differ by a building's is far below a seed, and only an estimate is off by it.
    const auto slack =
        static_cast<float>(std::abs(piece.slope.x) * half_.x + std::abs(piece.slope.y) * half_.y);
    const auto limit = [&](size_t s, float lowest, float highest) {
      const float from = h.from[s];
      h.upper[s] = std::min(h.upper[s], highest >= from ? std::max(lowest, from) : infinity);
      h.lower[s] = std::max(h.lower[s], lowest <= from ? std::min(highest, from) : -infinity);
    };
    visit_samples(samples, grown_.at(p), [&](int i0, int i1, int j) {
      const size_t row = static_cast<size_t>(j) * static_cast<size_t>(samples.nx);
      const size_t first = row + static_cast<size_t>(i0), end = row + static_cast<size_t>(i1);
      if (piece.steep) {
        for (size_t s = first; s < end; ++s) limit(s, piece_lowest, piece_highest);
        return;
      }
      const glm::dvec2 at = samples.point(i0, j);
      auto z = static_cast<float>(piece.at_zero + piece.slope.x * at.x + piece.slope.y * at.y);
      const auto rise = static_cast<float>(piece.slope.x * samples.spacing_m);
      for (size_t s = first; s < end; ++s, z += rise) {
        const float highest = std::min(piece_highest, z + slack);
        if (highest >= h.foot[s]) limit(s, std::max({piece_lowest, z - slack, h.foot[s]}), highest);
      }
    });
  }
}

size_t SectionPieces::obstacles(const PlanBounds& area, double lower, double foot, double upper,
                                PlanPolygons& out) const {
  out.clear();
  if (pieces_.empty()) return 0;
  const auto bucket = [&](double offset, int count) {
    return static_cast<int>(std::clamp(std::floor(offset / buckets_.spacing_m), 0.0, count - 1.0));
  };
  const int i0 = bucket(area.lower.x - buckets_.lower.x, buckets_.nx),
            i1 = bucket(area.upper.x - buckets_.lower.x, buckets_.nx);
  const int j0 = bucket(area.lower.y - buckets_.lower.y, buckets_.ny),
            j1 = bucket(area.upper.y - buckets_.lower.y, buckets_.ny);
  std::vector<uint32_t> found;
  for (int j = j0; j <= j1; ++j) {
    for (int i = i0; i <= i1; ++i) {
      const size_t b = static_cast<size_t>(j) * static_cast<size_t>(buckets_.nx) + static_cast<size_t>(i);
      for (uint32_t n = bucket_begin_[b]; n < bucket_begin_[b + 1]; ++n) {
        const Piece& piece = pieces_[bucket_pieces_[n]];
        if (piece.lowest <= upper && piece.highest >= (piece.steep ? lower : std::max(lower, foot)) &&
            piece.bounds.meets(area))
          found.push_back(bucket_pieces_[n]);
      }
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  const auto others =
      std::stable_partition(found.begin(), found.end(), [&](uint32_t p) { return pieces_[p].wall; });
  std::vector<glm::dvec2> corners;
  for (const uint32_t p : found) {
    const Piece& piece = pieces_[p];
    const double from = piece.steep ? lower : std::max(lower, foot);
    if (piece.lowest >= from && piece.highest <= upper) {
      out.add(grown_.at(p));
      continue;
    }
    corners_between(
        {surface_.corners.data() + surface_.begin[p], surface_.corners.data() + surface_.begin[p + 1]}, from,
        upper, corners);
    add_grown(out, convex_hull(corners), half_);
  }
  return static_cast<size_t>(others - found.begin());
}

}  // namespace veduta
