#include "worker/face_panes.h"

#include <gtest/gtest.h>

#include "tests/worker/mesh.h"

namespace veduta {
namespace {

constexpr float near_m = 0.05f;

Box random_box(test::Random& random) {
  const glm::vec3 middle(random.real(-60, 60), random.real(-60, 60), random.real(-10, 20));
  const glm::vec3 half(random.real(0, 4), random.real(0, 4), random.real(0, 4));
  return {middle - half, middle + half};
}

TEST(FacePanes, BoundsHoldThePixelsOfEveryPointOfTheBox) {
  test::Random random(1);
  int looked = 0;
  for (int round = 0; round < 300; ++round) {
    const Box box = random_box(random);
    for (int face = 0; face < 6; ++face) {
      const PixelBounds bounds = pixel_bounds(box, face, 256, near_m);
      for (int n = 0; n < 60; ++n) {
        const auto mix = [&](float a, float b) {
          return a + (b - a) * static_cast<float>(random.real(0, 1));
        };
        const glm::vec3 point(mix(box.lower.x, box.upper.x), mix(box.lower.y, box.upper.y),
                              mix(box.lower.z, box.upper.z));
        const glm::vec3 p = face_from_world(face) * point;
        if (p.z <= 1e-3f || std::abs(p.x) > p.z || std::abs(p.y) > p.z) continue;
        ASSERT_TRUE(bounds.reaches);
        if (face == 5 || p.z < near_m) {
          EXPECT_TRUE(bounds.at_eye);
        }
        if (bounds.at_eye) continue;
        ++looked;
        const int x = static_cast<int>((p.x / p.z + 1) * 128), y = static_cast<int>((p.y / p.z + 1) * 128);
        EXPECT_LE(bounds.x0, x);
        EXPECT_GE(bounds.x1, std::min(x, 255));
        EXPECT_LE(bounds.y0, y);
        EXPECT_GE(bounds.y1, std::min(y, 255));
      }
    }
  }
  EXPECT_GT(looked, 5000);
}

TEST(FacePanes, OnlyBoxesThatReachTheFaceHaveBounds) {
  const Box east{{10, -1, 0}, {12, 1, 2}};
  for (int face = 0; face < 6; ++face) EXPECT_EQ(pixel_bounds(east, face, 64, near_m).reaches, face == 0);
  EXPECT_TRUE(pixel_bounds({{-1, -1, -1}, {1, 1, 1}}, 2, 64, near_m).at_eye);
}

TEST(FacePanes, HoldAllThatWasAddedInDisjointRectangles) {
  test::Random random(2);
  for (const int resolution : {16, 64, 1024}) {
    for (int round = 0; round < 40; ++round) {
      FacePanes panes(resolution);
      std::vector<Box> boxes;
      for (int n = 0; n < 1 + round % 7; ++n) {
        boxes.push_back(random_box(random));
        panes.add(boxes.back(), near_m);
      }
      const std::vector<Pane> made = panes.make();
      const auto holds = [&](int face, int x, int y) {
        int count = 0;
        for (const Pane& p : made) count += p.face == face && x >= p.x0 && x < p.x1 && y >= p.y0 && y < p.y1;
        EXPECT_LE(count, 1);
        const auto& [lower, upper] = panes.rows()[face][x / FacePanes::strip_width(resolution)];
        EXPECT_EQ(count == 1, y >= lower && y < upper) << "rows say what the panes hold";
        return count == 1;
      };
      for (const Pane& pane : made) {
        for (const int border : {pane.x0, pane.x1, pane.y0, pane.y1})
          EXPECT_EQ(border % FacePanes::alignment, 0);
        EXPECT_GT(pane.pixels(), 0);
      }
      for (const Box& box : boxes) {
        for (int face = 0; face < face_count; ++face) {
          const PixelBounds b = pixel_bounds(box, face, resolution, near_m);
          if (!b.reaches || b.at_eye) continue;
          for (const int x : {b.x0, b.x1})
            for (const int y : {b.y0, b.y1}) EXPECT_TRUE(holds(face, x, y));
        }
      }
    }
  }
}

TEST(FacePanes, AFarBoxNeedsAFewPixelsOfOneFace) {
  FacePanes panes(1024);
  panes.add({{200, -2, 0}, {204, 2, 6}}, near_m);
  ASSERT_EQ(panes.make().size(), 1u);
  EXPECT_LE(panes.make()[0].pixels(), 2 * 64 * 48);
  panes.clear();
  EXPECT_TRUE(panes.make().empty());
  panes.add_all();
  EXPECT_EQ(panes.make().size(), static_cast<size_t>(face_count));
  for (const Pane& pane : panes.make()) EXPECT_EQ(pane.pixels(), 1024 * 1024);
}

}  // namespace
}  // namespace veduta
