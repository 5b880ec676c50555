#include "viewer/draw_list.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/viewer/toy_city.h"

namespace veduta {
namespace {

class DrawListTest : public testing::Test {
 protected:
  toy::Street street_ = toy::make_street();
  const City& city_ = street_.file.city;
  IndexRanges ranges_{city_};
  DrawLister lister_{city_, ranges_};

  // The triangles behind a command, in the sequence in which they are drawn.
  std::vector<uint32_t> triangles(const DrawList& list) const {
    std::vector<uint32_t> all;
    const size_t per_order = city_.scene.triangles.size();
    for (const DrawCommand& command : list.commands)
      for (uint32_t e = command.first_index / 3; e < (command.first_index + command.count) / 3; ++e)
        all.push_back(ranges_.order(static_cast<Order>(e / per_order))[e % per_order]);
    return all;
  }
  uint64_t count(uint32_t object) const {
    return city_.scene.objects[object].triangle_end - city_.scene.objects[object].triangle_begin;
  }
};

TEST_F(DrawListTest, EverythingIsOneCommand) {
  const DrawList list = lister_.list({-1, true, {}}, nullptr);
  ASSERT_EQ(list.commands.size(), 1u);
  EXPECT_EQ(list.objects, 5u);
  EXPECT_EQ(list.triangles, city_.scene.triangles.size());
  EXPECT_EQ(list.commands[0].count, 3 * city_.scene.triangles.size());
}

TEST_F(DrawListTest, DrawsWhatTheRowSays) {
  const ActiveCells active{0, false, street_.file.entries};
  const DrawList list = lister_.list(active, nullptr);
  EXPECT_EQ(list.objects, 4u);
  std::vector<uint32_t> drawn = triangles(list), expected;
  std::sort(drawn.begin(), drawn.end());
  for (const PvsEntry& entry : street_.file.entries)
    for (uint64_t t = city_.scene.objects[entry.object].triangle_begin;
         t < city_.scene.objects[entry.object].triangle_end; ++t)
      if (draws(entry.index, city_.triangle_slices[t])) expected.push_back(static_cast<uint32_t>(t));
  EXPECT_EQ(drawn, expected);
  EXPECT_EQ(list.triangles, expected.size());
  EXPECT_EQ(list.triangles, city_.scene.triangles.size() - count(toy::Street::shed) - 8)
      << "less the tower's lowest floor";
}

TEST_F(DrawListTest, LeavesOutWhatIsBehindTheEye) {
  const Frustum ahead = single_location_frustum({{0, 0, 1.7f}, 0, 0}, {});
  const Frustum back = single_location_frustum({{0, 0, 1.7f}, 180, 0}, {});
  const ActiveCells all{-1, true, {}};
  EXPECT_EQ(lister_.list(all, &ahead).objects, 5u);
  EXPECT_EQ(lister_.list(all, &back).objects, 1u) << "only the ground is behind";
}

TEST_F(DrawListTest, AnObjectOfTwoRowsCountsOnce) {
  const ActiveCells two{0, false, {{toy::Street::tower, {0, 0, 5}}, {toy::Street::tower, {0, 0, 6}}}};
  EXPECT_EQ(lister_.list(two, nullptr).objects, 1u);
}

}  // namespace
}  // namespace veduta
