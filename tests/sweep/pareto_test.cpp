// Fronts and recommendations, against the slow and obvious.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/sweep/made_up_sweep.h"

namespace veduta {
namespace {

constexpr auto buildings = &SweepPoint::overestimate_buildings;

TEST(PointName, KeysWithoutTheirTables) {
  EXPECT_EQ(point_name({}), "default");
  SweepPoint point;
  point.changed = {{"occlusion.subdivide", "4"}, {"occlusion.method", "\"zoom\""}};
  EXPECT_EQ(point_name(point), "subdivide 4, method zoom");
  point.changed = {{"cells.size", "20.0"}, {"slices.max", "1"}, {"shrink.method", "\"sealed\""}};
  EXPECT_EQ(point_name(point), "cell size 20, slices 1, shrink sealed");
  point.changed = {{"a.b", "\"x\ny\""}};
  EXPECT_EQ(point_name(point), "b x?y");
}

TEST(JudgedTime, OfProcessorsForSoftware) {
  SweepPoint point = test::made_up_point({}, 100, 2);
  point.cell_ms = 40;
  EXPECT_EQ(judged_ms(point), 100);
  for (const char* software : {"softpipe", "Google SwiftShader", "llvmpipe"}) {
    point.renderer = software;
    EXPECT_EQ(judged_by_processor(point), point.renderer != "Google SwiftShader")
        << "as EglContext::software()";
  }
  point.renderer = "NVIDIA H100 PCIe/PCIe/SSE2";
  EXPECT_EQ(judged_ms(point), 40);
  // Four cells half as wide come to one of the first point.
  point.cells_of_first = 300, point.cells_in_all = 1200;
  EXPECT_EQ(judged_ms(point), 160);
}

TEST(ParetoFront, KnownAnswer) {
  SweepReport report;
  for (const auto& [ms, over] : {std::pair(30.0, 1.5),
                                 {10.0, 3.0},
                                 {20.0, 3.0},
                                 {10.0, 3.5},
                                 {40.0, 1.5},
                                 {5.0, 8.0},
                                 {60.0, 1.2},
                                 {30.0, 1.5}})
    report.points.push_back(test::made_up_point({}, ms, over));
  EXPECT_EQ(pareto_front(report, buildings), (std::vector<size_t>{5, 1, 0, 7, 6}));
  report.points[5].failed = "x", report.points[6].false_invisible_triangles = 1;
  report.points[1].overestimate_buildings = 0;  // nothing seen
  EXPECT_EQ(pareto_front(report, buildings), (std::vector<size_t>{3, 2, 0, 7}));
  EXPECT_EQ(pareto_front(report, &SweepPoint::bytes_per_cell), (std::vector<size_t>{1, 0, 7}));
  EXPECT_TRUE(pareto_front({}, buildings).empty());
}

TEST(ParetoFront, EqualRowsAreNotToldApartByNoise) {
  SweepReport report;
  for (const auto& [ms, over] :
       {std::pair(100.0, 1.5), {104.0, 1.5}, {106.0, 1.5}, {103.0, 1.6}, {104.0, 1.49}})
    report.points.push_back(test::made_up_point({}, ms, over));
  EXPECT_EQ(pareto_front(report, buildings), (std::vector<size_t>{0, 1, 4}));
}

TEST(ParetoFront, IsWhatNoOtherBeats) {
  std::mt19937 random(11);
  for (int round = 0; round < 200; ++round) {
    SweepReport report;
    const auto small = [&] { return 1.0 + static_cast<double>(random() % 6); };
    for (size_t n = random() % 20; n > 0; --n) {
      report.points.push_back(test::made_up_point({}, small(), small()));
      if (random() % 5 == 0) report.points.back().failed = "x";
      if (random() % 5 == 0) report.points.back().false_invisible_triangles = 1;
    }
    std::vector<size_t> expected;
    const auto good = [](const SweepPoint& p) {
      return p.failed.empty() && p.false_invisible_triangles == 0;
    };
    for (size_t i = 0; i < report.points.size(); ++i) {
      const SweepPoint& p = report.points[i];
      const bool beaten = std::any_of(report.points.begin(), report.points.end(), [&](const SweepPoint& q) {
        return good(q) && judged_ms(q) <= judged_ms(p) && q.*buildings <= p.*buildings &&
               (judged_ms(q) < judged_ms(p) || q.*buildings < p.*buildings);
      });
      if (good(p) && !beaten) expected.push_back(i);
    }
    std::vector<size_t> front = pareto_front(report, buildings);
    EXPECT_TRUE(std::is_sorted(front.begin(), front.end(), [&](size_t a, size_t b) {
      return judged_ms(report.points[a]) < judged_ms(report.points[b]);
    }));
    std::sort(front.begin(), front.end());
    EXPECT_EQ(front, expected) << "round " << round;
    // The fastest within a limit is on the front.
    for (const double most : {0.5, 1.0, 3.0, 9.0}) {
      const int found = recommend(report, most);
      double least = 1e9;
      for (const size_t i : expected)
        if (report.points[i].*buildings <= most) least = std::min(least, judged_ms(report.points[i]));
      ASSERT_EQ(found < 0, least == 1e9);
      if (found < 0) continue;
      EXPECT_EQ(judged_ms(report.points[static_cast<size_t>(found)]), least);
      EXPECT_LE(report.points[static_cast<size_t>(found)].*buildings, most);
    }
  }
}

}  // namespace
}  // namespace veduta
