// The page and its pictures: what has to stand there, and what must not.
#include <gtest/gtest.h>

#include <algorithm>
#include <pugixml.hpp>

#include "sweep/chart.h"
#include "tests/sweep/made_up_sweep.h"

namespace veduta {
namespace {

size_t occurrences(const std::string& text, const std::string& part) {
  size_t n = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++n;
  return n;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Well-formed XML with these elements alone.
void expect_picture(const std::string& svg) {
  pugi::xml_document document;
  const auto result = document.load_string(svg.c_str());
  ASSERT_TRUE(result) << result.description() << " at " << svg.substr(static_cast<size_t>(result.offset), 80);
  EXPECT_STREQ(document.first_child().name(), "svg");
  for (const pugi::xpath_node& node : document.select_nodes("//*")) {
    const std::string name = node.node().name();
    EXPECT_TRUE(name == "svg" || name == "title" || name == "style" || name == "rect" || name == "line" ||
                name == "text" || name == "g" || name == "circle" || name == "polygon" ||
                name == "polyline" || name == "path")
        << name;
    for (const pugi::xml_attribute& attribute : node.node().attributes())
      EXPECT_FALSE(has(attribute.value(), "nan") || has(attribute.value(), "inf")) << attribute.value();
  }
}

TEST(Chart, IsAPicture) {
  const SweepReport report = test::crowded_report();
  for (const Chart chart : all_charts) {
    const std::string svg = chart_svg(report, chart);
    expect_picture(svg);
    EXPECT_TRUE(has(svg, chart_title(chart)));
    EXPECT_TRUE(has(svg, "32 cells, 1,000,000 rays a cell, seed 1; llvmpipe"));
    if (chart == Chart::false_invisible) continue;
    EXPECT_EQ(occurrences(svg, "<g><title>"), report.points.size() - 1);  // one failed
    EXPECT_TRUE(has(svg, "class=\"front\""));
    EXPECT_TRUE(has(svg, ">default</text>"));
    EXPECT_TRUE(has(svg, ">subdivide 1, shrink planes</text>"));
    EXPECT_TRUE(has(svg, "logarithmic"));
  }
}

TEST(Chart, SaysWhereThereIsNothingToDraw) {
  SweepReport report = test::crowded_report();
  EXPECT_TRUE(has(chart_svg(report, Chart::false_invisible), "None: at no point"));
  EXPECT_TRUE(has(chart_element(report, Chart::false_invisible), "<p>None: at no point"));
  report.points[2].false_invisible_triangles = 3;
  const std::string svg = chart_svg(report, Chart::false_invisible);
  expect_picture(svg);
  EXPECT_TRUE(has(svg, ">none</text>"));
  EXPECT_EQ(occurrences(svg, "mark hollow c"), 2u);  // the point and the legend
  report.points.clear();
  for (const Chart chart : all_charts) {
    expect_picture(chart_svg(report, chart));
    EXPECT_TRUE(has(chart_svg(report, chart), "No point has figures."));
  }
}

/// Shares and times at the ends of what a double holds draw, too.
TEST(Chart, TakesAnyFigure) {
  for (const double ms : {0.0, 5e-324, 1.0, 1e300})
    for (const double over : {0.0, 5e-324, 1e-3, 1.0, 1e300}) {
      SweepReport report = test::made_up_report();
      report.points = {test::made_up_point({}, ms, over), test::made_up_point({{"a.b", "1"}}, 12, 1.4)};
      for (const Chart chart : all_charts) expect_picture(chart_svg(report, chart));
      EXPECT_FALSE(sweep_page(report).empty());
    }
}

TEST(Page, ShowsEveryFigure) {
  const SweepReport report = test::crowded_report();
  const std::string page = sweep_page(report);
  EXPECT_EQ(occurrences(page, "<svg class=\"chart\""), all_charts.size() - 1);  // nothing is false
  EXPECT_EQ(occurrences(page, "<tr><th class=\"left"), report.points.size() - 1);
  EXPECT_TRUE(has(page, "denhaag.toml"));
  EXPECT_TRUE(has(page, "2 cores of Intel Xeon, 24 GB"));
  EXPECT_TRUE(has(page, "32 of 4,158"));
  EXPECT_TRUE(has(page, "a worker died three times"));
  EXPECT_TRUE(has(page, "At most 1.2×: no point"));
  EXPECT_TRUE(has(page, "At most 1.5×: <strong>cell size 20, max_overestimate 1.2</strong> is the fastest"));
  EXPECT_TRUE(has(page, "prefers-color-scheme:dark"));
  // The table is sorted by time, and the front is bold.
  const size_t table = page.find("<tbody>");
  EXPECT_LT(page.find("subdivide 1, shrink planes", table), page.find("</svg> default", table));
  EXPECT_LT(page.find("</svg> default", table), page.find("method zoom, subdivide 8", table));
  EXPECT_EQ(occurrences(page, "<tr><th class=\"left best\">"),
            pareto_front(report, &SweepPoint::overestimate_buildings).size());
}

/// Names of configurations, machines and errors come from anywhere.
TEST(Page, HostileTexts) {
  const std::string bad = "\"'><script>alert(1)</script><img src=x onerror=y>&\x01\xff";
  SweepReport report = test::crowded_report();
  report.title = report.config = report.machine = report.version = bad;
  for (SweepPoint& point : report.points) {
    point.changed.emplace_back("a." + bad, bad);
    point.renderer = "llvmpipe " + bad;
    if (!point.failed.empty()) point.failed = bad;
  }
  report.points[3].changed.emplace_back("occlusion.method", bad);
  report.points[4].false_invisible_triangles = 1;
  const std::string page = sweep_page(report);
  EXPECT_FALSE(has(page, "<script")) << page.substr(page.find("<script"), 200);
  EXPECT_FALSE(has(page, "<img"));
  EXPECT_FALSE(has(page, "onerror=y>"));
  EXPECT_FALSE(has(page, "\x01"));
  EXPECT_TRUE(has(page, "&lt;script&gt;"));
  for (const Chart chart : all_charts) expect_picture(chart_svg(report, chart));
}

TEST(Page, AsksForNothing) {
  const std::string page = sweep_page(test::crowded_report());
  for (const char* part : {"http:", "https:", "url(", "<script", "<link", "@import", "src=", "href="})
    EXPECT_FALSE(has(page, part)) << part;
  EXPECT_TRUE(has(page, "default-src 'none'"));
}

}  // namespace
}  // namespace veduta
