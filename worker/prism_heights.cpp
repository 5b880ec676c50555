#include "worker/prism_heights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace veduta {
namespace {

float best_lower(const SectionHeights& h, const std::vector<uint32_t>& cells, float upper) {
  std::vector<float> lowers;
  for (const uint32_t c : cells) {
    if (h.upper[c] >= upper && h.covered[c] < upper) lowers.push_back(h.lower[c]);
  }
  std::sort(lowers.begin(), lowers.end());
  float best = lowers.front();
  double most = -1;
  for (size_t n = 0; n < lowers.size(); ++n) {
    const double gained = (static_cast<double>(upper) - lowers[n]) * static_cast<double>(n + 1);
    // Where all are open downwards, that is the answer.
    if (std::isinf(lowers[n]) || gained > most) most = gained, best = lowers[n];
  }
  return best;
}

}  // namespace

PrismHeights best_heights(const SectionHeights& h, const std::vector<uint32_t>& cells) {
  constexpr size_t bins = 64;
  struct Bin {
    double count = 0, covered = 0;
    float lowest = std::numeric_limits<float>::infinity();
  };
  std::array<Bin, bins> bin;
  float low = std::numeric_limits<float>::infinity(), high = -low;
  for (const uint32_t c : cells) low = std::min(low, h.upper[c]), high = std::max(high, h.upper[c]);
  const float scale = high > low ? static_cast<float>(bins) / (high - low) : 0.0f;
  for (const uint32_t c : cells) {
    Bin& b = bin[std::min(bins - 1, static_cast<size_t>((h.upper[c] - low) * scale))];
    ++b.count, b.covered += h.covered[c], b.lowest = std::min(b.lowest, h.upper[c]);
  }
  PrismHeights best{-std::numeric_limits<float>::infinity(), high, -1};
  double count = 0, covered = 0;
  for (size_t n = bins; n-- > 0;) {
    if (bin[n].count == 0) continue;
    count += bin[n].count, covered += bin[n].covered;
    const double gained = count * bin[n].lowest - covered;
    if (gained > best.gain) best.gain = gained, best.upper = bin[n].lowest;
  }
  best.lower = best_lower(h, cells, best.upper);
  return best;
}

}  // namespace veduta
