#include "viewer/tour.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/viewer/memory_source.h"

namespace veduta {
namespace {

std::vector<Pose> make_tour(const PvsFile& file, size_t frames) {
  const toy::MemorySource source(file);
  const auto row = [&](uint32_t cell) { return source.read_row(source.index().cell_row[cell]); };
  return make_tour(source.index(), row, frames);
}

TEST(Tour, LooksAtTheBuildings) {
  const PvsFile file = toy::make_street().file;
  const std::vector<Pose> tour = make_tour(file, 3);
  ASSERT_EQ(tour.size(), 1u) << "there is one cell";
  EXPECT_TRUE(file.city.cells[0].contains(tour[0].position_m));
  EXPECT_LT(std::abs(std::remainder(tour[0].yaw_deg, 360.0f)), 60) << "all buildings are along +x";
}

TEST(Tour, TakesDifferentCellsInTheirOrder) {
  PvsFile file = toy::make_street().file;
  for (int i = 1; i < 10; ++i) {
    const float x = -2.0f * static_cast<float>(i);
    file.city.cells.push_back({{x - 1, -1, 1.5f}, {x + 1, 1, 1.9f}});
    file.cell_row.push_back(0);
  }
  const std::vector<Pose> tour = make_tour(file, 6);
  ASSERT_EQ(tour.size(), 6u);
  for (size_t i = 1; i < tour.size(); ++i) EXPECT_LT(tour[i].position_m.x, tour[i - 1].position_m.x);
}

TEST(Tour, LooksAlongOpenSpace) {
  PvsFile file = toy::make_street().file;
  for (PvsEntry& entry : file.entries) entry.object = toy::Street::ground;  // no building decides
  // Free space: the half of a 64 m cube with y >= 0; the cell lies at its edge.
  file.city.navigation.free = {{-32, -32, -30}, 32, 1, {{0, 0, 0}}, {0b0101'0000'0101'0000}, {0}};
  ASSERT_TRUE(file.city.navigation.free.contains({0, 20, 1.7f}));
  ASSERT_FALSE(file.city.navigation.free.contains({0, -20, 1.7f}));
  const std::vector<Pose> tour = make_tour(file, 1);
  ASSERT_EQ(tour.size(), 1u);
  EXPECT_GT(std::sin(tour[0].yaw_deg * 3.14159265f / 180), -0.1f) << tour[0].yaw_deg;
}

TEST(Tour, NoCellsNoTour) {
  EXPECT_TRUE(make_tour(PvsFile{}, 4).empty());
}

}  // namespace
}  // namespace veduta
