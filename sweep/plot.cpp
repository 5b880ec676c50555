#include "sweep/plot.h"

#include <algorithm>

#include "scene/text.h"

namespace veduta {
namespace {

constexpr double name_font_px = 11, name_height_px = 14, bold = 1.14;
constexpr size_t name_bytes = 52;
constexpr double log_from_ratio = 6;  // figures that differ by more are on a logarithmic axis
constexpr double least_ms = 1e-3, least_value = 1e-12, most = 1e12;  // what axes can show
constexpr double none_band_px = 46;  // below a logarithmic axis, for figures of 0

double SweepPoint::*member_of(Chart chart) {
  switch (chart) {
    case Chart::buildings:
      return &SweepPoint::overestimate_buildings;
    case Chart::objects:
      return &SweepPoint::overestimate_objects;
    case Chart::triangles:
      return &SweepPoint::overestimate_triangles;
    case Chart::bytes:
      return &SweepPoint::bytes_per_cell;
    case Chart::false_invisible:
      break;
  }
  return nullptr;
}

bool is_drawn(const SweepPoint& point, Chart chart) {
  return point.failed.empty() && (chart == Chart::false_invisible || charted(point, chart) > 0);
}

double shown(double value) {
  return std::clamp(value, least_value, most);
}

Axis value_axis(const std::vector<double>& values, Chart chart, bool has_none) {
  const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
  if (has_none || chart == Chart::false_invisible || *highest > log_from_ratio * *lowest)
    return log_axis(values, Plot::bottom - (has_none ? none_band_px : 0), Plot::top);
  return linear_axis(values, chart == Chart::bytes ? 0 : 1, Plot::bottom, Plot::top);
}

std::vector<Segment> steps(const std::vector<const PlotPoint*>& front) {
  std::vector<Segment> out;
  double x = 0, y = Plot::top;
  for (const PlotPoint* point : front) {
    if (!out.empty()) out.push_back({x, y, point->x, y});
    out.push_back({point->x, y, point->x, point->y});
    x = point->x, y = point->y;
  }
  if (!out.empty()) out.push_back({x, y, Plot::right, y});
  return out;
}

/// Names that are wanted, in places where none covers another.
void add_labels(Plot& plot) {
  std::vector<LabelWish> wishes;
  for (const PlotPoint& point : plot.points) {
    const bool first = point.on_front || point.standard;
    const double width = text_width(point.name, name_font_px) * (first ? bold : 1);
    wishes.push_back({point.x, point.y, width, point.name.empty() ? 0 : name_height_px, first});
  }
  const Rectangle room{Plot::left + 2, Plot::top, Plot::right - Plot::left - 2, Plot::bottom - Plot::top - 2};
  const std::vector<PlacedLabel> labels = place_labels(wishes, room, plot.front);
  for (size_t i = 0; i < labels.size(); ++i) plot.points[i].label = labels[i];
}

}  // namespace

double charted(const SweepPoint& point, Chart chart) {
  return chart == Chart::false_invisible ? static_cast<double>(point.false_invisible_triangles)
                                         : point.*member_of(chart);
}

Plot plot_of(const SweepReport& report, Chart chart) {
  Plot plot;
  std::vector<double> times, values;
  for (size_t i = 0; i < report.points.size(); ++i) {
    const SweepPoint& point = report.points[i];
    if (!is_drawn(point, chart)) continue;
    // Where most have none, what is worth a name is the others.
    const bool named = point.changed.empty() || chart != Chart::false_invisible || charted(point, chart) > 0;
    plot.points.push_back(
        {i, 0, 0, false, point.changed.empty(), named ? printable(point_name(point), name_bytes) : "", {}});
    times.push_back(std::clamp(judged_ms(point), least_ms, most));
    if (charted(point, chart) > 0) values.push_back(shown(charted(point, chart)));
  }
  if (values.empty()) return {};

  plot.has_none = values.size() < plot.points.size();
  plot.x = log_axis(times, Plot::left, Plot::right);
  plot.y = value_axis(values, chart, plot.has_none);
  std::vector<size_t> front;
  if (chart != Chart::false_invisible) front = pareto_front(report, member_of(chart));
  for (size_t k = 0; k < plot.points.size(); ++k) {
    PlotPoint& point = plot.points[k];
    const double value = charted(report.points[point.number], chart);
    point.x = plot.x.at(times[k]), point.y = value > 0 ? plot.y.at(shown(value)) : Plot::none_y;
    point.on_front = std::find(front.begin(), front.end(), point.number) != front.end();
  }
  std::stable_sort(plot.points.begin(), plot.points.end(),
                   [](const PlotPoint& a, const PlotPoint& b) { return a.on_front < b.on_front; });
  std::vector<const PlotPoint*> fastest_first;
  for (const size_t i : front)
    fastest_first.push_back(&*std::find_if(plot.points.begin(), plot.points.end(),
                                           [&](const PlotPoint& p) { return p.number == i; }));
  plot.front = steps(fastest_first);
  add_labels(plot);
  return plot;
}

}  // namespace veduta
