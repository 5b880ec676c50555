#include "sweep/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <vector>

#include "scene/markup.h"
#include "sweep/figures.h"
#include "sweep/series.h"

namespace veduta {
namespace {

constexpr const char* head = R"(<thead>
<tr><th rowspan="2" class="left">point</th><th colspan="2">time per cell, ms</th><th rowspan="2">bytes<br>a cell</th>
<th colspan="6">over-estimate, listed / seen</th><th colspan="4">false invisible</th><th rowspan="2">narrow<br>gaps,<br>objects</th>
<th rowspan="2">prepared<br>in s</th><th rowspan="2">cells</th><th rowspan="2">million<br>rays<br>a cell</th></tr>
<tr><th>of pro&shy;cessors</th><th>by the clock</th>
<th>build&shy;ings</th><th>ob&shy;jects</th><th>median cell</th><th>worst cell</th><th>tri&shy;angles</th><th>of that, format</th>
<th>ob&shy;jects</th><th>tri&shy;angles</th><th>solid angle, mean</th><th>worst eye</th></tr>
</thead>
)";

std::string cell(const std::string& content, const std::string& kind = "") {
  return kind.empty() ? "<td>" + content + "</td>" : fmt::format("<td class=\"{}\">{}</td>", kind, content);
}

std::string times(double ratio) {
  return ratio > 0 ? figure(ratio) + "×" : "–";
}

struct Fronts {
  std::set<size_t> buildings, objects, triangles;
  explicit Fronts(const SweepReport& report)
      : buildings(of(report, &SweepPoint::overestimate_buildings)),
        objects(of(report, &SweepPoint::overestimate_objects)),
        triangles(of(report, &SweepPoint::overestimate_triangles)) {}
  static std::set<size_t> of(const SweepReport& report, double SweepPoint::*figure) {
    const std::vector<size_t> front = pareto_front(report, figure);
    return {front.begin(), front.end()};
  }
};

std::string row(const SweepPoint& p, size_t number, const Fronts& fronts, size_t method, bool with_renderer) {
  const auto front = [&](const std::set<size_t>& on) { return on.count(number) > 0; };
  const auto best = [&](const std::set<size_t>& on) { return front(on) ? "best" : ""; };
  const bool any = front(fronts.buildings) || front(fronts.objects) || front(fronts.triangles);
  const std::string wrong = p.false_invisible_triangles > 0 ? "wrong" : "";
  std::string name =
      fmt::format(R"(<svg viewBox="0 0 16 16" width="14" height="14">{}</svg> {})",
                  mark(method, 8, 8, wrong.empty() ? "mark" : "mark hollow"), escaped(point_name(p)));
  if (with_renderer) name += fmt::format("<br><small>{}</small>", escaped(p.renderer));
  const bool by_processor = judged_by_processor(p);
  std::string out = fmt::format(R"(<tr><th class="left{}">{}</th>)", any ? " best" : "", name);
  out += cell(figure(p.cell_core_ms), by_processor ? "judged" : "aside");
  out += cell(figure(p.cell_ms), by_processor ? "aside" : "judged");
  out += cell(figure(p.bytes_per_cell));
  out += cell(times(p.overestimate_buildings), best(fronts.buildings));
  out += cell(times(p.overestimate_objects), best(fronts.objects));
  out += cell(times(p.overestimate_objects_median), "aside") +
         cell(times(p.overestimate_objects_worst), "aside");
  out += cell(times(p.overestimate_triangles), best(fronts.triangles)) +
         cell(times(p.tightest_triangles), "aside");
  out += cell(count(p.false_invisible_objects), wrong) + cell(count(p.false_invisible_triangles), wrong);
  out += cell(figure(p.false_invisible_solid_angle_mean), wrong) +
         cell(figure(p.false_invisible_solid_angle_worst), wrong);
  out += cell(count(p.narrow_gap_objects)) + cell(figure(p.prepare_s));
  out += cell(fmt::format("{} of {}", count(p.cells), count(p.cells_in_all))) +
         cell(figure(static_cast<double>(p.rays_per_cell) / 1e6));
  return out + "</tr>\n";
}

}  // namespace

std::string points_table(const SweepReport& report) {
  std::vector<size_t> order;
  std::set<std::string> renderers;
  for (size_t i = 0; i < report.points.size(); ++i) {
    if (!report.points[i].failed.empty()) continue;
    order.push_back(i);
    renderers.insert(report.points[i].renderer);
  }
  if (order.empty()) return "<p>No point has figures.</p>\n";
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    return judged_ms(report.points[a]) < judged_ms(report.points[b]);
  });
  const Fronts fronts(report);
  const Methods methods = methods_of(report);
  std::string rows;
  for (const size_t i : order)
    rows += row(report.points[i], i, fronts, methods.of_point[i], renderers.size() > 1);
  return fmt::format("<div class=\"wide\"><table>\n{}<tbody>\n{}</tbody>\n</table></div>\n", head, rows);
}

std::string failed_points(const SweepReport& report) {
  std::string items;
  for (const SweepPoint& point : report.points)
    if (!point.failed.empty())
      items += fmt::format("<li><strong>{}</strong>: {}</li>\n", escaped(point_name(point)),
                           escaped(point.failed, 400));
  return items.empty() ? "" : "<ul>\n" + items + "</ul>\n";
}

}  // namespace veduta
