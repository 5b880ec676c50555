// Boxes, lines and the map.
#include <algorithm>
#include <cstdlib>
#include <glm/common.hpp>
#include <vector>

#include "tests/viewer/painter_fixture.h"

namespace veduta {
namespace {

TEST_F(PainterTest, TheMapIsColouredByWhatIsVisible) {
  const auto on = painter();
  const Image image = map(*on, everything(), colours_);
  const Pixel house = on_map(image, 11, 8), wall = on_map(image, 20.5f, -20), tower = on_map(image, 46, -6),
              ground = on_map(image, -20, 0);
  EXPECT_TRUE(house[0] > 2 * house[1] && house[0] > 2 * house[2]) << "red";
  EXPECT_TRUE(wall[2] > 1.4 * wall[0] && wall[2] > 1.4 * wall[1]) << "blue";
  EXPECT_TRUE(tower[0] > 2 * tower[2] && tower[1] > 2 * tower[2]) << "yellow";
  EXPECT_LT(*std::max_element(ground.begin(), ground.end()) - *std::min_element(ground.begin(), ground.end()),
            30)
      << "plain";
  std::vector<MapColour> hidden = colours_;
  hidden[Street::tower] = MapColour::hidden;
  EXPECT_EQ(on_map(map(*on, everything(), hidden), 46, -6), on_map(image, 46, 10))
      << "ground under the tower";
}

TEST_F(PainterTest, TheMapShowsBoxesOfWhatIsNotHere) {
  const auto on = painter();
  on->remove(Street::tower);
  const CommandList here = list({Street::ground, Street::house, Street::wall, Street::shed});
  const Pixel tower = on_map(map(*on, here, colours_), 46, -6);
  EXPECT_TRUE(tower[0] > 2 * tower[2] && tower[1] > 2 * tower[2]) << "yellow";
  places_[Street::tower] = *on->add(page(Street::tower));
  const Image back = map(*on, here, colours_);
  EXPECT_EQ(on_map(back, 46, -6), on_map(back, 46, 10)) << "it is here again, and not in the list";
  on->remove(Street::ground);
  const Image floating = map(*on, list({Street::house, Street::wall, Street::shed}), colours_);
  EXPECT_EQ(on_map(floating, 11, 8), on_map(back, 11, 8)) << "stands on the box of the ground";
  EXPECT_GT(on_map(floating, -20, 0)[0], 160) << "as bright as ground";
}

TEST_F(PainterTest, BoxesLieOverTheMap) {
  const auto on = painter();
  const ColouredBox cell{{{-5, -5, 1}, {5, 5, 2}}, {0, 1, 0, 1}, {0, 1, 0, 1}};
  const Image image = map(*on, everything(), colours_, {&cell, 1});
  EXPECT_EQ(on_map(image, 0, 0), (Pixel{0, 255, 0}));
  EXPECT_NE(on_map(image, 0, 8), (Pixel{0, 255, 0}));
}

TEST_F(PainterTest, TheMapIsTurned) {
  const auto on = painter();
  on->begin(one_eye(), width, height);
  on->draw_map({{0, 0, 0}, 100, 0}, everything(), colours_, {}, {}, {0, 0, width, height});  // east is up
  const Image image = picture(on->end());
  EXPECT_EQ(at(image, width / 2 + 32, height / 2 - 33), on_map(map(*on, everything(), colours_), 20.6f, -20));
}

TEST_F(PainterTest, TheMapKeepsToItsRectangle) {
  const auto on = painter();
  const Image without = mono(*on, everything());
  const CommandList all = everything();
  for (bool map_first : {true, false}) {
    on->begin(one_eye(), width, height);
    if (map_first) on->draw_map({}, all, colours_, {}, {}, {100, 10, 50, 40});
    on->draw_city({&all, 1});
    on->draw_sky();
    if (!map_first) on->draw_map({}, all, colours_, {}, {}, {100, 10, 50, 40});
    const Image with = picture(on->end());
    for (uint32_t y = 0; y < height; ++y)
      for (uint32_t x = 0; x < width; ++x)
        if (x < 98 || x >= 152 || height - 1 - y < 8 || height - 1 - y >= 52) {
          ASSERT_EQ(at(with, x, y), at(without, x, y)) << x << ", " << y;
        }
    EXPECT_NE(at(with, 120, height - 30), at(without, 120, height - 30));
  }
}

TEST_F(PainterTest, ABoxBehindTheCityIsFaint) {
  const auto on = painter();
  const CommandList all = everything();
  pose_.pitch_deg = 0;  // the middle of the picture is the wall, 20 m away
  const Image without = mono(*on, all);
  const auto with = [&](const Box& box) {
    const ColouredBox coloured{box, {0, 0, 0, 0}, {1, 0, 1, 1}};
    on->begin(one_eye(), width, height);
    on->draw_city({&all, 1});
    on->draw_sky();
    on->draw_boxes({&coloured, 1});
    return picture(on->end());
  };
  const auto change = [&](const Image& image, uint32_t x, uint32_t y) {
    int sum = 0;
    for (size_t k = 0; k < 3; ++k) sum += std::abs(at(image, x, y)[k] - at(without, x, y)[k]);
    return sum;
  };
  const Image before = with({{10, -1, 0.5f}, {12, 1, 2.5f}}), behind = with({{22, -2, 0.5f}, {24, 2, 2.5f}});
  EXPECT_EQ(at(before, width / 2, height / 2), (Pixel{255, 0, 255}));
  EXPECT_GT(change(behind, width / 2, height / 2), 20);
  EXPECT_LT(change(behind, width / 2, height / 2), change(before, width / 2, height / 2) / 2);
  EXPECT_EQ(change(before, 5, height / 2), 0);
}

class PainterLinesTest : public PainterTest {
 protected:
  /// A line seen from above all, looking east.
  Image line(Painter& on, const glm::vec3& from, const glm::vec3& to) {
    pose_ = {{0, 0, 50}, 0, 0};
    const ColouredLine line{from, to, {1, 0, 1, 1}};
    on.begin(one_eye(), width, height);
    on.draw_sky();
    on.draw_lines({&line, 1});
    return picture(on.end());
  }
  static bool drawn(const Image& image, uint32_t x, uint32_t y) { return at(image, x, y)[1] < 100; }
};

TEST_F(PainterLinesTest, LinesAreAsWideNearAsFar) {
  const auto on = painter();
  for (float distance_m : {1.0f, 10.0f, 1000.0f}) {
    const float y = 0.2f * distance_m;
    const Image image = line(*on, {distance_m, -y, 50}, {distance_m, y, 50});
    int rows = 0;
    for (uint32_t row = 0; row < height; ++row) rows += drawn(image, width / 2, row);
    EXPECT_GE(rows, 1) << distance_m;
    EXPECT_LE(rows, 3) << distance_m;
  }
}

TEST_F(PainterLinesTest, ALineIsCutWhereItPassesTheEye) {
  const auto on = painter();
  const glm::vec3 behind{-20, -1, 49}, ahead{50, 9, 48};
  const Image whole = line(*on, behind, ahead), before = line(*on, glm::mix(behind, ahead, 0.3f), ahead),
              turned = line(*on, ahead, behind), none = line(*on, behind, behind - ahead);
  int count = 0, other = 0;
  for (uint32_t y = 0; y < height; ++y)
    for (uint32_t x = 0; x < width; ++x) {
      count += drawn(whole, x, y);
      other += drawn(whole, x, y) != drawn(before, x, y) || drawn(whole, x, y) != drawn(turned, x, y);
      EXPECT_FALSE(drawn(none, x, y)) << "behind the eye";
    }
  EXPECT_GT(count, 30);
  EXPECT_LT(other, 6) << "the part before the eye is the same";
}

}  // namespace
}  // namespace veduta
