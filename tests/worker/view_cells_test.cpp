#include "worker/view_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "tests/worker/celled_city.h"

namespace veduta {
namespace {

using test::CelledCity;
using test::Mesh;
using test::Random;

/// Calls visit(eye point) for the middle of every free voxel at eye height over a height of level ground.
template <typename Visit>
void each_eye(const CelledCity& city, float ground, Visit visit) {
  const GridFrame& f = city.region.frame();
  test::each_voxel(f, [&](int i, int j, int k) {
    const glm::vec3 p(f.x(i) + 0.5 * f.size_m, f.y(j) + 0.5 * f.size_m, f.z(k) + 0.5 * f.size_m);
    const double off = p.z - ground - city.options.eye_height_m;
    if (city.region.free.get(i, j, k) && std::abs(off) <= city.options.eye_slack_m) visit(p);
  });
}

size_t cells_around(const CelledCity& city, float x, float y) {
  return static_cast<size_t>(std::count_if(city.cells.begin(), city.cells.end(), [&](const Box& c) {
    return c.lower.x <= x && x <= c.upper.x && c.lower.y <= y && y <= c.upper.y;
  }));
}

TEST(WalkCells, CoverEveryEyeOnFlatGround) {
  Random random(1);
  Mesh mesh;
  mesh.ground(-20, -13, 17, 22, 0.6f);
  for (int b = 0; b < 12; ++b) {
    const auto x = static_cast<float>(random.real(-18, 10)), y = static_cast<float>(random.real(-11, 15));
    mesh.object();
    mesh.box({{x, y, 0.6f}, {x + 5, y + 4, static_cast<float>(random.real(1, 9))}});
  }
  for (const double size : {0.25, 0.3}) {  // 0.3: voxels lie across the edges of the squares
    const CelledCity city(mesh.scene, {}, size);
    int eyes = 0;
    each_eye(city, 0.6f, [&](const glm::vec3& eye) {
      if (eye.x < -20 || eye.x > 17 || eye.y < -13 || eye.y > 22) return;  // no ground
      ++eyes;
      ASSERT_TRUE(city.in_a_cell(eye)) << eye.x << ' ' << eye.y << ' ' << eye.z;
      ASSERT_TRUE(city.navigation.free.contains(eye)) << eye.x << ' ' << eye.y << ' ' << eye.z;
    });
    EXPECT_GT(eyes, 1000);
    for (const Box& cell : city.cells) {
      EXPECT_FLOAT_EQ(cell.upper.x - cell.lower.x, 10);
      EXPECT_FLOAT_EQ(cell.upper.y - cell.lower.y, 10);
      EXPECT_NEAR(cell.upper.z - cell.lower.z, 1, 1e-5);
      EXPECT_LE(cell.lower.z, 0.6f + 1.45f);
      EXPECT_GE(cell.upper.z, 0.6f + 1.95f);
    }
  }
}

TEST(WalkCells, NoneInsideASolidBuildingNorOnIt) {
  Mesh mesh;
  mesh.ground(-20, -20, 60, 60, 0);
  mesh.object();
  mesh.box({{-1, -1, 0}, {31, 31, 12}});
  const CelledCity city(mesh.scene, {});
  EXPECT_EQ(cells_around(city, 15, 15), 0u);
  EXPECT_TRUE(city.in_a_cell({-5, 15, 1.7f}));
  EXPECT_FALSE(city.in_a_cell({15, 15, 13.7f}));
}

TEST(WalkCells, InCourtyardsAndArcades) {
  Mesh mesh;
  mesh.ground(-20, -20, 60, 60, 0);
  mesh.object();  // four wings around a courtyard of 10 m
  for (const Box& wing : {Box{{0, 0, 0}, {30, 10, 12}}, Box{{0, 20, 0}, {30, 30, 12}},
                          Box{{0, 10, 0}, {10, 20, 12}}, Box{{20, 10, 0}, {30, 20, 12}}})
    mesh.box(wing);
  mesh.object();  // an arcade: a storey on pillars
  mesh.box({{40, 0, 4}, {50, 30, 12}});
  for (float y = 0; y < 30; y += 5) mesh.box({{40, y, 0}, {40.5f, y + 0.5f, 4}});
  const CelledCity city(mesh.scene, {});
  EXPECT_EQ(cells_around(city, 15, 15), 1u);
  EXPECT_TRUE(city.in_a_cell({15, 15, 1.7f}));
  EXPECT_TRUE(city.navigation.free.contains({15, 15, 1.7f}));
  EXPECT_EQ(cells_around(city, 5, 5), 0u);
  EXPECT_EQ(cells_around(city, 45, 15), 1u) << "under the storey, not on it";
  EXPECT_TRUE(city.navigation.free.contains({45, 15, 1.7f}));
  EXPECT_FALSE(city.navigation.free.contains({45, 15, 13.7f}));
}

TEST(WalkCells, OnABridgeAndUnderIt) {
  Mesh mesh;
  mesh.ground(-20, -20, 40, 40, 0);
  mesh.object(Kind::bridge);
  mesh.box({{0.5f, -20, 5}, {9.5f, 40, 6}});
  const CelledCity city(mesh.scene, {});
  ASSERT_EQ(cells_around(city, 5, 5), 2u);
  EXPECT_TRUE(city.in_a_cell({5, 5, 1.7f}));
  EXPECT_TRUE(city.in_a_cell({5, 5, 7.7f}));
  EXPECT_FALSE(city.in_a_cell({5, 5, 4.5f})) << "nothing in between";
  EXPECT_TRUE(city.navigation.free.contains({5, 5, 1.7f}));
  EXPECT_TRUE(city.navigation.free.contains({5, 5, 7.7f}));
  EXPECT_EQ(cells_around(city, 15, 5), 1u);
  EXPECT_EQ(city.navigation.ground.at(5, 5), 6) << "the highest";
  EXPECT_EQ(city.navigation.ground.at(15, 5), 0);
}

TEST(WalkCells, InATunnelUnlessItIsNarrowerThanASeed) {
  for (const float width : {0.05f, 3.0f}) {  // of seeds of 0.0625 m
    Mesh mesh;
    mesh.ground(-20, -20, 40, 50, 0);
    mesh.object();  // two houses with a gap, and a storey over it
    mesh.box({{-10, 0, 0}, {5 - width / 2, 30, 4}});
    mesh.box({{5 + width / 2, 0, 0}, {20, 30, 4}});
    mesh.box({{-10, 0, 4}, {20, 30, 12}});
    const CelledCity city(mesh.scene, {});
    EXPECT_EQ(cells_around(city, 5, 15), width > 1 ? 1u : 0u) << width;
    EXPECT_EQ(city.navigation.free.contains({5, 15, 1.7f}), width > 1) << width;
  }
}

TEST(WalkCells, StackOverASlope) {
  Mesh mesh;
  mesh.object(Kind::terrain);
  mesh.quad({0, 0, 0}, {40, 0, 20}, {40, 40, 20}, {0, 40, 0});  // rises 5 m in a cell
  mesh.object();
  mesh.box({{0, 0, -1}, {40, 40, -0.5f}});  // so that the grid has something below
  const CelledCity city(mesh.scene, {});
  for (float x = 0.5f; x < 39.5f; x += 0.25f) EXPECT_TRUE(city.in_a_cell({x, 12, 0.5f * x + 1.7f})) << x;
  size_t in_square = 0;
  for (size_t c = 0; c < city.cells.size(); ++c) {
    if (city.cells[c].lower.x == 10 && city.cells[c].lower.y == 10) {
      ++in_square;
      if (c > 0 && city.cells[c - 1].lower.x == 10 && city.cells[c - 1].lower.y == 10) {
        EXPECT_NEAR(city.cells[c].lower.z, city.cells[c - 1].upper.z, 1e-4) << "upwards, without a gap";
      }
    }
  }
  EXPECT_GE(in_square, 5u);
  EXPECT_LE(in_square, 7u);
}

TEST(WalkCells, OnLevelGroundWhereThereIsNone) {
  Mesh mesh;
  mesh.object();
  mesh.box({{0, 0, 2}, {35, 5, 9}});
  EXPECT_TRUE(CelledCity(mesh.scene, {}).cells.empty());
  const CelledCity city(mesh.scene, {}, 0.25, true);
  EXPECT_FALSE(city.cells.empty());
  for (const Box& cell : city.cells) EXPECT_TRUE(cell.lower.z <= 3.7f && cell.upper.z >= 3.7f);
}

TEST(WalkCells, AreMadeWhereTheirCentreLiesInTheRegion) {
  Mesh mesh;
  mesh.ground(-50, -50, 50, 50, 0);
  CellOptions options;
  options.region = {{-6, 14}, {16, 14}, {16, 36}, {-6, 36}};
  const CelledCity city(mesh.scene, options, 0.5);
  EXPECT_EQ(city.cells.size(), 3u * 3u);  // centres at x -5, 5, 15 and y 15, 25, 35
  options.region = {{-50, -50}, {50, -50}, {-50, 50}};
  const CelledCity triangle(mesh.scene, options, 0.5);
  EXPECT_EQ(triangle.cells.size(), 10u * 11u / 2u);
  for (const Box& cell : triangle.cells) EXPECT_LE(cell.center().x + cell.center().y, 0);
  options.region = {{500, 500}, {600, 500}, {600, 600}};
  EXPECT_TRUE(CelledCity(mesh.scene, options, 0.5).cells.empty());
}

TEST(WalkCells, FollowTheHilbertCurve) {
  Mesh mesh;
  mesh.ground(1, 1, 159, 159, 0);
  CellOptions options;
  options.region = {{0, 0}, {160, 0}, {160, 160}, {0, 160}};  // 16 x 16 squares
  const CelledCity city(mesh.scene, options, 0.5);
  ASSERT_EQ(city.cells.size(), 256u);
  int far = 0;
  for (size_t c = 1; c < city.cells.size(); ++c) {
    const glm::vec3 step = city.cells[c].lower - city.cells[c - 1].lower;
    far += std::abs(step.x) + std::abs(step.y) > 10.5f;
  }
  // The curve's square begins a cell outside of the region, so it leaves and comes back at times; row by row
  // would jump too, but 150 m at a time.
  EXPECT_LT(far, 64);
}

/// Flying over a level city with a tower.
CelledCity flight(double lowest_m, double highest_m, int largest) {
  Mesh mesh;
  mesh.ground(0, 0, 80, 80, 0);
  mesh.object();
  mesh.box({{29, 29, 0}, {51, 51, 21}});
  CellOptions options;
  options.fly = true, options.height_m = 10;
  options.fly_lowest_m = lowest_m, options.fly_highest_m = highest_m, options.largest = largest;
  options.region = {{0, 0}, {80, 0}, {80, 80}, {0, 80}};
  return CelledCity(mesh.scene, options, 0.5);
}

TEST(FlyCells, AreTheBoxesOfTheLatticeThatAreNotTaken) {
  const CelledCity city = flight(0, 40, 1);
  EXPECT_EQ(city.cells.size(), 8u * 8u * 4u - 2u * 2u * 2u) << "the tower takes 2 x 2 squares, two layers";
  EXPECT_FALSE(city.in_a_cell({45, 45, 15}));
  EXPECT_TRUE(city.in_a_cell({45, 45, 25})) << "partly taken";
  EXPECT_TRUE(city.navigation.free.contains({45, 45, 25}));
  EXPECT_FALSE(city.navigation.free.contains({45, 45, 20.5f}));
  EXPECT_TRUE(city.navigation.free.contains({5, 5, 39})) << "above the grid";
  EXPECT_FALSE(city.navigation.free.contains({5, 5, 41}));
  EXPECT_EQ(flight(10, 30, 1).cells.size(), 8u * 8u * 2u - 2u * 2u);
}

TEST(FlyCells, AreLargerInOpenSpace) {
  const CelledCity city = flight(0, 40, 4);
  std::array<size_t, 3> of_edge{};
  double volume = 0;
  for (const Box& cell : city.cells) {
    const glm::vec3 edge = cell.upper - cell.lower;
    EXPECT_EQ(edge.x, edge.y);
    EXPECT_EQ(edge.x, edge.z);
    ++of_edge[edge.x == 10 ? 0 : edge.x == 20 ? 1 : 2];
    volume += static_cast<double>(edge.x) * edge.y * edge.z;
    for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(std::fmod(cell.lower[axis], edge[axis]), 0.0f);
    if (edge.x == 10) continue;
    EXPECT_GT(cell.lower.z, 0) << "the ground is in the lowest layer";
  }
  EXPECT_EQ(volume, 1000.0 * (8 * 8 * 4 - 2 * 2 * 2));
  // The lowest layer has 64 - 4 cells of 10 m. Blocks of 20 m at z 20 to 40 are free but for the tower's.
  EXPECT_EQ(of_edge[2], 0u);
  EXPECT_GE(of_edge[1], 12u);
  const CelledCity higher = flight(0, 80, 4);
  EXPECT_TRUE(std::any_of(higher.cells.begin(), higher.cells.end(), [](const Box& cell) {
    return cell.upper.x - cell.lower.x == 40 && cell.lower.z == 40;
  }));
}

TEST(FlyCells, GoOnOverAHouseInAHoleOfTheTerrain) {
  Mesh mesh;
  for (const auto& [x0, y0, x1, y1] :
       {std::array<float, 4>{0, 0, 60, 15}, {0, 45, 60, 60}, {0, 15, 15, 45}, {45, 15, 60, 45}})
    mesh.ground(x0, y0, x1, y1, 100);
  mesh.object();
  mesh.box({{15, 15, 99}, {45, 45, 108}});
  CellOptions options;
  options.fly = true, options.height_m = 10, options.fly_highest_m = 30;
  const CelledCity city(mesh.scene, options, 0.5);
  EXPECT_TRUE(city.in_a_cell({30, 30, 120}));
  EXPECT_FALSE(city.in_a_cell({30, 30, 141}));
}

}  // namespace
}  // namespace veduta
