// Names in a chart, and its axes.
#include "sweep/labels.h"

#include <gtest/gtest.h>

#include <random>

#include "scene/markup.h"
#include "sweep/axis.h"

namespace veduta {
namespace {

TEST(Segment, Meets) {
  const Segment diagonal{0, 0, 10, 10};
  EXPECT_TRUE(diagonal.meets(Segment{0, 10, 10, 0}));
  EXPECT_FALSE(diagonal.meets(Segment{0, 10, 4, 6}));
  EXPECT_FALSE(diagonal.meets(Segment{11, 11, 20, 20}));  // in line, beyond
  EXPECT_TRUE(diagonal.meets(Rectangle{2, 2, 1, 1}));
  EXPECT_TRUE((Segment{2.2, 2.2, 2.4, 2.3}.meets(Rectangle{2, 2, 1, 1})));  // inside
  EXPECT_FALSE(diagonal.meets(Rectangle{5, 0, 4, 4}));
}

/// Whatever the crowd: no name on another, on a point, or outside.
TEST(PlaceLabels, NoneCoversAnything) {
  std::mt19937 random(5);
  const Rectangle room{60, 60, 1000, 400};
  for (int round = 0; round < 20; ++round) {
    std::vector<LabelWish> wishes;
    const double spread = round % 2 ? 30 : 300;  // half of them in a heap
    for (int i = 0; i < 25; ++i) {
      const auto share = [&] { return std::uniform_real_distribution<double>(-1, 1)(random); };
      wishes.push_back(
          {560 + 1.5 * spread * share(), 260 + 0.6 * spread * share(), 60 + 50 * (share() + 1), 14, i < 4});
    }
    const std::vector<PlacedLabel> labels = place_labels(wishes, room, {{60, 260, 1060, 260}});
    size_t shown = 0;
    for (size_t i = 0; i < labels.size(); ++i) {
      if (!labels[i].shown) continue;
      ++shown;
      EXPECT_TRUE(room.holds(labels[i].box));
      for (size_t k = 0; k < labels.size(); ++k) {
        EXPECT_FALSE(labels[i].box.meets({wishes[k].x - 5, wishes[k].y - 5, 10, 10}));
        if (k == i || !labels[k].shown) continue;
        EXPECT_FALSE(labels[i].box.meets(labels[k].box)) << round << ": " << i << ", " << k;
        EXPECT_FALSE(labels[k].led && labels[k].leader.meets(labels[i].box))
            << round << ": " << i << ", " << k;
      }
    }
    EXPECT_GE(shown, round % 2 ? 15u : 24u) << round;
  }
}

TEST(PlaceLabels, WhereThereIsRoomBesideThePoint) {
  const std::vector<PlacedLabel> labels =
      place_labels({{100, 100, 50, 14, false}, {300, 100, 0, 0, false}}, {0, 0, 400, 200}, {});
  ASSERT_TRUE(labels[0].shown);
  EXPECT_FALSE(labels[0].led);
  EXPECT_GT(labels[0].box.x, 100);
  EXPECT_FALSE(labels[1].shown);  // wants none
  EXPECT_FALSE(place_labels({{100, 100, 500, 14, true}}, {0, 0, 400, 200}, {})[0].shown);
}

TEST(Axis, HoldsItsValuesAndHasRoundTicks) {
  for (const double low : {1e-7, 0.02, 1.0, 37.0, 5e6})
    for (const double ratio : {1.0, 1.001, 1.3, 7.0, 1e3, 1e9})
      for (const bool logarithmic : {false, true}) {
        SCOPED_TRACE(testing::Message() << low << " x " << ratio << (logarithmic ? " log" : ""));
        const std::vector<double> values{low * ratio, low};
        const Axis axis = logarithmic ? log_axis(values, 500, 100) : linear_axis(values, 0, 500, 100);
        EXPECT_LE(axis.at(low), 500);
        EXPECT_GE(axis.at(low * ratio), 100);
        EXPECT_NEAR(axis.at(axis.low), 500, 1e-6);
        EXPECT_NEAR(axis.at(axis.high), 100, 1e-6);
        const std::vector<double> ticks = axis.ticks();
        EXPECT_GE(ticks.size(), 4u);
        EXPECT_LE(ticks.size(), 12u);
        EXPECT_TRUE(std::is_sorted(ticks.begin(), ticks.end()));
        for (const double tick : ticks)
          EXPECT_TRUE(tick >= axis.low * 0.999 - 1e-9 && tick <= axis.high * 1.001);
      }
}

TEST(Figure, ThreeDigitsThatCount) {
  EXPECT_EQ(figure(0), "0");
  EXPECT_EQ(figure(1.526), "1.53");
  EXPECT_EQ(figure(9.996), "10.0");
  EXPECT_EQ(figure(99.96), "100");
  EXPECT_EQ(figure(1640.4), "1,640");
  EXPECT_EQ(figure(1234567), "1,234,567");
  EXPECT_EQ(figure(0.01234), "0.0123");
  EXPECT_EQ(figure(3.214e-7), "3.21·10⁻⁷");
  EXPECT_EQ(figure(-2), "−2.00");
  EXPECT_EQ(round_figure(0.250), "0.25");
  EXPECT_EQ(round_figure(3), "3");
  EXPECT_EQ(round_figure(10), "10");
  EXPECT_EQ(round_figure(1000), "1,000");
  EXPECT_EQ(round_figure(2e-6), "2·10⁻⁶");
  EXPECT_EQ(count(999), "999");
  EXPECT_EQ(count(1'000'000), "1,000,000");
  EXPECT_EQ(escaped("<a b='&\"'>\n"), "&lt;a b=&#39;&amp;&quot;&#39;&gt;?");
}

}  // namespace
}  // namespace veduta
