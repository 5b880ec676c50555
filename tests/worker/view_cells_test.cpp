#include "worker/view_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "tests/worker/mesh.h"
#include "worker/free_space.h"

namespace veduta {
namespace {

using test::Mesh;
using test::Random;

struct Prepared {
  explicit Prepared(const Scene& scene, double size_m = 0.25)
      : seeds(seed_test(scene, make_frame(scene.bounds(), size_m))), free(flood_fill(seeds.occupied)) {}
  SeedGrid seeds;
  BitGrid free;
};

bool in_a_cell(const std::vector<Box>& cells, const glm::vec3& p) {
  return std::any_of(cells.begin(), cells.end(), [&](const Box& cell) { return cell.contains(p); });
}

/// Calls visit(eye point) for the middle of every free voxel in the eye band over the ground.
template <typename Visit>
void each_eye(const Prepared& p, const WalkCells& options, Visit visit) {
  const GridFrame& f = p.free.frame();
  test::each_voxel(f, [&](int i, int j, int k) {
    const float ground = p.seeds.ground[static_cast<size_t>(j) * f.nx + i];
    const double z = f.z(k) + 0.5 * f.size_m, height = z - ground;
    if (!p.free.get(i, j, k) || !(std::abs(height - options.eye_height_m) <= options.eye_slack_m)) return;
    visit(glm::vec3(f.x(i) + 0.5 * f.size_m, f.y(j) + 0.5 * f.size_m, z));
  });
}

TEST(HilbertIndex, VisitsEveryPointOnceAndStepsToANeighbour) {
  for (const uint32_t order : {1u, 2u, 3u, 4u, 6u}) {
    const uint32_t edge = 1u << order;
    std::vector<std::pair<int, int>> place(size_t{edge} * edge, {-1, -1});
    for (uint32_t y = 0; y < edge; ++y) {
      for (uint32_t x = 0; x < edge; ++x) {
        const uint64_t index = hilbert_index(order, x, y);
        ASSERT_LT(index, place.size());
        ASSERT_EQ(place[index].first, -1) << "met twice";
        place[index] = {static_cast<int>(x), static_cast<int>(y)};
      }
    }
    for (size_t n = 1; n < place.size(); ++n) {
      const auto [x0, y0] = place[n - 1];
      const auto [x1, y1] = place[n];
      ASSERT_EQ(std::abs(x1 - x0) + std::abs(y1 - y0), 1) << "order " << order << ", step " << n;
    }
  }
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
    const Prepared p(mesh.scene, size);
    const WalkCells options;
    const std::vector<Box> cells = walk_cells(p.seeds, p.free, options);
    int eyes = 0;
    each_eye(p, options, [&](const glm::vec3& eye) {
      ++eyes;
      ASSERT_TRUE(in_a_cell(cells, eye)) << eye.x << ' ' << eye.y << ' ' << eye.z;
    });
    EXPECT_GT(eyes, 1000);
    for (const Box& cell : cells) {
      EXPECT_FLOAT_EQ(cell.upper.x - cell.lower.x, 10);
      EXPECT_FLOAT_EQ(cell.upper.y - cell.lower.y, 10);
      EXPECT_NEAR(cell.upper.z - cell.lower.z, 1, 1e-5);
      EXPECT_LE(cell.lower.z, 0.6f + 1.45f);
      EXPECT_GE(cell.upper.z, 0.6f + 1.95f);
    }
  }
}

TEST(WalkCells, NoneInsideASolidBuilding) {
  Mesh mesh;
  mesh.ground(-20, -20, 60, 60, 0);
  mesh.object();
  mesh.box({{-1, -1, 0}, {31, 31, 12}});
  const Prepared p(mesh.scene);
  const std::vector<Box> cells = walk_cells(p.seeds, p.free, {});
  EXPECT_FALSE(cells.empty());
  for (const Box& cell : cells) {
    const bool inside = cell.lower.x >= 0 && cell.upper.x <= 30 && cell.lower.y >= 0 && cell.upper.y <= 30;
    EXPECT_FALSE(inside) << cell.lower.x << ' ' << cell.lower.y;
  }
  EXPECT_FALSE(in_a_cell(cells, {15, 15, 1.7f}));
  EXPECT_TRUE(in_a_cell(cells, {-5, 15, 1.7f}));
}

TEST(WalkCells, StackOverASlope) {
  Mesh mesh;
  mesh.object(Kind::terrain);
  mesh.quad({0, 0, 0}, {40, 0, 20}, {40, 40, 20}, {0, 40, 0});  // rises 5 m in a cell
  mesh.object();
  mesh.box({{0, 0, -1}, {40, 40, -0.5f}});  // so that the grid has something below
  const Prepared p(mesh.scene);
  const WalkCells options;
  const std::vector<Box> cells = walk_cells(p.seeds, p.free, options);
  int eyes = 0;
  each_eye(p, options, [&](const glm::vec3& eye) {
    if (eye.x < 0 || eye.y < 0 || eye.x > 40 || eye.y > 40) return;
    ++eyes;
    ASSERT_TRUE(in_a_cell(cells, eye)) << eye.x << ' ' << eye.y << ' ' << eye.z;
  });
  EXPECT_GT(eyes, 1000);
  size_t in_square = 0;
  for (size_t c = 0; c < cells.size(); ++c) {
    if (cells[c].lower.x == 10 && cells[c].lower.y == 10) {
      ++in_square;
      if (c > 0 && cells[c - 1].lower.x == 10 && cells[c - 1].lower.y == 10) {
        EXPECT_NEAR(cells[c].lower.z, cells[c - 1].upper.z, 1e-4) << "upwards, without a gap";
      }
    }
  }
  EXPECT_GE(in_square, 5u);
  EXPECT_LE(in_square, 7u);
}

TEST(WalkCells, AreMadeWhereTheirCentreLiesInTheRegion) {
  Mesh mesh;
  mesh.ground(-50, -50, 50, 50, 0);
  const Prepared p(mesh.scene, 0.5);
  WalkCells options;
  options.region = {{-6, 14, 16, 36}};
  const std::vector<Box> cells = walk_cells(p.seeds, p.free, options);
  EXPECT_EQ(cells.size(), 3u * 3u);  // centres at x -5, 5, 15 and y 15, 25, 35
  for (const Box& cell : cells) {
    const glm::vec3 c = cell.center();
    EXPECT_TRUE(c.x >= -6 && c.x <= 16 && c.y >= 14 && c.y <= 36) << c.x << ' ' << c.y;
  }
  options.region = {{500, 500, 600, 600}};
  EXPECT_TRUE(walk_cells(p.seeds, p.free, options).empty());
}

TEST(WalkCells, FollowTheHilbertCurve) {
  Mesh mesh;
  mesh.ground(1, 1, 159, 159, 0);
  const Prepared p(mesh.scene, 0.5);
  WalkCells options;
  options.region = {{0, 0, 160, 160}};  // 16 x 16 squares
  const std::vector<Box> cells = walk_cells(p.seeds, p.free, options);
  ASSERT_EQ(cells.size(), 256u);
  int far = 0;
  for (size_t c = 1; c < cells.size(); ++c) {
    const glm::vec3 step = cells[c].lower - cells[c - 1].lower;
    far += std::abs(step.x) + std::abs(step.y) > 10.5f;
  }
  // The curve's square begins a cell outside of the region, so it leaves and comes back at times; row by row
  // would jump too, but 150 m at a time.
  EXPECT_LT(far, 64);
}

TEST(GroundHeights, KeepTheHighestGroundOfASquare) {
  Mesh mesh;
  mesh.object(Kind::terrain);
  mesh.quad({0, 0, 0}, {8, 0, 4}, {8, 6, 4}, {0, 6, 0});
  const Prepared p(mesh.scene);
  const HeightField field = ground_heights(p.seeds, 1.0);
  EXPECT_FLOAT_EQ(field.step_m, 1);
  const GridFrame& f = p.free.frame();
  for (uint32_t j = 0; j < field.ny; ++j) {
    for (uint32_t i = 0; i < field.nx; ++i) {
      float expected = std::nanf("");
      for (int b = static_cast<int>(4 * j); b < std::min(static_cast<int>(4 * j + 4), f.ny); ++b) {
        for (int a = static_cast<int>(4 * i); a < std::min(static_cast<int>(4 * i + 4), f.nx); ++a)
          expected = std::fmax(expected, p.seeds.ground[static_cast<size_t>(b) * f.nx + a]);
      }
      const float x = field.lower_x + static_cast<float>(i) + 0.5f,
                  y = field.lower_y + static_cast<float>(j) + 0.5f;
      const float height = field.at(x, y);
      ASSERT_TRUE(height == expected || (std::isnan(height) && std::isnan(expected))) << x << ' ' << y;
    }
  }
  EXPECT_NEAR(field.at(4.2f, 3), 0.5f * (std::ceil((4.2f - field.lower_x)) + field.lower_x), 0.13f);
}

}  // namespace
}  // namespace veduta
