#include "sweep/chart.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/markup.h"
#include "sweep/figures.h"
#include "sweep/plot.h"
#include "sweep/series.h"

namespace veduta {
namespace {

constexpr double note_px = 26;  // below a picture of its own

const char* axis_title(Chart chart) {
  switch (chart) {
    case Chart::buildings:
      return "buildings listed / seen";
    case Chart::objects:
      return "objects listed / seen";
    case Chart::triangles:
      return "triangles drawn / seen";
    case Chart::false_invisible:
      return "false invisible triangles, all cells";
    case Chart::bytes:
      break;
  }
  return "bytes a cell, as stored";
}

std::string line(const char* kind, const Segment& s) {
  return fmt::format(R"(<line class="{}" x1="{}" y1="{}" x2="{}" y2="{}"/>)", kind, px(s.x0), px(s.y0),
                     px(s.x1), px(s.y1));
}

std::string text(const char* kind, double x, double y, const char* anchor, const std::string& content) {
  return fmt::format(R"(<text class="{}" x="{}" y="{}" text-anchor="{}">{}</text>)", kind, px(x), px(y),
                     anchor, content);
}

std::string axes(const Plot& plot, const SweepReport& report, Chart chart) {
  std::string out;
  for (const double value : plot.x.ticks()) {
    const double x = plot.x.at(value);
    out += line("grid", {x, Plot::top, x, Plot::bottom}) +
           text("tick", x, Plot::bottom + 17, "middle", round_figure(value));
  }
  for (const double value : plot.y.ticks()) {
    const double y = plot.y.at(value);
    out += line("grid", {Plot::left, y, Plot::right, y}) +
           text("tick", Plot::left - 7, y + 4, "end", round_figure(value));
  }
  if (plot.has_none)
    out += line("grid", {Plot::left, Plot::none_y, Plot::right, Plot::none_y}) +
           text("tick", Plot::left - 7, Plot::none_y + 4, "end", "none");
  out += line("frame", {Plot::left, Plot::bottom, Plot::right, Plot::bottom});
  out += line("frame", {Plot::left, Plot::top, Plot::left, Plot::bottom});
  out += text("tick", Plot::right, Plot::bottom + 40, "end",
              "time per cell, " + time_unit(report) + " (logarithmic) →");
  out += text("tick", 8, Plot::top - 12, "start",
              fmt::format("↑ {}{}", axis_title(chart), plot.y.logarithmic ? " (logarithmic)" : ""));
  return out + "\n";
}

std::string front(const Plot& plot) {
  if (plot.front.empty()) return "";
  std::string points = px(plot.front[0].x0) + "," + px(plot.front[0].y0);
  for (const Segment& step : plot.front) points += fmt::format(" {},{}", px(step.x1), px(step.y1));
  return fmt::format(
      "<polygon class=\"beyond\" points=\"{0} {1},{2}\"/><polyline class=\"front\" points=\"{0}\"/>\n",
      points, px(Plot::right), px(Plot::top));
}

std::string ring(double x, double y, double radius) {
  return fmt::format(R"(<circle class="ring" cx="{}" cy="{}" r="{}"/>)", px(x), px(y), px(radius));
}

std::string marked_points(const Plot& plot, const SweepReport& report, const Methods& methods) {
  std::string leaders, marks, names;
  size_t nameless = 0;
  for (const PlotPoint& each : plot.points) {
    const SweepPoint& point = report.points[each.number];
    marks += fmt::format("<g><title>{}</title>{}{}</g>\n", point_figures(point),
                         each.standard ? ring(each.x, each.y, 10) : "",
                         mark(methods.of_point[each.number], each.x, each.y,
                              point.false_invisible_triangles > 0 ? "mark hollow" : "mark"));
    if (each.label.led) leaders += line("leader", each.label.leader);
    if (each.label.shown)
      names += text(each.on_front || each.standard ? "name best" : "name", each.label.box.x,
                    each.label.box.y + 11, "start", escaped(each.name)) +
               "\n";
    nameless += !each.label.shown && !each.name.empty();
  }
  if (nameless > 0)
    names += text(
        "note", Plot::left, Plot::bottom + 40, "start",
        fmt::format("{} of {} points without room for a name: see the table", nameless, plot.points.size()));
  return leaders + "\n" + marks + names;
}

/// Words behind the sign that they explain, in a line; what has no room is left out.
class Legend {
 public:
  Legend(double x, double y) : x_(x), y_(y) {}
  template <typename Sign>
  void add(const std::string& words, const Sign& sign) {
    const double width = sign_room + text_width(words, 12) + gap;
    if (x_ + width > Plot::right + gap) return;
    out_ +=
        sign(x_ + sign_room / 2 - 2, y_) + text("legend", x_ + sign_room, y_ + 4, "start", escaped(words));
    x_ += width;
  }
  const std::string& svg() const { return out_; }

