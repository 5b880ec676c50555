// What a sweep found, in words: for charts, page and table. Foreign text comes out escaped.
#pragma once

#include <string>

#include "sweep/sweep.h"

namespace veduta {

/// Name and all figures of a point, a line each.
std::string point_figures(const SweepPoint& point);

/// "32 cells, 1,000,000 rays a cell, seed 1; llvmpipe; 2 cores of ..."
std::string how_measured(const SweepReport& report);

/// The different renderers of the points, joined by "; ".
std::string renderers_of(const SweepReport& report);

/// "ms of processor time" or "ms by the clock", as the points are judged.
std::string time_unit(const SweepReport& report);

/// "At most 1.5 times: subdivide 4 is the fastest, ...", as HTML.
std::string recommendation(const SweepReport& report, double max_overestimate);

}  // namespace veduta
