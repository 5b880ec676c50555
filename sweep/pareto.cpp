// Which points are worth having.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "scene/text.h"
#include "sweep/sweep.h"

namespace veduta {
namespace {

/// Times of the same work differ by so much from run to run, and over-estimates of nearly the same rows by
/// what rays happen to meet.
constexpr double time_noise = 0.05, overestimate_noise = 0.01;

/// An over-estimate of 0 says that nothing was seen: no figure.
bool can_be_chosen(const SweepPoint& point, double overestimate) {
  return point.failed.empty() && point.false_invisible_objects == 0 && point.false_invisible_triangles == 0 &&
         overestimate > 0;
}

/// A key without its table, where that still says what it is.
std::string short_key(const std::string& key) {
  if (key == "slices.max") return "slices";
  if (key == "cells.size") return "cell size";
  if (key == "cells.height") return "cell height";
  if (key == "shrink.method") return "shrink";
  return key.substr(key.rfind('.') + 1);
}

/// Without quotes, and 20.0 as 20.
std::string short_value(const std::string& toml) {
  const bool quoted = toml.size() >= 2 && toml.front() == '"' && toml.back() == '"';
  if (quoted) return toml.substr(1, toml.size() - 2);
  return toml.ends_with(".0") ? toml.substr(0, toml.size() - 2) : toml;
}

}  // namespace

bool judged_by_processor(const SweepPoint& point) {
  // As EglContext::software() in gl/ knows them.
  constexpr std::array names{"llvmpipe", "softpipe", "swrast", "SWR", "Software Rasterizer"};
  return std::any_of(names.begin(), names.end(),
                     [&](const char* name) { return point.renderer.find(name) != std::string::npos; });
}

double judged_ms(const SweepPoint& point) {
  const double ms = judged_by_processor(point) ? point.cell_core_ms : point.cell_ms;
  if (point.cells_of_first == 0) return ms;
  return ms * static_cast<double>(point.cells_in_all) / static_cast<double>(point.cells_of_first);
}

std::string point_name(const SweepPoint& point) {
  std::string name;
  for (const auto& [key, value] : point.changed)
    name += fmt::format("{}{} {}", name.empty() ? "" : ", ", short_key(key), short_value(value));
  return name.empty() ? "default" : printable(name);
}

std::vector<size_t> pareto_front(const SweepReport& report, double SweepPoint::*overestimate) {
  const std::vector<SweepPoint>& points = report.points;
  std::vector<size_t> order;
  for (size_t i = 0; i < points.size(); ++i)
    if (can_be_chosen(points[i], points[i].*overestimate)) order.push_back(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return judged_ms(points[a]) < judged_ms(points[b]); });
  const auto beats = [&](const SweepPoint& other, const SweepPoint& point) {
    const double ms = judged_ms(point), bound = point.*overestimate;
    return (other.*overestimate < (1 - overestimate_noise) * bound && judged_ms(other) <= ms) ||
           (other.*overestimate <= bound && judged_ms(other) < (1 - time_noise) * ms);
  };
  std::vector<size_t> front;
  for (const size_t i : order)
    if (std::none_of(order.begin(), order.end(), [&](size_t j) { return beats(points[j], points[i]); }))
      front.push_back(i);
  return front;
}

int recommend(const SweepReport& report, double max_overestimate) {
  int best = -1;
  double best_ms = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < report.points.size(); ++i) {
    const SweepPoint& point = report.points[i];
    if (!can_be_chosen(point, point.overestimate_buildings) ||
        point.overestimate_buildings > max_overestimate || judged_ms(point) >= best_ms)
      continue;
    best = static_cast<int>(i), best_ms = judged_ms(point);
  }
  return best;
}

}  // namespace veduta
