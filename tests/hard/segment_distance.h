// How far a segment is from a triangle, in doubles.
#pragma once

#include "tests/hard/exact_model.h"

namespace veduta::hard {

/// m; 0 where the segment passes through the triangle.
double segment_distance(const Point& from, const Point& to, const std::array<Point, 3>& triangle);

/// m.
double point_distance(const Point& p, const std::array<Point, 3>& triangle);

}  // namespace veduta::hard
