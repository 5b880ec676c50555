// veduta sweep as a user runs it, on two blocks and what lies between them, with the real worker.
#include <gtest/gtest.h>

#include <algorithm>

#include "sweep/sweep.h"
#include "tests/farm/processes.h"
#include "tests/pvs/small_city.h"

namespace veduta {
namespace {

namespace fs = std::filesystem;

/// An object of a box at x, y.
std::string box(const std::string& name, double x, double y, double edge, double height, double depth = 0) {
  if (depth == 0) depth = edge;
  std::string text = "o " + name + "\n";
  for (const double z : {-0.5, height})
    for (const auto& [dx, dy] : {std::pair{0., 0.}, {edge, 0.}, {edge, depth}, {0., depth}})
      text += "v " + std::to_string(x + dx) + " " + std::to_string(y + dy) + " " + std::to_string(z) + "\n";
  return text + "f -8 -5 -6 -7\nf -4 -3 -2 -1\nf -8 -7 -3 -4\nf -7 -6 -2 -3\nf -6 -5 -1 -2\nf -5 -8 -4 -1\n";
}

class Sweep : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system(VEDUTA_WORKER_PROGRAM " --probe --gpu software > /dev/null 2>&1") != 0)
      GTEST_SKIP() << "no software OpenGL here";
    test::write_bytes(directory_ / "city.obj", box("ground", -40, -40, 80, 0) + box("a", 4, 4, 14, 9) +
                                                   box("b", -18, 4, 14, 9) + box("behind", 8, 24, 3, 3));
    write_config("");
    test::write_bytes(directory_ / "grid.toml",
                      "[[grid]]\nocclusion.max_overestimate = [1, 4]\n"
                      "[[grid]]\nocclusion.method = ['zoom']\nocclusion.subdivide = [1]\n"
                      "[[grid]]\nnavigation.seed_size = [1]\n");  // too coarse to stand anywhere
  }
  void write_config(const std::string& more, int resolution = 128, int subdivide = 2) {
    test::write_bytes(directory_ / "city.toml",
                      "[scene]\nmodel = 'city.obj'\n[navigation]\nseed_size = 0.25\n[cells]\nsize = 4.0\n"
                      "region = [-20, -20, 20, 0]\n[occlusion]\nresolution = " +
                          std::to_string(resolution) + "\nsubdivide = " + std::to_string(subdivide) + "\n" +
                          more);
  }
  int sweep(const std::string& more = "") {
    test::Process process(std::string(VEDUTA_PROGRAM) + " sweep " + (directory_ / "city.toml").string() +
                              " --grid " + (directory_ / "grid.toml").string() + " -o " + out().string() +
                              " --cells 4 --rays 20000 --gpu software " + more,
                          {}, directory_ / "said");
    const int status = process.wait();
    said_ = process.output();
    return status;
  }
  fs::path out() const { return directory_ / "out"; }
  SweepReport report() const { return sweep_from_json(test::slurp(out() / "sweep.json"), "sweep.json"); }
  static const SweepPoint& named(const SweepReport& report, const std::string& name) {
    for (const SweepPoint& point : report.points)
      if (point_name(point) == name) return point;
    throw std::out_of_range("no point " + name);
  }

  test::TemporaryDirectory directory_;
  std::string said_;
};

