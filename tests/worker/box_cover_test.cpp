#include "worker/box_cover.h"

#include <gtest/gtest.h>

#include <tuple>

#include "tests/worker/block_grids.h"

namespace veduta {
namespace {

using test::Random;
using test::voxels_of;
using test::window_sealed;

ColumnRange whole(const BitGrid& grid) {
  return {0, grid.frame().nx, 0, grid.frame().ny};
}

double share_covered(const BitGrid& grid, const std::vector<Box>& boxes) {
  return static_cast<double>(voxels_of(boxes, grid.frame()).count()) / static_cast<double>(grid.count());
}

TEST(BoxCover, CoversSetBitsAlone) {
  Random random(2);
  for (const auto& [nx, ny, nz] :
       {std::tuple{150, 140, 40}, {90, 280, 70}, {40, 40, 64}}) {  // across tiles and words
    const BitGrid grid = test::random_blocks(random, test::small_frame(nx, ny, nz));
    const std::vector<Box> boxes = cover_with_boxes(grid, whole(grid), 0);
    ASSERT_FALSE(boxes.empty());
    for (const Box& b : boxes) EXPECT_TRUE(window_sealed(grid, b.center(), b.half_extent()));
    EXPECT_EQ(cover_with_boxes(grid, whole(grid), 0), boxes) << "not repeatable";
    const double share = share_covered(grid, boxes);
    RecordProperty("share", std::to_string(share));
    EXPECT_GE(share, 0.8);
  }
}

TEST(BoxCover, PartsOfAGridCoverAsMuchAsTheWhole) {
  Random random(5);
  for (int round = 0; round < 4; ++round) {
    const GridFrame frame = test::small_frame(150, 130, 40);
    const BitGrid grid = test::random_blocks(random, frame);
    const int split_x = random.integer(20, 130), split_y = random.integer(20, 110);
    std::vector<Box> boxes;
    for (const ColumnRange& own : {ColumnRange{0, split_x, 0, split_y},
                                   {split_x, 150, 0, split_y},
                                   {0, split_x, split_y, 130},
                                   {split_x, 150, split_y, 130}}) {
      const Box columns = frame.box(own.i0, own.i1 - 1, own.j0, own.j1 - 1, 0, frame.nz - 1);
      for (const Box& b : cover_with_boxes(grid, own, 0)) {
        EXPECT_TRUE(window_sealed(grid, b.center(), b.half_extent()));
        EXPECT_TRUE(b.lower.x < columns.upper.x && b.upper.x > columns.lower.x &&
                    b.lower.y < columns.upper.y && b.upper.y > columns.lower.y)
            << "a box that none of the part's own columns need";
        boxes.push_back(b);
      }
    }
    EXPECT_GE(share_covered(grid, boxes), share_covered(grid, cover_with_boxes(grid, whole(grid), 0)) - 0.02);
  }
}

TEST(BoxCover, LeavesOutWhatIsLowerThanEveryEye) {
  BitGrid grid(test::small_frame(60, 40, 40));
  test::set_block(grid, 5, 20, 5, 30, 5);    // 1.5 m high
  test::set_block(grid, 30, 50, 5, 30, 30);  // 7.75 m
  const std::vector<Box> boxes = cover_with_boxes(grid, whole(grid), 3.0);
  ASSERT_EQ(boxes.size(), 1u);
  EXPECT_EQ(boxes[0], grid.frame().box(30, 50, 5, 30, 0, 30));
  EXPECT_TRUE(cover_with_boxes(BitGrid(grid.frame()), whole(grid), 0).empty());
}

}  // namespace
}  // namespace veduta
