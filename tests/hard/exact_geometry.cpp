#include "tests/hard/exact_geometry.h"

#include <utility>

namespace veduta::hard {
namespace {

__extension__ using Unsigned = unsigned __int128;

Whole minus(const Whole& a, const Whole& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Wide determinant(const Whole& a, const Whole& b, const Whole& c) {
  const auto minor = [](int64_t p, int64_t q, int64_t r, int64_t s) { return Wide{p} * s - Wide{q} * r; };
  return a[0] * minor(b[1], b[2], c[1], c[2]) - a[1] * minor(b[0], b[2], c[0], c[2]) +
         a[2] * minor(b[0], b[1], c[0], c[1]);
}

/// A product of two numbers of 128 bits: high and low half.
std::pair<Unsigned, Unsigned> product(Unsigned a, Unsigned b) {
  constexpr Unsigned low = ~uint64_t{0};
  const Unsigned a0 = a & low, a1 = a >> 64, b0 = b & low, b1 = b >> 64;
  const Unsigned p00 = a0 * b0, p01 = a0 * b1, p10 = a1 * b0;
  const Unsigned middle = (p00 >> 64) + (p01 & low) + (p10 & low);
  return {a1 * b1 + (p01 >> 64) + (p10 >> 64) + (middle >> 64), (middle << 64) | (p00 & low)};
}

/// -1, 0, 1.
int compare(const Along& a, const Along& b) {
  const bool a_negative = a.numerator < 0, b_negative = b.numerator < 0;
  if (a_negative != b_negative) return a_negative ? -1 : 1;
  const auto magnitude = [](Wide n) { return n < 0 ? -static_cast<Unsigned>(n) : static_cast<Unsigned>(n); };
  const auto left = product(magnitude(a.numerator), static_cast<Unsigned>(b.denominator));
  const auto right = product(magnitude(b.numerator), static_cast<Unsigned>(a.denominator));
  if (left == right) return 0;
  return (left < right) != a_negative ? -1 : 1;
}

}  // namespace

double Along::rounded() const {
  return static_cast<double>(numerator) / static_cast<double>(denominator);
}

bool operator<(const Along& a, const Along& b) {
  return compare(a, b) < 0;
}

bool operator==(const Along& a, const Along& b) {
  return compare(a, b) == 0;
}

Crossing cross(const Whole& eye, const Whole& at, const std::array<Whole, 3>& triangle) {
  const Whole d = minus(at, eye);
  const Whole a = minus(triangle[0], eye), b = minus(triangle[1], eye), c = minus(triangle[2], eye);
  // On which side of each edge the line passes; their sum is the direction times the triangle's normal.
  const Wide u = determinant(d, a, b), v = determinant(d, b, c), w = determinant(d, c, a);
  if ((u > 0 || v > 0 || w > 0) && (u < 0 || v < 0 || w < 0)) return {};
  if (u == 0 && v == 0 && w == 0) return {Meeting::edge, {}, true};
  Along along{determinant(a, b, c), u + v + w};
  if (along.denominator < 0) along = {-along.numerator, -along.denominator};
  return {u != 0 && v != 0 && w != 0 ? Meeting::inside : Meeting::edge, along, false};
}

}  // namespace veduta::hard
