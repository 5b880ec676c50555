// Exact decisions on integer points, for the exact reference.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

namespace veduta::hard {

__extension__ using Wide = __int128;

/// Below 2^36 in magnitude, so that their differences are below 2^37, determinants below 2^114 and sums of
/// three of those below 2^116.
using Whole = std::array<int64_t, 3>;

/// A number of the ray's length, `numerator / denominator` with denominator > 0: 0 at the eye, 1 at what it
/// is aimed at.
struct Along {
  Wide numerator = 0, denominator = 1;
  double rounded() const;
};

/// Exact.
bool operator<(const Along& a, const Along& b);
bool operator==(const Along& a, const Along& b);

enum class Meeting {
  none,
  inside,  ///< the line meets the triangle's inside
  edge     ///< it meets its boundary, or runs in its plane or through one without area
};

struct Crossing {
  Meeting meeting = Meeting::none;
  Along along;  ///< of `inside` and of `edge` where the line is not in the plane
  bool in_plane = false;
};

/// How the line from an eye through `at` meets a triangle.
Crossing cross(const Whole& eye, const Whole& at, const std::array<Whole, 3>& triangle);

}  // namespace veduta::hard
