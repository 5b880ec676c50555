// The page: everything in one file, nothing asked for from elsewhere, no scripts.
#include <fmt/format.h>

#include "scene/markup.h"
#include "sweep/chart.h"
#include "sweep/figures.h"
#include "sweep/series.h"
#include "sweep/sweep.h"
#include "sweep/table.h"

namespace veduta {
namespace {

constexpr const char* page_style = R"(:root{color-scheme:light dark}
body{margin:0;background:#fff;color:#222;font:15px/1.5 system-ui,-apple-system,"Segoe UI",Roboto,"Helvetica Neue",Arial,sans-serif}
main{max-width:1140px;margin:0 auto;padding:28px 24px 48px}
h1{font-size:27px;line-height:1.2;font-weight:650;margin:0 0 6px;overflow-wrap:anywhere}
h2{font-size:19px;font-weight:650;margin:38px 0 8px}
h3{font-size:15px;font-weight:600;margin:22px 0 0}
p{margin:6px 0;max-width:78ch}
dl{display:grid;grid-template-columns:max-content 1fr;gap:3px 18px;margin:14px 0}
dt,small,.aside,footer{color:#666}
dd{margin:0;overflow-wrap:anywhere}
svg.chart{display:block;width:100%;height:auto;margin:8px 0}
ul{padding-left:20px;margin:8px 0}
li{margin:3px 0;overflow-wrap:anywhere}
.wide{overflow-x:auto}
table{border-collapse:collapse;font-size:11.5px;line-height:1.35;font-variant-numeric:tabular-nums}
th,td{padding:4px 6px;text-align:right;vertical-align:top;font-weight:400;border-bottom:1px solid #e4e4e4}
thead th{vertical-align:bottom;color:#666;hyphens:manual}
thead tr:last-child th,thead th[rowspan]{border-bottom:1.5px solid #999}
th[colspan]{text-align:center;border-bottom-color:#bbb}
.left{text-align:left;min-width:175px}
td{white-space:nowrap}
.best{font-weight:650}
.wrong{color:#b3261e;font-weight:650}
td svg,th svg{vertical-align:-2px}
pre{font:12px/1.45 ui-monospace,Menlo,Consolas,"DejaVu Sans Mono",monospace;overflow-x:auto;padding:10px 12px;background:#f5f5f5}
summary{cursor:pointer}
footer{margin-top:36px;font-size:13px}
@media screen and (prefers-color-scheme:dark){
body{background:#15181b;color:#e6e6e6}
dt,small,.aside,footer,thead th{color:#9aa0a6}
th,td{border-bottom-color:#2b3036}
thead tr:last-child th,thead th[rowspan]{border-bottom-color:#6b7178}
th[colspan]{border-bottom-color:#444b52}
.wrong{color:#ff8a80}
pre{background:#1d2126}
}
@page{size:A4 landscape;margin:12mm}
@media print{
main{max-width:none;padding:0}
figure,tr,svg.chart{break-inside:avoid}
h2,h3{break-after:avoid}
table{font-size:8.5px}
th,td{padding:2px 3px}
details{display:none}
}
)";

std::string facts(const SweepReport& report) {
  std::string out = "<dl>\n";
  const auto fact = [&](const char* what, const std::string& text) {
    out += fmt::format("<dt>{}</dt><dd>{}</dd>\n", what, text);
  };
  fact("machine", escaped(report.machine));
  fact("renderer", renderers_of(report));
  fact("sample", fmt::format("{} cells a point, {} rays a cell, seed {}", count(report.cells),
                             count(report.rays_per_cell), report.seed));
  fact("time", time_unit(report) + " a cell: baked one by one by one worker, after one that warms it up");
  fact("program", "Veduta " + escaped(report.version));
  return out + "</dl>\n";
}

std::string recommendations(const SweepReport& report) {
  std::string out =
      "<h2>Which setting</h2>\n<p>The fastest without false invisible triangles, by the over-estimate in "
      "buildings:</p>\n<ul>\n";
  for (const double most : {1.2, 1.5, 2.0}) out += "<li>" + recommendation(report, most) + "</li>\n";
  return out + "</ul>\n";
}

std::string charts(const SweepReport& report) {
  std::string out =
      "<h2>Time against error</h2>\n<p>Down and to the left is better. Hover over a mark for its "
      "figures.</p>\n";
  for (const Chart chart : all_charts) out += "<section>\n" + chart_element(report, chart) + "</section>\n";
  return out;
}

/// A configuration keeps its lines.
std::string configuration(const std::string& toml) {
  std::string out;
  for (size_t at = 0, end = 0; at < toml.size(); at = end + 1) {
    end = std::min(toml.find('\n', at), toml.size());
    out += escaped(toml.substr(at, end - at), 4000) + "\n";
  }
  return out;
}

constexpr const char* footnote = R"(<footer>
<p><strong>Over-estimate</strong>: what the rows list or draw over what rays from sampled eye points met. That is a lower bound of
what can be seen, so the true over-estimate is at most the one shown. <strong>Of that, format</strong>: the smallest rows of three
bytes an object that draw all that was seen. <strong>False invisible</strong>: met by a ray, and not drawn by the row of its cell;
solid angle as a share of the sphere. <strong>Narrow gaps</strong>: seen through nothing but gaps narrower than two seeds, which a
bake may take for closed. <strong>Pareto front</strong> (bold): no other point is more than 1 % tighter and as fast, or as tight and more than 5 % faster.
Cells of another size are drawn and judged by the time of as many as come to one cell of the first point.</p>
</footer>
)";

}  // namespace

std::string sweep_page(const SweepReport& report) {
  const std::string title = escaped(report.title);
  std::string body = fmt::format("<h1>Speed against error: {}</h1>\n", title) + facts(report);
  body += recommendations(report) + charts(report);
  body += "<h2>All points</h2>\n" + points_table(report);
  const std::string failed = failed_points(report);
  if (!failed.empty()) body += "<h2>Points that failed</h2>\n" + failed;
  body += fmt::format(
      "<h2>Configuration</h2>\n<details><summary>of the default point</summary>\n<pre>{}</pre></details>\n",
      configuration(report.config));
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
      "'unsafe-inline'\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>Speed against error: "
      "{}</title>\n<style>\n{}{}</style>\n</head>\n<body>\n<main>\n{}{}</main>\n</body>\n</html>\n",
      title, page_style, chart_style(), body, footnote);
}

}  // namespace veduta
