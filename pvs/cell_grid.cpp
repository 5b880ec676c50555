#include "pvs/cell_grid.h"

#include <algorithm>
#include <cmath>
#include <glm/vector_relational.hpp>
#include <utility>

namespace veduta {

namespace {

constexpr int bits_per_axis = 20;
constexpr double bins_limit = 1 << bits_per_axis;

uint64_t key(int64_t x, int64_t y, int64_t z) {
  return (static_cast<uint64_t>(z) << (2 * bits_per_axis)) | (static_cast<uint64_t>(y) << bits_per_axis) |
         static_cast<uint64_t>(x);
}

double median_edge(const std::vector<Box>& cells, int axis) {
  std::vector<float> edges;
  edges.reserve(cells.size());
  for (const Box& cell : cells) edges.push_back(cell.upper[axis] - cell.lower[axis]);
  const auto middle = edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 2);
  std::nth_element(edges.begin(), middle, edges.end());
  return static_cast<double>(*middle);
}

}  // namespace

int64_t CellGrid::bin_along(int axis, float x) const {
  // Never falls as x grows, so a point's bin is among those between the bins of its cell's corners.
  return static_cast<int64_t>((static_cast<double>(x) - static_cast<double>(bounds_.lower[axis])) /
                              edge_m_[static_cast<size_t>(axis)]);
}

CellGrid::CellGrid(const std::vector<Box>& cells) : cell_count_(cells.size()) {
  if (cells.empty()) return;
  for (const Box& cell : cells) bounds_.extend(cell);
  for (int axis = 0; axis < 3; ++axis) {
    const double extent = static_cast<double>(bounds_.upper[axis]) - static_cast<double>(bounds_.lower[axis]);
    edge_m_[static_cast<size_t>(axis)] =
        std::max({median_edge(cells, axis), extent / (bins_limit - 2), 1e-6});
  }
  const auto bins_of = [&](const Box& cell) {
    double count = 1;
    for (int axis = 0; axis < 3; ++axis)
      count *= static_cast<double>(bin_along(axis, cell.upper[axis]) - bin_along(axis, cell.lower[axis]) + 1);
    return count;
  };
  // A few cells that are much larger than the rest would take most of the bins: coarsen until they do not.
  const double budget = 32.0 * static_cast<double>(cells.size()) + 1024;
  double bins = 0;
  for (;; bins = 0) {
    for (const Box& cell : cells) bins += bins_of(cell);
    if (bins <= budget) break;
    for (double& edge : edge_m_) edge *= 2;
  }
  entries_.reserve(static_cast<size_t>(bins));
  for (uint32_t c = 0; c < cells.size(); ++c)
    for (int64_t z = bin_along(2, cells[c].lower.z); z <= bin_along(2, cells[c].upper.z); ++z)
      for (int64_t y = bin_along(1, cells[c].lower.y); y <= bin_along(1, cells[c].upper.y); ++y)
        for (int64_t x = bin_along(0, cells[c].lower.x); x <= bin_along(0, cells[c].upper.x); ++x)
          entries_.push_back({key(x, y, z), c});
  sort_by_bin();
}

// By digits, the lowest first, and stable: cells are in order already. Opening a file of 10^5 cells would
// mostly be this, with a sort by comparisons.
void CellGrid::sort_by_bin() {
  constexpr int digit_bits = 10, digits = 3 * bits_per_axis / digit_bits;
  constexpr uint64_t mask = (1u << digit_bits) - 1;
  uint64_t differ = 0;
  for (const Entry& entry : entries_) differ |= entry.bin ^ entries_.front().bin;
  std::vector<Entry> sorted(entries_.size());
  for (int shift = 0; shift < digit_bits * digits; shift += digit_bits) {
    if (((differ >> shift) & mask) == 0) continue;
    std::array<size_t, mask + 1> place{};
    for (const Entry& entry : entries_) ++place[(entry.bin >> shift) & mask];
    size_t sum = 0;
    for (size_t& n : place) sum += std::exchange(n, sum);
    for (const Entry& entry : entries_) sorted[place[(entry.bin >> shift) & mask]++] = entry;
    entries_.swap(sorted);
  }
}

int64_t CellGrid::find(const std::vector<Box>& cells, const glm::vec3& point) const {
  if (cells.empty() || !bounds_.contains(point)) return -1;
  const uint64_t bin = key(bin_along(0, point.x), bin_along(1, point.y), bin_along(2, point.z));
  auto entry = std::lower_bound(entries_.begin(), entries_.end(), bin,
                                [](const Entry& e, uint64_t wanted) { return e.bin < wanted; });
  for (; entry != entries_.end() && entry->bin == bin; ++entry)
    if (cells[entry->cell].contains(point)) return entry->cell;
  return -1;
}

std::vector<uint32_t> CellGrid::touching(const std::vector<Box>& cells, const Box& box) const {
  std::vector<uint32_t> found;
  const Box inside{glm::max(box.lower, bounds_.lower), glm::min(box.upper, bounds_.upper)};
  if (!glm::all(glm::lessThanEqual(inside.lower, inside.upper))) return found;  // nor for a NaN
  const auto consider = [&](uint32_t c) {
    if (glm::all(glm::lessThanEqual(cells[c].lower, box.upper)) &&
        glm::all(glm::lessThanEqual(box.lower, cells[c].upper)))
      found.push_back(c);
  };
  std::array<int64_t, 3> first{}, last{};
  for (int axis = 0; axis < 3; ++axis) {
    first[static_cast<size_t>(axis)] = bin_along(axis, inside.lower[axis]);
    last[static_cast<size_t>(axis)] = bin_along(axis, inside.upper[axis]);
  }
  // Bins that follow each other along x follow each other among the entries.
  const double runs =
      static_cast<double>(last[1] - first[1] + 1) * static_cast<double>(last[2] - first[2] + 1);
  if (runs > static_cast<double>(cells.size())) {
    for (uint32_t c = 0; c < cells.size(); ++c) consider(c);
    return found;
  }
  for (int64_t z = first[2]; z <= last[2]; ++z)
    for (int64_t y = first[1]; y <= last[1]; ++y) {
      const uint64_t end = key(last[0], y, z);
      auto entry = std::lower_bound(entries_.begin(), entries_.end(), key(first[0], y, z),
                                    [](const Entry& e, uint64_t wanted) { return e.bin < wanted; });
      for (; entry != entries_.end() && entry->bin <= end; ++entry) consider(entry->cell);
    }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace veduta
