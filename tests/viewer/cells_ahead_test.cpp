#include "viewer/stream/cells_ahead.h"

#include <gtest/gtest.h>

#include "tests/viewer/memory_source.h"

namespace veduta {
namespace {

std::vector<uint32_t> numbers(const std::vector<CellAhead>& ahead) {
  std::vector<uint32_t> cells;
  for (const CellAhead& a : ahead) cells.push_back(a.cell);
  return cells;
}

/// 100 cells of 10 m along x.
PvsIndex street() {
  return toy::make_index(toy::long_street(100));
}

TEST(CellsAhead, WhoStandsMayStepIntoTheCellsBeside) {
  const std::vector<CellAhead> ahead = cells_ahead(street(), toy::standing_in(50), 48);
  EXPECT_EQ(numbers(ahead), (std::vector<uint32_t>{50, 49, 51}));
  EXPECT_EQ(ahead[0].in_s, 0);
  EXPECT_GT(ahead[1].in_s, 1);
}

TEST(CellsAhead, WhoRunsMeetsTheCellsOnHisWayInTheirOrder) {
  Gaze gaze = toy::standing_in(50);
  gaze.velocity_m_s = {20, 0, 0};
  const std::vector<CellAhead> ahead = cells_ahead(street(), gaze, 48);
  const std::vector<uint32_t> on_the_way{50, 51, 52, 53, 54, 55, 56};
  std::vector<uint32_t> seen;
  for (const CellAhead& a : ahead)
    if (a.cell >= 50) seen.push_back(a.cell);
  EXPECT_EQ(seen, on_the_way);
  EXPECT_LT(ahead[1].in_s, 0.5f);           // 5 m away
  EXPECT_NEAR(ahead[2].in_s, 0.75f, 0.3f);  // 15 m
}

TEST(CellsAhead, TheSoonestWhereThereAreTooMany) {
  Gaze gaze = toy::standing_in(50);
  gaze.velocity_m_s = {-20, 0, 0};
  EXPECT_EQ(numbers(cells_ahead(street(), gaze, 3)), (std::vector<uint32_t>{50, 49, 48}));
}

TEST(CellsAhead, FromOutsideTowardsCells) {
  Gaze gaze = toy::standing_in(50);
  gaze.position_m.y = -25;
  EXPECT_TRUE(cells_ahead(street(), gaze, 48).empty());
  gaze.velocity_m_s = {0, 10, 0};
  const std::vector<uint32_t> ahead = numbers(cells_ahead(street(), gaze, 48));
  ASSERT_FALSE(ahead.empty());
  EXPECT_EQ(ahead[0], 50u);
}

TEST(CellsAhead, AnEyeThatIsThrownFarAsksForLittle) {
  Gaze gaze = toy::standing_in(50);
  gaze.velocity_m_s = {1e9f, 0, 0};
  EXPECT_LE(cells_ahead(street(), gaze, 48).size(), 48u);
}

}  // namespace
}  // namespace veduta
