#include "verify/verify.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

#include "scene/ray_scene.h"
#include "tests/verify/toy_city.h"

namespace veduta {
namespace {

using toy::Street;

constexpr VerifyOptions few{.cells = 8, .rays_per_cell = 40'000, .eyes_per_cell = 40, .seed = 7};

// The ray of an example, shot again, must meet the triangle that it names.
void expect_reproduces(const PvsFile& file, const FalseInvisible& example) {
  const RayScene rays(file.city.scene);
  Hit hit;
  rays.first_hits(example.eye, {&example.direction, 1}, {&hit, 1});
  EXPECT_EQ(hit.triangle, example.triangle);
  const Object& object = file.city.scene.objects[example.object];
  EXPECT_GE(example.triangle, object.triangle_begin);
  EXPECT_LT(example.triangle, object.triangle_end);
  EXPECT_TRUE(file.city.cells[example.cell].contains(example.eye));
}

TEST(Verify, RowWithAllThatIsSeenPasses) {
  const PvsFile file = Street::file(Street::row({Street::ground, Street::wall, Street::tower}));
  const VerifyReport report = verify(file, few);
  EXPECT_TRUE(report.passed());
  EXPECT_EQ(report.cells_checked, 1u);
  EXPECT_EQ(report.cells_without_eye, 0u);
  EXPECT_EQ(report.rays, few.rays_per_cell);
  EXPECT_GT(report.hits, 0u);
  EXPECT_TRUE(report.examples.empty());
  EXPECT_DOUBLE_EQ(report.overestimate_objects, 1);
  EXPECT_DOUBLE_EQ(report.drawn_of_whole_objects, 1);
  EXPECT_NE(describe(report, file).find("passed"), std::string::npos);
}

TEST(Verify, HiddenObjectInTheRowIsOverestimateOnly) {
  const VerifyReport report = verify(Street::file(Street::row({0, 1, 2, 3})), few);
  EXPECT_TRUE(report.passed());
  EXPECT_DOUBLE_EQ(report.mean_pvs_objects, 4);
  EXPECT_DOUBLE_EQ(report.mean_seen_objects, 3);
  EXPECT_DOUBLE_EQ(report.overestimate_objects, 4.0 / 3);
  EXPECT_DOUBLE_EQ(report.overestimate_objects_worst, 4.0 / 3);
  EXPECT_DOUBLE_EQ(report.overestimate_buildings, 3.0 / 2);
}

// The hut is what visibility costs, 12 triangles; what it costs to draw whole boxes of which at most three
// sides are seen is the format's, until slices tell the sides apart.
TEST(Verify, SaysWhatTheFormatCosts) {
  PvsFile file = Street::file(Street::row({0, 1, 2, 3}));
  const VerifyReport whole = verify(file, few);
  EXPECT_DOUBLE_EQ(whole.tightest_triangles, 36 / whole.mean_seen_triangles);
  EXPECT_DOUBLE_EQ(whole.whole_seen_objects_triangles, 36 / whole.mean_seen_triangles);
  // The floor of the tower, its first two triangles, in a slice of its own.
  file.city.slices[Street::tower].z = 2;
  const Object& tower = file.city.scene.objects[Street::tower];
  for (uint64_t t = tower.triangle_begin + 2; t < tower.triangle_end; ++t)
    file.city.triangle_slices[t].z_last = 2;
  const VerifyReport sliced = verify(file, few);
  EXPECT_DOUBLE_EQ(sliced.tightest_triangles, 34 / sliced.mean_seen_triangles);
  EXPECT_DOUBLE_EQ(sliced.whole_seen_objects_triangles, whole.whole_seen_objects_triangles);
  EXPECT_DOUBLE_EQ(sliced.overestimate_triangles, whole.overestimate_triangles);
  EXPECT_NE(describe(sliced, file).find("tightest rows"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(describe_json(sliced, file))["tightest_triangles"],
            sliced.tightest_triangles);
}

TEST(Verify, SaysWhatTheBakeCertifiedBesideWhatItMeasures) {
  PvsFile file = Street::file(Street::row({0, 1, 2, 3}));
  EXPECT_EQ(describe(verify(file, few), file).find("certified "), std::string::npos) << "nobody looked";
  file.overestimate = {1.5f};
  const VerifyReport report = verify(file, few);
  EXPECT_EQ(report.cells_certified, 1u);
  EXPECT_EQ(report.certified_median, 1.5);
  EXPECT_EQ(report.certified_worst, 1.5);
  EXPECT_NE(
      describe(report, file).find("in objects: median cell 1.50x, worst 1.50x, by the bake's own rays in 1"),
      std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(describe_json(report, file))["certified_worst"], 1.5);
}

TEST(Verify, MissingVisibleObjectFailsAndTheExampleReproduces) {
  const PvsFile file = Street::file(Street::row({Street::ground, Street::wall}));
  const VerifyReport report = verify(file, few);
  EXPECT_FALSE(report.passed());
  EXPECT_EQ(report.false_invisible_objects, 1u);
  EXPECT_GT(report.false_invisible_triangles, 0u);
  EXPECT_GT(report.false_invisible_solid_angle_mean, 0);
  EXPECT_GE(report.false_invisible_solid_angle_worst, report.false_invisible_solid_angle_mean);
  ASSERT_EQ(report.examples.size(), 1u);
  EXPECT_EQ(report.examples[0].object, Street::tower);
  expect_reproduces(file, report.examples[0]);
  EXPECT_NE(describe(report, file).find("\"tower\""), std::string::npos);
  const auto json = nlohmann::json::parse(describe_json(report, file));
  EXPECT_EQ(json["examples"][0]["name"], "tower");
  EXPECT_EQ(json["passed"], false);
}

// A pole of 2 cm over a wall's top covers some 1e-5 of the sphere: aimed rays meet it for sure.
TEST(Verify, SpeckIsFoundByAimedRays) {
  Scene scene = Street::scene();
  toy::add_box(scene, "speck", {{30, 1, 36}, {30.02f, 1.02f, 60}});
  const PvsFile file = toy::make_file(scene, {Street::cell()}, {Street::row({0, 1, 3})});
  const VerifyReport report = verify(file, few);
  ASSERT_FALSE(report.passed());
  EXPECT_EQ(report.false_invisible_objects, 1u);
  expect_reproduces(file, report.examples.at(0));
}

TEST(Verify, SliceByteThatHidesAVisibleTriangleFails) {
  PvsFile file = Street::file({{0, completely_visible}, {1, completely_visible}, {3, {0, 0, 2}}});
  const Object& tower = file.city.scene.objects[Street::tower];
  file.city.slices[Street::tower].z = 2;
  // Two slices: the roof and the walls reach the upper one, the floor does not.
  for (uint64_t t = tower.triangle_begin; t < tower.triangle_end; ++t)
    file.city.triangle_slices[t].z_last = 2;
  EXPECT_TRUE(verify(file, few).passed());
  // Now two triangles of a wall that is seen are said to end in the lower slice.
  file.city.triangle_slices[tower.triangle_begin + 8].z_last = 1;
  file.city.triangle_slices[tower.triangle_begin + 9].z_last = 1;
  const VerifyReport report = verify(file, few);
  EXPECT_FALSE(report.passed());
  EXPECT_EQ(report.false_invisible_triangles, 2u);
  ASSERT_FALSE(report.examples.empty());
  expect_reproduces(file, report.examples[0]);
}

// Two objects with the same wall, one listed: the picture is the same.
TEST(Verify, CoincidentWallOfWhichOneIsListedPasses) {
  for (const uint32_t listed : {1u, 4u}) {
    Scene scene = Street::scene();
    toy::add_box(scene, "wall again", scene.bounds(Street::wall));
    const PvsFile file = toy::make_file(scene, {Street::cell()}, {Street::row({0, listed, 3})});
    EXPECT_TRUE(verify(file, few).passed()) << "listed: " << listed;
  }
}

TEST(Verify, WallAHairInFrontIsNotCoincident) {
  Scene scene = Street::scene();
  toy::add_box(scene, "poster", {{std::nextafter(10.0f, 0.0f), -1, 1}, {10, 1, 2}});
  const PvsFile file = toy::make_file(scene, {Street::cell()}, {Street::row({0, 1, 3})});
  const VerifyReport report = verify(file, few);
  EXPECT_FALSE(report.passed());
}

TEST(Verify, CellWithoutAnEyePointIsCountedAndNothingCheckedIsNotPassed) {
  Scene scene = Street::scene();
  toy::add_box(scene, "block", {{-4, -4, 0}, {8, 8, 8}});
  const PvsFile file = toy::make_file(scene, {Street::cell()}, {PvsRow{}});
  const VerifyReport report = verify(file, few);
  EXPECT_EQ(report.cells_without_eye, 1u);
  EXPECT_EQ(report.rays, 0u);
  EXPECT_FALSE(report.passed());
  EXPECT_NE(describe(report, file).find("nothing was checked"), std::string::npos);
}

// The street's wall with slits in it, seeds of 0.25 m. What is behind the wall is not in the row.
PvsFile slit_wall(std::vector<float> widths) {
  Scene scene = Street::scene();
  const uint32_t wall = Street::wall;
  float from = -30;
  std::vector<Box> pieces;
  for (const float width : widths) {
    const float at = width > 0.5f ? 1.5f : 0;
    pieces.push_back({{10, from, 0}, {11, at, 12}});
    from = at + width;
  }
  pieces.push_back({{10, from, 0}, {11, 30, 12}});
  PvsRow row = Street::row({Street::ground, wall, Street::tower});
  for (size_t i = 1; i < pieces.size(); ++i)
    row.push_back({toy::add_box(scene, "piece " + std::to_string(i), pieces[i]), completely_visible});
  for (uint64_t t = scene.objects[wall].triangle_begin; t < scene.objects[wall].triangle_end; ++t) {
    for (int k = 0; k < 3; ++k) {
      float& y = scene.vertices[scene.triangles[t][k]].y;
      y = std::min(y, pieces[0].upper.y);
    }
  }
  PvsFile file = toy::make_file(std::move(scene), {Street::cell()}, {row});
  file.header.config = "[navigation]\nseed_size = 0.25\n";
  return file;
}

TEST(Verify, ASlitOfOneSeedIsCountedAndPasses) {
  const PvsFile file = slit_wall({0.25f});
  const VerifyReport report = verify(file, few);
  EXPECT_TRUE(report.passed());
  EXPECT_EQ(report.false_invisible_objects + report.false_invisible_triangles, 0u);
  EXPECT_EQ(report.false_invisible_solid_angle_worst, 0);
  EXPECT_EQ(report.narrow_gap_objects, 1u);
  EXPECT_GT(report.narrow_gap_triangles, 0u);
  EXPECT_GT(report.narrow_gap_solid_angle_mean, 0);
  EXPECT_GE(report.narrow_gap_solid_angle_worst, report.narrow_gap_solid_angle_mean);
  EXPECT_EQ(report.narrow_gap_limit_m, 0.5);
  EXPECT_TRUE(report.examples.empty());
  ASSERT_EQ(report.narrow_gap_examples.size(), 1u);
  EXPECT_EQ(report.narrow_gap_examples[0].object, Street::hut);
  EXPECT_NEAR(report.narrow_gap_examples[0].gap.width_m, 0.25f, 0.02f);
  expect_reproduces(file, report.narrow_gap_examples[0]);
  EXPECT_NE(describe(report, file).find("narrow gaps      1 objects"), std::string::npos);
  EXPECT_NE(describe(report, file).find("passed: through nothing but gaps"), std::string::npos);
  const auto json = nlohmann::json::parse(describe_json(report, file));
  EXPECT_EQ(json["passed"], true);
  EXPECT_EQ(json["false_invisible_objects"], 0);
  EXPECT_EQ(json["narrow_gap_objects"], 1);
  EXPECT_EQ(json["narrow_gap_triangles"], report.narrow_gap_triangles);
  EXPECT_EQ(json["narrow_gap_examples"][0]["name"], "hut");
}

TEST(Verify, ASlitOfThreeSeedsIsAFault) {
  const PvsFile file = slit_wall({0.75f});
  const VerifyReport report = verify(file, few);
  EXPECT_FALSE(report.passed());
  EXPECT_EQ(report.false_invisible_objects, 1u);
  EXPECT_EQ(report.narrow_gap_objects, 0u);
}

TEST(Verify, OneRayPastTheNarrowGapMakesItAFault) {
  const VerifyReport report = verify(slit_wall({0.25f, 0.75f}), few);
  EXPECT_FALSE(report.passed());
  EXPECT_EQ(report.false_invisible_objects, 1u);
  EXPECT_EQ(report.narrow_gap_objects, 0u) << "the hut is counted once";
  EXPECT_EQ(report.narrow_gap_triangles, 0u) << "and so is its front";
}

TEST(Verify, NothingIsExcusedInAFileThatDoesNotSayItsSeeds) {
  PvsFile file = slit_wall({0.25f});
  file.header.config.clear();
  const VerifyReport report = verify(file, few);
  EXPECT_FALSE(report.passed());
  EXPECT_EQ(report.narrow_gap_objects, 0u);
}

PvsFile nine_cells() {
  std::vector<Box> cells;
  std::vector<PvsRow> rows;
  for (int i = 0; i < 9; ++i) {
    const glm::vec3 move{-8 * (i % 3), 8 * (i / 3), 0};
    cells.push_back({Street::cell().lower + move, Street::cell().upper + move});
    rows.push_back(Street::row({0, 1}));
  }
  return toy::make_file(Street::scene(), cells, rows);
}

std::string without_times(VerifyReport report, const PvsFile& file) {
  report.elapsed_s = report.rays_per_second = 0, report.times = {};
  return describe_json(report, file);
}

// The hut is listed, so no ray is aimed at it as at something that is not drawn; through the slit of 1 cm it
// covers some 1e-5 of the sphere.
TEST(Verify, FewRaysFindTheirWayIntoASlit) {
  PvsFile file = slit_wall({0.01f});
  PvsRow row = Street::row({Street::ground, Street::wall, Street::hut, Street::tower, 4});
  file = toy::make_file(file.city.scene, file.city.cells, {row});
  const VerifyReport report =
      verify(file, {.cells = 1, .rays_per_cell = 20'000, .eyes_per_cell = 8, .seed = 7});
  EXPECT_TRUE(report.passed());
  EXPECT_EQ(report.mean_seen_objects, 5);
}

TEST(Verify, OverestimateFallsAsRaysDouble) {
  const PvsFile file = nine_cells();
  const VerifyReport report = verify(file, few);
  ASSERT_EQ(report.convergence.size(), 4u);
  for (size_t i = 0; i < 4; ++i) {
    const Convergence& part = report.convergence[i];
    EXPECT_EQ(part.rays_per_cell, few.rays_per_cell >> (3 - i));
    if (i == 0) continue;
    EXPECT_LE(part.overestimate_objects, report.convergence[i - 1].overestimate_objects);
    EXPECT_LE(part.overestimate_buildings, report.convergence[i - 1].overestimate_buildings);
    EXPECT_LE(part.overestimate_triangles, report.convergence[i - 1].overestimate_triangles);
  }
  EXPECT_LT(report.convergence[3].overestimate_triangles, report.convergence[0].overestimate_triangles);
  EXPECT_EQ(report.convergence[3].overestimate_objects, report.overestimate_objects);
  EXPECT_EQ(report.convergence[3].overestimate_buildings, report.overestimate_buildings);
  EXPECT_EQ(report.convergence[3].overestimate_triangles, report.overestimate_triangles);
}

TEST(Verify, SaysHowTheOverestimateFalls) {
  const PvsFile file = nine_cells();
  VerifyReport report = verify(file, few);
  report.convergence = {{500'000, 1.712, 1.8, 5}, {1'000'000, 1.66, 1.7, 4.5}, {4'000'000, 1.579, 1.6, 4.49}};
  EXPECT_NE(describe(report, file)
                .find("as rays double   from 0.5 million to 4 million a cell, the over-estimate "
                      "in objects still falls: 1.71x, 1.66x, 1.58x; in triangles has settled: "
                      "5.00x, 4.50x, 4.49x\n"),
            std::string::npos);
  const auto json = nlohmann::json::parse(describe_json(report, file));
  ASSERT_EQ(json["convergence"].size(), 3u);
  EXPECT_EQ(json["convergence"][2]["rays_per_cell"], 4'000'000);
  EXPECT_EQ(json["convergence"][2]["overestimate_objects"], 1.579);
  EXPECT_EQ(json["convergence"][1]["overestimate_buildings"], 1.7);
  EXPECT_EQ(json["convergence"][1]["overestimate_triangles"], 4.5);
  for (const char* part : {"set_up", "eyes", "directions", "tracing", "settling", "total"})
    EXPECT_TRUE(json["times_s"].contains(part)) << part;
}

TEST(Verify, EveryLineOfTheReport) {
  PvsFile file = nine_cells();
  file.overestimate.assign(9, 1.5f);
  std::istringstream lines(describe(verify(file, few), file));
  for (const char* begin :
       {"verified         8 of 9 cells (0 without an eye point), 320000 rays, ",
        "false invisible  8 objects, ", "narrow gaps      0 objects, ", "over-estimate    ",
        "as rays double   from 5000 to 40000 a cell, ", "of that, format  ",
        "certified        in objects: median cell 1.50x", "a cell lists     2.0 objects, ",
        "slices draw      100.0 %", "What rays saw is a lower bound"}) {
    std::string line;
    ASSERT_TRUE(std::getline(lines, line));
    EXPECT_TRUE(line.starts_with(begin)) << line;
  }
  for (int i = 0; i < 8; ++i) {
    std::string line;
    ASSERT_TRUE(std::getline(lines, line));
    EXPECT_TRUE(line.starts_with("FALSE INVISIBLE  cell ") && line.find("\"tower\", triangle ") != line.npos)
        << line;
  }
  std::string line;
  ASSERT_TRUE(std::getline(lines, line));
  EXPECT_EQ(line, "FAILED: rays met triangles that their rows do not draw");
  EXPECT_FALSE(std::getline(lines, line));
}

TEST(Verify, SameReportForAnyNumberOfThreads) {
  const PvsFile file = nine_cells();
  std::string reports[2];
  for (const size_t threads : {1, 2}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    reports[threads - 1] = without_times(verify(file, few), file);
  }
  EXPECT_EQ(reports[0], reports[1]);
  VerifyOptions other = few;
  other.seed = 8;
  EXPECT_NE(without_times(verify(file, other), file), reports[0]);
}

TEST(Verify, SamplesCellsWithoutReplacementAndReportsProgress) {
  const PvsFile file = nine_cells();
  uint32_t calls = 0, total = 0;
  const VerifyReport all = verify(file, few, [&](uint32_t done, uint32_t of) {
    EXPECT_EQ(done, ++calls);
    total = of;
  });
  EXPECT_EQ(all.cells_checked, 8u);
  EXPECT_EQ(calls, 8u);
  EXPECT_EQ(total, 8u);
  EXPECT_EQ(all.false_invisible_objects, 8u) << "the tower, once from each of 8 different cells";
  VerifyOptions more = few;
  more.cells = 100;
  EXPECT_EQ(verify(file, more).cells_checked, 9u);
}

TEST(Verify, AtMostSixteenExamplesNearestFirst) {
  Scene scene = Street::scene();
  for (int i = 0; i < 30; ++i)
    toy::add_box(scene, "box " + std::to_string(i),
                 {{-10.0f - static_cast<float>(i), 2.0f * static_cast<float>(i) - 30, 0},
                  {-9.0f - static_cast<float>(i), 2.0f * static_cast<float>(i) - 29, 3}});
  const PvsFile file = toy::make_file(scene, {Street::cell()}, {Street::row({0, 1, 3})});
  const VerifyReport report = verify(file, few);
  EXPECT_GT(report.false_invisible_objects, 16u);
  ASSERT_EQ(report.examples.size(), 16u);
  for (size_t i = 1; i < report.examples.size(); ++i)
    EXPECT_LE(glm::distance(report.examples[i - 1].eye, report.examples[i - 1].hit),
              glm::distance(report.examples[i].eye, report.examples[i].hit));
}

}  // namespace
}  // namespace veduta
