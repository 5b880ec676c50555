// Where the columns and rows of a split end.
#pragma once

#include <vector>

#include "scene/city/random.h"
#include "scene/city/rules.h"

namespace veduta::city {

/// Whether a rectangle is large enough for the split.
bool fits(const Split& split, double width_m, double height_m);

/// How many columns or rows there can be at most, whichever are more.
double most_parts(const Split& split, double width_m, double height_m);

/// Appends the ends of the columns between `begin` and `end`, in order; the last is `end` itself. `n` is the
/// first random number to draw, and the next one is returned.
/// Example: fixed 2 : 4 : 2 from 0 to 4 gives 1, 3, 4. \pre fits()
uint64_t append_columns(const Split& split, double begin, double end, RandomPlace place, uint64_t n,
                        std::vector<double>& ends);
/// The same for rows.
uint64_t append_rows(const Split& split, double begin, double end, RandomPlace place, uint64_t n,
                     std::vector<double>& ends);

}  // namespace veduta::city
