#include "viewer/draw/painter.h"

#include <algorithm>
#include <array>

#include "tests/viewer/painter_fixture.h"

namespace veduta {
namespace {

TEST_F(PainterTest, SkyIsAboveAndGroundBelow) {
  pose_ = {{0, 0, 1.7f}, 180, 0};  // nothing but the ground behind
  for (int samples : {1, 4}) {
    const auto on = painter(true, samples);
    const Image image = mono(*on, everything());
    const Pixel above = at(image, width / 2, 5), below = at(image, width / 2, height - 5);
    EXPECT_GT(above[2], above[0]) << "blue above";
    EXPECT_GT(below[1], below[2]) << "green below";
  }
}

TEST_F(PainterTest, NothingIsDrawnBeforeItIsAskedFor) {
  const auto on = painter();
  on->begin(both_eyes(), width, height);
  const uint32_t pictures = on->end();
  for (int eye : {0, 1}) {
    const Image image = picture(pictures, eye);
    EXPECT_EQ(std::count(image.rgb.begin(), image.rgb.end(), 0), 3 * width * height);
  }
}

TEST_F(PainterTest, BothEyesAtOnceAreTheEyesOneByOne) {
  const auto once = painter(true), twice = painter(false);
  ASSERT_FALSE(twice->one_pass());
  if (!once->one_pass()) GTEST_SKIP() << once->renderer() << " has no layers from vertex shaders";
  const CommandList part = list({Street::ground, Street::house, Street::wall}), all = everything();
  const ColouredBox box{{{30, -5, 0}, {35, 5, 12}}, {0, 1, 0, 1}, {0, 1, 0, 0.3f}};
  const ColouredLine line{{5, -5, 1}, {5, 5, 3}, {1, 0, 1, 0.7f}};
  for (float yaw = 0; yaw < 360; yaw += 45) {
    pose_.yaw_deg = yaw;
    std::array<Image, 2> images[2];
    for (size_t way : {0u, 1u}) {
      Painter& on = way == 0 ? *once : *twice;
      on.begin(both_eyes(), width, height);
      on.draw_city({&part, 1});
      on.draw_missing({&all, 1});
      on.draw_sky();
      on.draw_boxes({&box, 1});
      on.draw_lines({&line, 1});
      on.draw_map({}, all, colours_, {&box, 1}, {&line, 1}, {100, 10, 50, 40});
      const uint32_t pictures = on.end();
      images[way] = {picture(pictures, 0), picture(pictures, 1)};
    }
    EXPECT_TRUE(images[0] == images[1]) << "yaw " << yaw;
    EXPECT_FALSE(images[0][0] == images[0][1]) << "the eyes see the same at yaw " << yaw;
  }
}

TEST_F(PainterTest, EachEyeMayHaveAListOfItsOwn) {
  for (bool allow : {true, false}) {
    const auto on = painter(allow);
    const std::array<CommandList, 2> lists{everything(), list({Street::ground, Street::wall})};
    const auto draw = [&](std::span<const CommandList> which) {
      on->begin(both_eyes(), width, height);
      on->draw_city(which);
      on->draw_sky();
      const uint32_t pictures = on->end();
      return std::array<Image, 2>{picture(pictures, 0), picture(pictures, 1)};
    };
    const auto own = draw(lists), left = draw({&lists[0], 1}), right = draw({&lists[1], 1});
    EXPECT_TRUE(own[0] == left[0]);
    EXPECT_TRUE(own[1] == right[1]);
    EXPECT_FALSE(left[1] == right[1]);
  }
}

TEST_F(PainterTest, TheCityInPiecesIsTheCity) {
  const auto pieces = painter();
  const Image in_pieces = mono(*pieces, everything());
  Painter whole(index_, plenty, 4);
  CommandList all;
  all.commands.push_back(toy::whole(*whole.add(toy::page_of(city_, 0, 5, 0))));
  EXPECT_TRUE(mono(whole, all) == in_pieces);
}

TEST_F(PainterTest, PagesComeAndGo) {
  const auto on = painter();
  const Image before = mono(*on, everything());
  for (uint32_t object : {Street::house, Street::wall, Street::tower}) on->remove(object);
  for (uint32_t object : {Street::tower, Street::house, Street::wall})
    places_[object] = *on->add(page(object));
  EXPECT_TRUE(mono(*on, everything()) == before) << "elsewhere in the buffer";
  places_[Street::house] = *on->add(page(Street::house));
  EXPECT_TRUE(mono(*on, everything()) == before) << "put up twice";
  on->remove(77);
}

TEST_F(PainterTest, AFullBufferTakesNoMore) {
  const uint64_t wall = page(Street::wall).gpu_bytes();
  Painter on(index_, 2 * wall, 4);
  const auto first = on.add(page(Street::wall));
  ASSERT_TRUE(first);
  ASSERT_TRUE(on.add(page(Street::house)));
  EXPECT_FALSE(on.add(page(Street::shed)));
  on.remove(Street::wall);
  const auto after = on.add(page(Street::shed));
  ASSERT_TRUE(after);
  EXPECT_EQ(after->first_index, first->first_index);
}

TEST_F(PainterTest, AlonePageFitsHoweverLargeItIs) {
  Painter on(index_, 100, 4);
  const auto place = on.add(page(Street::tower));
  ASSERT_TRUE(place);
  places_[Street::tower] = *place;
  const auto roomy = painter();
  places_[Street::tower] = *place;
  const Image small = mono(on, list({Street::tower}));
  places_[Street::tower] = *roomy->add(page(Street::tower));
  EXPECT_TRUE(small == mono(*roomy, list({Street::tower})));
  EXPECT_FALSE(on.add(page(Street::wall)));
}

TEST_F(PainterTest, WhatIsMissingIsRed) {
  const auto on = painter();
  const CommandList all = everything(), row = list({Street::ground, Street::house, Street::wall});
  const Image whole = mono(*on, all), part = mono(*on, row);
  on->begin(one_eye(), width, height);
  on->draw_city({&row, 1});
  on->draw_missing({&all, 1});
  on->draw_sky();
  const Image red = picture(on->end());
  size_t reds = 0;
  for (uint32_t y = 0; y < height; ++y)
    for (uint32_t x = 0; x < width; ++x) {
      if (at(whole, x, y) == at(part, x, y)) {
        EXPECT_EQ(at(red, x, y), at(part, x, y)) << x << ", " << y;
      } else {
        EXPECT_GT(at(red, x, y)[0], at(red, x, y)[1]);
        reds += is_red(at(red, x, y));
      }
    }
  EXPECT_GT(reds, 100u) << "of the tower, over the wall";
}

TEST_F(PainterTest, OthersDrawOverTheFinishedPictures) {
  const auto on = painter();
  const CommandList all = everything();
  pose_.yaw_deg = 180;
  on->begin(both_eyes(), width, height);
  on->draw_city({&all, 1});
  on->draw_sky();
  int calls = 0;
  on->draw_over([&] {
    EXPECT_FALSE(glIsEnabled(GL_DEPTH_TEST));
    EXPECT_FALSE(glIsEnabled(GL_FRAMEBUFFER_SRGB));
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 0, 10, 10);
    glClearColor(0.5f, static_cast<float>(calls++), 0, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    glDisable(GL_SCISSOR_TEST);
  });
  const uint32_t pictures = on->end();
  EXPECT_EQ(calls, 2);
  for (int eye : {0, 1}) {
    const Image image = picture(pictures, eye);
    EXPECT_EQ(at(image, 5, height - 5), (Pixel{128, 255 * eye, 0})) << "as it was given";
    EXPECT_GT(at(image, 20, 5)[2], at(image, 20, 5)[0]) << "the sky is still there";
  }
}

TEST_F(PainterTest, PicturesMayChangeTheirSizeAndNumber) {
  const auto on = painter();
  const Image before = mono(*on, everything());
  on->begin(both_eyes(), 31, 17);
  on->draw_sky();
  on->end();
  EXPECT_TRUE(mono(*on, everything()) == before);
}

TEST_F(PainterTest, ASizeThatTheDriverCannotDrawIsAUsageError) {
  const auto on = painter();
  for (uint32_t side : {0u, 16384u * 8}) {
    try {
      on->begin(one_eye(), side, 10);
      ADD_FAILURE() << "drew " << side;
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::usage);
    }
  }
  mono(*on, everything());
}

}  // namespace
}  // namespace veduta
