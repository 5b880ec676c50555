// A bin's cells are found by its number where bins are about as many as cells, else by a hash of it: then
// bins may share a slot, which costs time and nothing else, since every cell that is found is asked whether
// it holds the point.
//
// No look-up depends on rounding. place() may round, but never falls as x grows. A cell from a to b is in the
// bins from floor(place(a)) to ceil(place(b)) - 1 (and in the first of these at least); a point p is looked
// for in those from ceil(place(p)) - 1 to floor(place(p)), which is one, or two where it lies on a face of
// bins. With a <= p <= b, and so place(a) <= place(p) <= place(b), the two have a bin in common. Cells of a
// lattice have their faces on those of bins: each is in one bin, and not in those of its neighbours as well.
#include "pvs/cell_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/vector_relational.hpp>
#include <map>

namespace veduta {

namespace {

constexpr double bins_limit = 0x1p40;  // along an axis, so that numbers of bins and their sums are exact

/// Cells whose extents differ by less than a factor of 2^step are of one class, or of neighbouring ones. The
/// classes part where sizes are unusual, so that rounding does not part what was meant to be equal.
std::array<int, 3> size_class(const Box& cell, int step) {
  std::array<int, 3> out{};
  for (int axis = 0; axis < 3; ++axis) {
    const double extent = static_cast<double>(cell.upper[axis]) - static_cast<double>(cell.lower[axis]);
    const int exponent = extent > 0 ? std::ilogb(1.3 * extent) : -200;
    out[static_cast<size_t>(axis)] = (exponent + 1024) / step;
  }
  return out;
}

/// Cells by size, ascending within each.
std::vector<std::vector<uint32_t>> by_size(const std::vector<Box>& cells) {
  for (int step = 1;; step *= 2) {
    std::map<std::array<int, 3>, size_t> numbers;
    std::vector<std::vector<uint32_t>> members;
    std::array<int, 3> last{-1, -1, -1};
    size_t number = 0;
    for (uint32_t c = 0; c < cells.size() && members.size() <= CellGrid::levels_limit; ++c) {
      const auto wanted = size_class(cells[c], step);
      if (wanted != last) {
        number = numbers.try_emplace(wanted, members.size()).first->second;
        if (number == members.size()) members.emplace_back();
        last = wanted;
      }
      members[number].push_back(c);
    }
    if (members.size() <= CellGrid::levels_limit) return members;
  }
}

template <typename Visit>
void for_each_bin(const std::array<int64_t, 3>& first, const std::array<int64_t, 3>& last, Visit visit) {
  for (int64_t z = first[2]; z <= last[2]; ++z)
    for (int64_t y = first[1]; y <= last[1]; ++y)
      for (int64_t x = first[0]; x <= last[0]; ++x) visit(std::array<int64_t, 3>{x, y, z});
}

}  // namespace

double CellGrid::Bins::count() const {
  double out = 1;
  for (size_t axis = 0; axis < 3; ++axis) out *= static_cast<double>(last[axis] - first[axis] + 1);
  return out;
}

double CellGrid::Level::place(int axis, float x) const {
  return (static_cast<double>(x) - origin_[static_cast<size_t>(axis)]) / edge_m_[static_cast<size_t>(axis)];
}

CellGrid::Bins CellGrid::Level::bins_of_cell(const Box& cell) const {
  Bins out;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<size_t>(axis);
    out.first[a] = static_cast<int64_t>(std::floor(place(axis, cell.lower[axis])));
    out.last[a] = std::max(out.first[a], static_cast<int64_t>(std::ceil(place(axis, cell.upper[axis]))) - 1);
  }
  return out;
}

CellGrid::Bins CellGrid::Level::bins_of_box(const Box& box) const {
  Bins out;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<size_t>(axis);
    out.first[a] =
        std::max(bins_.first[a], static_cast<int64_t>(std::ceil(place(axis, box.lower[axis]))) - 1);
    out.last[a] = std::min(bins_.last[a], static_cast<int64_t>(std::floor(place(axis, box.upper[axis]))));
  }
  return out;
}

size_t CellGrid::Level::slot(const Bin& bin) const {
  const auto along = [&](size_t axis) { return static_cast<uint64_t>(bin[axis] - bins_.first[axis]); };
  if (hash_shift_ == 0) {
    const auto width = [&](size_t axis) {
      return static_cast<uint64_t>(bins_.last[axis] - bins_.first[axis] + 1);
    };
    return (along(2) * width(1) + along(1)) * width(0) + along(0);
  }
  const uint64_t mixed =
      along(0) * 0x9e3779b97f4a7c15 + along(1) * 0xc2b2ae3d27d4eb4f + along(2) * 0x165667b19e3779f9;
  return ((mixed ^ (mixed >> 32)) * 0xd6e8feb86659fd93) >> hash_shift_;
}

void CellGrid::Level::make_slots(uint64_t entries, size_t members) {
  if (const double bins = bins_.count(); bins <= 2.0 * static_cast<double>(members) + 64) {
    begin_.resize(static_cast<size_t>(bins) + 1);
  } else {
    const uint64_t slots = std::bit_ceil(std::max<uint64_t>(2, entries));
    hash_shift_ = 64 - static_cast<unsigned>(std::countr_zero(slots));
    begin_.resize(slots + 1);
  }
  entries_.resize(entries);
}

