// Every figure of a sweep, for those who want numbers.
#pragma once

#include <string>

#include "sweep/sweep.h"

namespace veduta {

/// A <table> of the points that have figures, fastest first; those of a Pareto front in bold.
std::string points_table(const SweepReport& report);

/// A <ul> of the points that failed, with the reason; empty when there are none.
std::string failed_points(const SweepReport& report);

}  // namespace veduta