 private:
  static constexpr double gap = 20, sign_room = 22;
  double x_, y_;
  std::string out_;
};

std::string legend(const Plot& plot, const SweepReport& report, const Methods& methods) {
  const auto has = [&](const auto& property) {
    return std::any_of(plot.points.begin(), plot.points.end(), property);
  };
  Legend forms(8, Plot::top - 44);
  for (size_t i = 0; i < methods.names.size(); ++i)
    if (has([&](const PlotPoint& point) { return methods.of_point[point.number] == i; }))
      forms.add(methods.names[i], [&](double x, double y) { return mark(i, x, y, "mark"); });
  Legend signs(Plot::right - 480, Plot::top - 16);
  if (!plot.front.empty())
    signs.add("Pareto front", [](double x, double y) {
      return fmt::format(R"(<path class="front" d="M{} {}h20"/>)", px(x - 12), px(y));
    });
  if (has([](const PlotPoint& point) { return point.standard; }))
    signs.add("default", [](double x, double y) { return ring(x, y, 7); });
  if (has([&](const PlotPoint& point) { return report.points[point.number].false_invisible_triangles > 0; }))
    signs.add("hollow: has false invisible triangles",
              [](double x, double y) { return mark(0, x, y, "mark hollow"); });
  return forms.svg() + signs.svg() + "\n";
}

std::string why_empty(const SweepReport& report, Chart chart) {
  const auto good = std::count_if(report.points.begin(), report.points.end(),
                                  [](const SweepPoint& point) { return point.failed.empty(); });
  if (good == 0) return "No point has figures.";
  if (chart != Chart::false_invisible) return "No point has a figure here: nothing was seen.";
  return fmt::format(
      "None: at no point did a ray meet a triangle that its row does not draw ({} point{}, {}).", good,
      good == 1 ? "" : "s", how_measured(report));
}

std::string titled(Chart chart) {
  return std::string("Time per cell against ") + chart_title(chart);
}

std::string drawn(const Plot& plot, const SweepReport& report, Chart chart) {
  const Methods methods = methods_of(report);
  return text("title", 8, 24, "start", titled(chart)) + legend(plot, report, methods) +
         axes(plot, report, chart) + front(plot) + marked_points(plot, report, methods);
}

}  // namespace

const char* chart_title(Chart chart) {
  switch (chart) {
    case Chart::buildings:
      return "over-estimate in buildings";
    case Chart::objects:
      return "over-estimate in objects";
    case Chart::triangles:
      return "over-estimate in triangles";
    case Chart::false_invisible:
      return "false invisible triangles";
    case Chart::bytes:
      break;
  }
  return "bytes per cell";
}

std::string chart_element(const SweepReport& report, Chart chart) {
  const Plot plot = plot_of(report, chart);
  if (plot.points.empty())
    return fmt::format("<h3>{}</h3>\n<p>{}</p>\n", titled(chart), why_empty(report, chart));
  return fmt::format("<svg class=\"chart\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n{}</svg>\n",
                     Plot::width, Plot::height, titled(chart), drawn(plot, report, chart));
}

std::string chart_svg(const SweepReport& report, Chart chart) {
  const Plot plot = plot_of(report, chart);
  const bool empty = plot.points.empty();
  const double height = empty ? 64 : Plot::height + note_px;
  std::string content =
      fmt::format(R"(<rect class="paper" width="{}" height="{}"/>)", Plot::width, px(height));
  content += empty ? text("title", 8, 24, "start", titled(chart)) +
                         text("note", 8, 48, "start", why_empty(report, chart))
                   : drawn(plot, report, chart);
  if (!empty)
    content += text("note", 8, height - 10, "start", escaped(report.title, 60) + ": " + how_measured(report));
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"chart\" width=\"{0}\" height=\"{1}\" "
      "viewBox=\"0 0 {0} {1}\" role=\"img\">\n<title>{2}</title>\n<style>\n{3}</style>\n{4}</svg>\n",
      Plot::width, height, titled(chart), chart_style(), content);
}

}  // namespace veduta
