// What rays saw from a cell and its row does not draw.
#pragma once

#include <map>
#include <vector>

#include "verify/cell_check.h"

namespace veduta {

/// Settles hits on undrawn triangles: is it what a viewer would see, and is that a fault?
class MissingFinder {
 public:
  enum class Verdict { cleared, narrow, wrong };

  /// \param drawn [T], 0 or 1: by the row. \param eyes how many eye points there are.
  MissingFinder(const CheckedCity& city, uint32_t cell, const std::vector<uint8_t>& drawn, size_t eyes);

  /// `triangle` is what exact arithmetic finds in place of the hit, when the verdict is `wrong`.
  struct Settled {
    Verdict verdict;
    uint32_t triangle = 0;
  };
  /// A triangle that is a fault stays one: settling each of a million hits on a forgotten house would take
  /// hours. One that was seen through a narrow gap is looked at again at every hit.
  Settled settle(const Ray& ray, const Hit& hit);

  /// Solid angles are estimated from rays all over the sphere: `rays` of them from an eye, and those of them
  /// that settle() said to be missing.
  void looked(size_t eye, uint64_t rays) { uniform_by_eye_[eye] += rays; }
  void count(size_t eye, Verdict verdict);

  CellCheck::Missing wrong() const;
  CellCheck::Missing narrow() const;  ///< without the objects of wrong()

 private:
  struct Tally {
    std::map<uint32_t, FalseInvisible> triangles;  // the hit that was settled
    std::vector<uint64_t> uniform_by_eye;
  };
  CellCheck::Missing sum(const Tally& tally, const Tally* others) const;

  const CheckedCity& city_;
  uint32_t cell_;
  const std::vector<uint8_t>& drawn_;
  std::vector<uint64_t> uniform_by_eye_;
  Tally wrong_, narrow_;  // no triangle is in both
};

}  // namespace veduta