CellGrid::Level::Level(const std::vector<Box>& cells, const std::vector<uint32_t>& members) {
  std::array<double, 3> largest{};
  for (const uint32_t c : members) {
    bounds_.extend(cells[c]);
    for (int axis = 0; axis < 3; ++axis) {
      double& most = largest[static_cast<size_t>(axis)];
      most = std::max(most,
                      static_cast<double>(cells[c].upper[axis]) - static_cast<double>(cells[c].lower[axis]));
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<size_t>(axis);
    const double extent = static_cast<double>(bounds_.upper[axis]) - static_cast<double>(bounds_.lower[axis]);
    origin_[a] = static_cast<double>(cells[members.front()].lower[axis]);
    edge_m_[a] = std::max(largest[a], extent / bins_limit);
    if (edge_m_[a] == 0) edge_m_[a] = 1;  // all are flat, and lie in one plane
  }
  bins_ = bins_of_cell(bounds_);

  uint64_t entries = 0;
  for (const uint32_t c : members) entries += static_cast<uint64_t>(bins_of_cell(cells[c]).count());
  make_slots(entries, members.size());
  const auto for_each_slot = [&](uint32_t c, auto visit) {
    const Bins bins = bins_of_cell(cells[c]);
    for_each_bin(bins.first, bins.last, [&](const Bin& bin) { visit(slot(bin)); });
  };
  // Counted, summed up to where each slot ends, and filled from there down: the last cell first.
  for (const uint32_t c : members) for_each_slot(c, [&](size_t s) { ++begin_[s]; });
  uint64_t sum = 0;
  for (uint64_t& count : begin_) count = sum += count;
  for (auto c = members.rbegin(); c != members.rend(); ++c)
    for_each_slot(*c, [&](size_t s) { entries_[--begin_[s]] = *c; });
}

int64_t CellGrid::Level::find(const std::vector<Box>& cells, const glm::vec3& point) const {
  int64_t found = -1;
  if (!bounds_.contains(point)) return found;
  const Bins bins = bins_of_box({point, point});
  for_each_bin(bins.first, bins.last, [&](const Bin& bin) {
    const size_t s = slot(bin);
    for (uint64_t i = begin_[s]; i < begin_[s + 1]; ++i) {
      const uint32_t c = entries_[i];
      if (found >= 0 && c >= found) break;
      if (cells[c].contains(point)) found = c;
    }
  });
  return found;
}

void CellGrid::Level::add_touching(const std::vector<Box>& cells, const Box& box,
                                   std::vector<uint32_t>& found) const {
  const Box inside{glm::max(box.lower, bounds_.lower), glm::min(box.upper, bounds_.upper)};
  if (!glm::all(glm::lessThanEqual(inside.lower, inside.upper))) return;  // nor for a NaN
  const auto consider = [&](uint32_t c) {
    if (glm::all(glm::lessThanEqual(cells[c].lower, box.upper)) &&
        glm::all(glm::lessThanEqual(box.lower, cells[c].upper)))
      found.push_back(c);
  };
  const Bins bins = bins_of_box(inside);
  if (bins.count() > static_cast<double>(entries_.size())) {
    for (const uint32_t c : entries_) consider(c);
    return;
  }
  for_each_bin(bins.first, bins.last, [&](const Bin& bin) {
    const size_t s = slot(bin);
    for (uint64_t i = begin_[s]; i < begin_[s + 1]; ++i) consider(entries_[i]);
  });
}

uint64_t CellGrid::Level::bytes() const {
  return sizeof(Level) + begin_.capacity() * sizeof(uint64_t) + entries_.capacity() * sizeof(uint32_t);
}

uint64_t CellGrid::Level::longest_slot() const {
  uint64_t longest = 0;
  for (size_t s = 0; s + 1 < begin_.size(); ++s) longest = std::max(longest, begin_[s + 1] - begin_[s]);
  return longest;
}

CellGrid::CellGrid(const std::vector<Box>& cells) : cell_count_(cells.size()) {
  for (const std::vector<uint32_t>& members : by_size(cells)) levels_.emplace_back(cells, members);
}

int64_t CellGrid::find(const std::vector<Box>& cells, const glm::vec3& point) const {
  int64_t found = -1;
  for (const Level& level : levels_)
    if (const int64_t c = level.find(cells, point); c >= 0 && (found < 0 || c < found)) found = c;
  return found;
}

std::vector<uint32_t> CellGrid::touching(const std::vector<Box>& cells, const Box& box) const {
  std::vector<uint32_t> found;
  for (const Level& level : levels_) level.add_touching(cells, box, found);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

uint64_t CellGrid::bytes() const {
  uint64_t out = 0;
  for (const Level& level : levels_) out += level.bytes();
  return out;
}

uint64_t CellGrid::most_looked_at() const {
  uint64_t out = 0;
  for (const Level& level : levels_) out += level.longest_slot();
  return out;
}

}  // namespace veduta
