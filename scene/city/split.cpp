#include "scene/city/split.h"

#include <algorithm>
#include <cmath>

namespace veduta::city {
namespace {

constexpr double rounding = 1e-9;  // of a size: 3 x 0.7 m fit into 2.1 m
// What the sizes in metres must leave for each proportion.
constexpr double least_share_m = 0.02;

bool fits(const std::vector<Length>& lengths, double size) {
  double metres = 0;
  for (const Length& length : lengths) metres += length.is_metres ? length.amount : least_share_m;
  return metres <= size;
}

void append_fixed(const std::vector<Length>& lengths, double begin, double end, std::vector<double>& ends) {
  double metres = 0, shares = 0;
  for (const Length& length : lengths) (length.is_metres ? metres : shares) += length.amount;
  const double share = (end - begin - metres) / shares;
  double at = begin;
  for (const Length& length : lengths) ends.push_back(at += length.amount * (length.is_metres ? 1 : share));
  ends.back() = end;
}

void append_equal(size_t count, double begin, double end, std::vector<double>& ends) {
  for (size_t i = 1; i < count; ++i)
    ends.push_back(begin + (end - begin) * static_cast<double>(i) / static_cast<double>(count));
  ends.push_back(end);
}

// A random number of parts, each of [least, 2 least]: equal parts, moved apart by random amounts that are
// scaled down where a part would leave the range.
uint64_t append_random(double least, double begin, double end, RandomPlace place, uint64_t n,
                       std::vector<double>& ends) {
  const double size = end - begin;
  const auto most = static_cast<uint64_t>(size / least * (1 + rounding));
  const auto fewest = static_cast<uint64_t>(std::ceil(size / (2 * least) * (1 - rounding)));
  const uint64_t count = fewest + place.below(most - fewest + 1, n++);
  const double mean = size / static_cast<double>(count);
  const size_t first = ends.size();
  double sum = 0;
  for (uint64_t i = 0; i < count; ++i) sum += ends.emplace_back(2 * least * place.number(n++));
  double scale = 1;
  for (size_t i = first; i < ends.size(); ++i) {
    ends[i] -= sum / static_cast<double>(count);
    const double room = ends[i] > 0 ? 2 * least - mean : mean - least;
    if (std::abs(ends[i]) > 0) scale = std::min(scale, std::max(0.0, room) / std::abs(ends[i]));
  }
  double at = begin;
  for (size_t i = first; i < ends.size(); ++i) ends[i] = at += mean + scale * ends[i];
  ends.back() = end;
  return n;
}

uint64_t append(const Split& split, const std::vector<Length>& lengths, double least, double begin,
                double end, RandomPlace place, uint64_t n, std::vector<double>& ends) {
  if (split.type == Split::Type::fixed) {
    append_fixed(lengths, begin, end, ends);
  } else if (least == 0) {
    ends.push_back(end);
  } else if (split.type == Split::Type::repeat) {
    append_equal(static_cast<size_t>((end - begin) / least * (1 + rounding)), begin, end, ends);
  } else {
    return append_random(least, begin, end, place, n, ends);
  }
  return n;
}

}  // namespace

bool fits(const Split& split, double width_m, double height_m) {
  if (split.type == Split::Type::fixed) return fits(split.columns, width_m) && fits(split.rows, height_m);
  return width_m * (1 + rounding) >= split.min_width_m && height_m * (1 + rounding) >= split.min_height_m;
}

double most_parts(const Split& split, double width_m, double height_m) {
  if (split.type == Split::Type::fixed)
    return static_cast<double>(std::max(split.columns.size(), split.rows.size()));
  const auto parts = [](double size, double least) { return least == 0 ? 1 : size / least; };
  return std::max(parts(width_m, split.min_width_m), parts(height_m, split.min_height_m));
}

uint64_t append_columns(const Split& split, double begin, double end, RandomPlace place, uint64_t n,
                        std::vector<double>& ends) {
  return append(split, split.columns, split.min_width_m, begin, end, place, n, ends);
}

uint64_t append_rows(const Split& split, double begin, double end, RandomPlace place, uint64_t n,
                     std::vector<double>& ends) {
  return append(split, split.rows, split.min_height_m, begin, end, place, n, ends);
}

}  // namespace veduta::city
