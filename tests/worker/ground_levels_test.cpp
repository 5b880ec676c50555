#include "worker/ground_levels.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/worker/mesh.h"

namespace veduta {
namespace {

using test::Mesh;
using test::Random;

struct Levels {
  explicit Levels(const Scene& scene, std::optional<float> level_m = {})
      : frame(make_frame(scene.bounds(), 0.25)),
        levels(ground_levels(all_triangles(scene), frame, 1.7, level_m)) {}
  std::vector<float> at(double x, double y) const {
    const auto here = levels.at(static_cast<size_t>(frame.column_y(y)) * frame.nx + frame.column_x(x));
    return {here.begin(), here.end()};
  }
  GridFrame frame;
  GroundLevels levels;
};

TEST(GroundLevels, StreetsAndTheDecksAboveThem) {
  Mesh mesh;
  mesh.ground(0, 0, 40, 40, 0);
  mesh.object(Kind::bridge);
  mesh.box({{10, 0, 5}, {20, 40, 6}});
  mesh.object(Kind::road);
  mesh.quad({12, 0, 6.1f}, {18, 0, 6.1f}, {18, 40, 6.1f}, {12, 40, 6.1f});
  mesh.object(Kind::building);
  mesh.box({{30, 0, 0}, {40, 40, 9}});
  const Levels levels(mesh.scene);
  EXPECT_EQ(levels.at(5, 5), (std::vector<float>{0}));
  EXPECT_EQ(levels.at(11, 5), (std::vector<float>{0, 6}));
  EXPECT_EQ(levels.at(15, 5), (std::vector<float>{0, 6.1f})) << "a road lies on its deck";
  EXPECT_EQ(levels.at(35, 5), (std::vector<float>{0})) << "a roof is no ground";
}

TEST(GroundLevels, NoneWithoutHeadroom) {
  Mesh mesh;
  mesh.ground(0, 0, 20, 20, 0);
  mesh.object(Kind::bridge);
  mesh.quad({0, 0, 1.5f}, {10, 0, 1.5f}, {10, 20, 1.5f}, {0, 20, 1.5f});  // not closed, and turned downwards
  std::swap(mesh.scene.triangles[2].y, mesh.scene.triangles[2].z);
  const Levels levels(mesh.scene);
  EXPECT_EQ(levels.at(5, 5), (std::vector<float>{1.5f}));
  EXPECT_EQ(levels.at(15, 5), (std::vector<float>{0}));
}

TEST(GroundLevels, LevelGroundIsEverywhere) {
  Mesh mesh;
  mesh.object();
  mesh.box({{0, 0, -1}, {5, 5, 8}});
  EXPECT_TRUE(Levels(mesh.scene).levels.height.empty());
  const Levels levels(mesh.scene, -1.0f);
  EXPECT_EQ(levels.levels.height.size(), static_cast<size_t>(levels.frame.nx) * levels.frame.ny);
  EXPECT_EQ(levels.at(2, 2), (std::vector<float>{-1}));
}

TEST(GroundLevels, AreTheHighestPointOfASlopeInAColumn) {
  Mesh mesh;
  mesh.object(Kind::terrain);
  mesh.quad({0, 0, 0}, {8, 0, 4}, {8, 6, 4}, {0, 6, 0});
  const Levels levels(mesh.scene);
  const GridFrame& f = levels.frame;
  for (const double x : {0.6, 3.3, 7.4})
    EXPECT_EQ(levels.at(x, 3), (std::vector<float>{static_cast<float>(0.5 * f.x(f.column_x(x) + 1))})) << x;
}

TEST(GroundLevels, DoNotDependOnTheOrderOfTriangles) {
  Random random(9);
  Mesh mesh;
  mesh.object(Kind::bridge);
  for (int t = 0; t < 60; ++t) {
    const Box box{{0, 0, 0}, {6, 6, 9}};
    mesh.triangle(random.point(box), random.point(box), random.point(box));
  }
  std::vector<PlacedTriangle> triangles = all_triangles(mesh.scene);
  const GridFrame frame = make_frame(mesh.scene.bounds(), 0.25);
  const GroundLevels once = ground_levels(triangles, frame, 1.7, {});
  std::reverse(triangles.begin(), triangles.end());
  const GroundLevels again = ground_levels(triangles, frame, 1.7, {});
  EXPECT_EQ(once.begin, again.begin);
  EXPECT_EQ(once.height, again.height);
  size_t several = 0;
  for (size_t c = 0; c + 1 < once.begin.size(); ++c) {
    const auto here = once.at(c);
    several += here.size() > 1;
    for (size_t n = 1; n < here.size(); ++n) ASSERT_GE(here[n] - here[n - 1], 1.69f);
  }
  EXPECT_GT(several, 20u);
}

}  // namespace
}  // namespace veduta