TEST_F(Sweep, FiguresPageAndRecommendation) {
  ASSERT_EQ(sweep("--recommend 100"), 0) << said_;
  const SweepReport found = report();
  ASSERT_EQ(found.points.size(), 5u) << said_;
  EXPECT_EQ(found.places.size(), 4u);
  int with_figures = 0;
  for (const SweepPoint& point : found.points) {
    SCOPED_TRACE(point_name(point));
    if (!point.failed.empty()) continue;
    ++with_figures;
    EXPECT_EQ(point.cells, 4u);
    EXPECT_GT(point.cell_ms, 0);
    EXPECT_GT(point.cell_core_ms, 0) << "software draws with the processor";
    EXPECT_GE(point.overestimate_objects, 1);
    EXPECT_GE(point.overestimate_triangles, point.tightest_triangles);
    EXPECT_GT(point.bytes_per_cell, 0);
    EXPECT_EQ(point.false_invisible_triangles, 0u);
    EXPECT_NE(point.renderer.find("llvmpipe"), std::string::npos) << point.renderer;
  }
  EXPECT_EQ(with_figures, 4) << said_;
  const SweepPoint& nobody = *std::find_if(found.points.begin(), found.points.end(),
                                           [](const SweepPoint& point) { return !point.failed.empty(); });
  EXPECT_EQ(point_name(nobody).rfind("seed_size", 0), 0u) << nobody.failed;
  // More is asked for, so no fewer objects are hidden; the lists are of the same cells.
  EXPECT_LE(named(found, "max_overestimate 1").overestimate_objects,
            named(found, "max_overestimate 4").overestimate_objects);

  EXPECT_NE(test::slurp(out() / "sweep.html").find("<svg"), std::string::npos);
  ASSERT_EQ(sweep(), 0) << said_;
  EXPECT_EQ(report().points.size(), 5u) << "what failed was tried again, and is there once";
  EXPECT_NE(test::slurp(out() / "buildings.svg").find("<svg"), std::string::npos);
  for (const auto& entry : fs::directory_iterator(out()))
    EXPECT_FALSE(entry.is_directory()) << "left behind: " << entry.path();

  // The recommendation can be baked as it is.
  ASSERT_TRUE(fs::exists(out() / "recommended.toml")) << said_;
  test::Process dry(std::string(VEDUTA_PROGRAM) + " bake --dry-run " + (out() / "recommended.toml").string() +
                        " --out " + (directory_ / "dry").string(),
                    {}, directory_ / "said");
  EXPECT_EQ(dry.wait(), 0) << dry.output();
}

TEST_F(Sweep, GoesOnAndIsNotMixedWithAnother) {
  test::write_bytes(directory_ / "grid.toml", "");
  ASSERT_EQ(sweep(), 0) << said_;
  const SweepPoint first = report().points.at(0);
  test::write_bytes(directory_ / "grid.toml", "[[grid]]\nocclusion.max_overestimate = [4]\n");
  ASSERT_EQ(sweep(), 0) << said_;
  ASSERT_EQ(report().points.size(), 2u);
  EXPECT_EQ(report().points[0].cell_ms, first.cell_ms) << "not measured again";
  EXPECT_EQ(sweep("--seed 2"), 4) << said_;
  EXPECT_EQ(report().points.size(), 2u) << "nothing is lost";
  EXPECT_EQ(sweep("--seed 2 --fresh"), 0) << said_;
  write_config("[slices]\nmax = 2\n");
  EXPECT_EQ(sweep("--seed 2"), 4) << said_;
  EXPECT_NE(said_.find("configuration"), std::string::npos) << said_;
}

TEST_F(Sweep, NothingWithinTheBoundIsSaid) {
  test::write_bytes(directory_ / "grid.toml", "");
  // A wall thinner than the cells leaves no occluder for them.
  test::write_bytes(directory_ / "city.obj", box("ground", -40, -40, 80, 0) + box("wall", -39, 4, 78, 9, 1) +
                                                 box("behind", 0, 8, 3, 3));
  write_config("max_overestimate = 100\n", 64, 1);
  ASSERT_EQ(sweep(), 0) << said_;
  ASSERT_GT(report().points.at(0).overestimate_buildings, 1);
  EXPECT_EQ(sweep("--recommend 1"), 1) << said_;
  EXPECT_NE(said_.find("no point"), std::string::npos) << said_;
}

TEST_F(Sweep, BadInput) {
  test::write_bytes(directory_ / "grid.toml", "[[grid]]\nocclusion.colour = [1]\n");
  EXPECT_EQ(sweep(), 2) << said_;
  test::write_bytes(directory_ / "grid.toml", "");
  fs::create_directories(out());
  test::write_bytes(out() / "sweep.json", "{\"format\": \"veduta-sw");
  EXPECT_EQ(sweep(), 65) << said_;
  EXPECT_EQ(std::count(said_.begin(), said_.end(), '\n'), 1) << said_;
  EXPECT_EQ(test::slurp(out() / "sweep.json"), "{\"format\": \"veduta-sw") << "left as it was";
}

}  // namespace
}  // namespace veduta
