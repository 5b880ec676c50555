// What is seen, by integer arithmetic that rounds nothing: the judge of the hard cases.
//
// It shares no code with what it judges: its own reader, its own hierarchy, no Embree, no geometry of the
// product. Coordinates are rounded once, to multiples of a power of two (2^-35 of the scene's extent at most:
// 2^-19 m for a city of 100 km); from then on every decision is exact: determinants of differences in 128
// bits, ratios of them compared in 256.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "tests/hard/exact_model.h"

namespace veduta::hard {

/// What a sight line meets first.
struct Sight {
  /// Whose inside it meets: several where triangles coincide. Ascending.
  std::vector<uint32_t> triangles;
  Point point{};  ///< rounded
};

class ExactReference {
 public:
  /// \param eyes points that the box of the arithmetic has to hold besides the model. Half of its size may be
  /// looked beyond it; further away: std::out_of_range.
  ExactReference(ExactModel model, const std::vector<Point>& eyes);
  ~ExactReference();
  ExactReference(const ExactReference&) = delete;
  ExactReference& operator=(const ExactReference&) = delete;

  const ExactModel& model() const { return model_; }

  /// What the ray from the eye through `at` meets first; nothing where it meets nothing, and where it touches
  /// an edge or runs in the plane of a triangle on its way or at its end: what is called seen is seen beyond
  /// doubt.
  std::optional<Sight> look(const Point& eye, const Point& at) const;
  /// The same by looking at every triangle: slow and obvious.
  std::optional<Sight> look_at_all(const Point& eye, const Point& at) const;

  /// Is every triangle further than `distance_m` from every point of the segment? (In doubles, with a margin
  /// of 10^-9 of the extent, towards no.)
  bool clear(const Point& from, const Point& to, double distance_m) const;

  Point lower() const, upper() const;  ///< of the model

 private:
  struct Exact;
  ExactModel model_;
  std::unique_ptr<Exact> exact_;
};

}  // namespace veduta::hard
