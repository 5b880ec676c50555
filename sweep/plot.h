// Where everything of a chart stands, before it is drawn.
#pragma once

#include <string>
#include <vector>

#include "sweep/axis.h"
#include "sweep/chart.h"
#include "sweep/labels.h"
#include "sweep/sweep.h"

namespace veduta {

struct PlotPoint {
  size_t number = 0;  ///< in the report
  double x = 0, y = 0;
  bool on_front = false;
  bool standard = false;  ///< without changed keys
  std::string name;       ///< as there is room for; empty: none is wanted
  PlacedLabel label;
};

/// In pixels, y downwards.
struct Plot {
  static constexpr double width = 1080, height = 540;
  static constexpr double left = 64, right = width - 16, top = 92, bottom = height - 54;

  Axis x, y;
  bool has_none = false;  ///< some figures are 0, and stand at none_y below a logarithmic axis
  static constexpr double none_y = bottom - 14;
  std::vector<PlotPoint> points;  ///< those of the front last
  std::vector<Segment> front;     ///< steps from the upper edge to the right one
};

/// The figure of a chart; 0 where there is none, but for false invisible triangles, where it is a figure.
double charted(const SweepPoint& point, Chart chart);

/// Without points where there is nothing to draw: no point has a figure other than 0.
Plot plot_of(const SweepReport& report, Chart chart);

}  // namespace veduta
