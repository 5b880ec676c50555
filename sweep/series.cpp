#include "sweep/series.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <numbers>

#include "scene/markup.h"

namespace veduta {
namespace {

constexpr size_t colours = 6;
constexpr double radius_px = 5.5;

std::string text_at(const toml::table& config, const std::string& key) {
  return config.at_path(key).value<std::string>().value_or("");
}

/// A value as TOML without its quotes.
std::string value_of(const SweepPoint& point, const std::string& key, const std::string& otherwise) {
  for (const auto& [changed, value] : point.changed)
    if (changed == key)
      return value.size() >= 2 && value.front() == '"' ? value.substr(1, value.size() - 2) : value;
  return otherwise;
}

toml::table parsed(const std::string& config) {
  try {
    return toml::parse(config);
  } catch (const toml::parse_error&) {
    return {};  // only the names of methods are lost
  }
}

/// A regular polygon, or a star where every other corner is at `inner` times the radius.
std::string polygon(int corners, double turned, double inner, double x, double y, double radius) {
  std::string points;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * (i + turned) / corners;
    const double r = radius * (i % 2 ? inner : 1);
    points += fmt::format("{}{},{}", i ? " " : "", px(x + r * std::sin(angle)), px(y - r * std::cos(angle)));
  }
  return fmt::format(R"(<polygon points="{}")", points);
}

std::string shape(size_t form, double x, double y) {
  switch (form) {
    case 0:
      return fmt::format(R"(<circle cx="{}" cy="{}" r="{}")", px(x), px(y), px(radius_px));
    case 1:
      return polygon(4, 0.5, 1, x, y, radius_px * 1.3);  // square
    case 2:
      return polygon(3, 0, 1, x, y, radius_px * 1.4);  // triangle
    case 3:
      return polygon(4, 0, 1, x, y, radius_px * 1.35);  // diamond
    case 4:
      return polygon(3, 0.5, 1, x, y, radius_px * 1.4);  // triangle downwards
    default:
      return polygon(10, 0, 0.45, x, y, radius_px * 1.5);
  }
}

}  // namespace

Methods methods_of(const SweepReport& report) {
  const toml::table config = parsed(report.config);
  const std::string occlusion = text_at(config, "occlusion.method"),
                    shrink = text_at(config, "shrink.method");
  Methods methods;
  for (const SweepPoint& point : report.points) {
    std::string name = value_of(point, "occlusion.method", occlusion);
    if (name.empty()) name = "as configured";
    const std::string shrunk = value_of(point, "shrink.method", shrink);
    if (shrunk != shrink) name += ", shrink " + shrunk;
    const auto found = std::find(methods.names.begin(), methods.names.end(), name);
    methods.of_point.push_back(static_cast<size_t>(found - methods.names.begin()));
    if (found == methods.names.end()) methods.names.push_back(name);
  }
  return methods;
}

std::string mark(size_t method, double x, double y, const std::string& kind) {
  const size_t colour = method % colours, form = (method + method / colours) % colours;
  return fmt::format(R"({} class="{} c{}"/>)", shape(form, x, y), kind, colour);
}

const char* chart_style() {
  return R"(.chart text{font:12px system-ui,-apple-system,"Segoe UI",Roboto,"Helvetica Neue",Arial,sans-serif;fill:#222}
.chart .title{font-size:15px;font-weight:600}
.chart .tick,.chart .note{fill:#666;font-size:11.5px}
.chart .name{fill:#555;font-size:11px}
.chart .name.best{fill:#111;font-weight:600}
.chart .grid{stroke:#e4e4e4;stroke-width:1}
.chart .frame{stroke:#999;stroke-width:1}
.chart .leader{stroke:#aaa;stroke-width:.8}
.chart .front{fill:none;stroke:#444;stroke-width:1.4;stroke-dasharray:5 3}
.chart .beyond{fill:#000;fill-opacity:.035}
.chart .ring{fill:none;stroke:#222;stroke-width:1.4}
.paper{fill:#fff}
.mark{fill:currentColor;stroke:#fff;stroke-width:1}
.mark.hollow{fill:none;stroke:currentColor;stroke-width:1.8}
.c0{color:#0072b2}.c1{color:#d55e00}.c2{color:#009e73}.c3{color:#a23b86}.c4{color:#8a7500}.c5{color:#555}
@media screen and (prefers-color-scheme:dark){
.chart text{fill:#e6e6e6}
.chart .tick,.chart .note{fill:#9aa0a6}
.chart .name{fill:#b4b9be}
.chart .name.best{fill:#fff}
.chart .grid{stroke:#2b3036}
.chart .frame{stroke:#6b7178}
.chart .leader{stroke:#6b7178}
.chart .front{stroke:#c8ccd0}
.chart .beyond{fill:#fff;fill-opacity:.045}
.chart .ring{stroke:#e6e6e6}
.paper{fill:#15181b}
.mark{stroke:#15181b}
.c0{color:#56b4e9}.c1{color:#ff8f40}.c2{color:#2fd3a5}.c3{color:#e08cc0}.c4{color:#f0e442}.c5{color:#bbb}
}
)";
}

}  // namespace veduta
