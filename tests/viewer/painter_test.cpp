#include "viewer/draw/painter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <memory>

#include "gl/egl_context.h"
#include "gl/handle.h"
#include "scene/error.h"
#include "tests/viewer/toy_city.h"
#include "tests/viewer/toy_page.h"
#include "viewer/draw/offscreen.h"

namespace veduta {
namespace {

using toy::Street;
constexpr uint32_t width = 160, height = 120;
constexpr uint64_t plenty = 1 << 20;

/// Red, green, blue, 0..255.
using Pixel = std::array<int, 3>;

/// x from the left, y from the top.
Pixel at(const Image& image, uint32_t x, uint32_t y) {
  const uint8_t* p = &image.rgb[3 * (size_t{y} * image.width + x)];
  return {p[0], p[1], p[2]};
}

bool is_red(const Pixel& p) {
  return p[0] > 60 && p[1] == 0 && p[2] == 0;
}

class PainterTest : public testing::Test {
 protected:
  void SetUp() override {
    try {
      context_ = std::make_unique<EglContext>("auto");
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
    index_ = toy::index_of(city_);
  }

  /// A painter with the street on it, a page for each object.
  std::unique_ptr<Painter> painter(bool allow_one_pass = true, int samples = 4) {
    auto painter = std::make_unique<Painter>(index_, plenty, samples, allow_one_pass);
    for (uint32_t o = 0; o < city_.scene.objects.size(); ++o) places_[o] = *painter->add(page(o));
    return painter;
  }
  Page page(uint32_t object) const { return toy::page_of(city_, object, object + 1, object); }

  CommandList list(std::initializer_list<uint32_t> objects) const {
    CommandList list;
    for (uint32_t object : objects) list.commands.push_back(toy::whole(places_[object]));
    return list;
  }
  CommandList everything() const {
    return list({Street::ground, Street::house, Street::wall, Street::shed, Street::tower});
  }

  std::vector<EyeView> both_eyes() const {
    return {eye_view(pose_, optics_, Eye::left), eye_view(pose_, optics_, Eye::right)};
  }
  std::vector<EyeView> one_eye() const { return {eye_view(pose_, optics_, Eye::middle)}; }

  static Image picture(uint32_t pictures, int eye = 0) {
    const GlFramebuffer framebuffer;
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
    glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, pictures, 0, eye);
    return read_picture(framebuffer.id(), {width, height});
  }
  /// The city alone, seen by one eye.
  Image mono(Painter& painter, const CommandList& list) const {
    painter.begin(one_eye(), width, height);
    painter.draw_city({&list, 1});
    painter.draw_sky();
    return picture(painter.end());
  }
  /// The whole city from above, 100 m across, north up: a pixel is 0.625 m.
  Image map(Painter& painter, const CommandList& list, const std::vector<MapColour>& colours,
            std::span<const ColouredBox> boxes = {}) const {
    painter.begin(one_eye(), width, height);
    painter.draw_map({{0, 0, 0}, 100, 90}, list, colours, boxes, {}, {0, 0, width, height});
    return picture(painter.end());
  }
  static Pixel on_map(const Image& image, float x_m, float y_m) {
    return at(image, static_cast<uint32_t>(width / 2.0f + x_m * 1.6f),
              static_cast<uint32_t>(height / 2.0f - y_m * 1.6f));
  }

  std::unique_ptr<EglContext> context_;
  City city_ = toy::make_street().file.city;
  PvsIndex index_;
  std::array<PagePlace, 5> places_;
  Pose pose_{{0, 0, 1.7f}, 0, 5};
  Optics optics_{0.3f, 2.5f, 55, 4.0f / 3, 0.05f};
  const std::vector<MapColour> colours_{MapColour::ground, MapColour::complete, MapColour::partial,
                                        MapColour::invisible, MapColour::invisible};
};

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
  on->begin(one_eye(), width, height);
  on->draw_city({&all, 1});
  on->draw_sky();
  on->draw_map({}, all, colours_, {}, {}, {100, 10, 50, 40});
  const Image with = picture(on->end());
  for (uint32_t y = 0; y < height; ++y)
    for (uint32_t x = 0; x < width; ++x)
      if (x < 98 || x >= 152 || height - 1 - y < 8 || height - 1 - y >= 52) {
        ASSERT_EQ(at(with, x, y), at(without, x, y));
      }
  EXPECT_NE(at(with, 120, height - 30), at(without, 120, height - 30));
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

TEST_F(PainterTest, LinesAreAsWideNearAsFarAndEndBehindTheEye) {
  const auto on = painter();
  pose_ = {{0, 0, 50}, 0, 0};  // above all
  const auto rows = [&](const glm::vec3& from, const glm::vec3& to) {
    const ColouredLine line{from, to, {1, 0, 1, 1}};
    on->begin(one_eye(), width, height);
    on->draw_sky();
    on->draw_lines({&line, 1});
    const Image image = picture(on->end());
    int count = 0;
    for (uint32_t y = 0; y < height; ++y) count += at(image, width / 2, y)[1] < 100;
    return count;
  };
  for (float distance_m : {1.0f, 10.0f, 1000.0f}) {
    const float y = 0.2f * distance_m;
    const int wide = rows({distance_m, -y, 50}, {distance_m, y, 50});
    EXPECT_GE(wide, 1) << distance_m;
    EXPECT_LE(wide, 3) << distance_m;
  }
  EXPECT_GT(rows({-5, 0, 49}, {50, 0, 49}), 20) << "from behind the eye to before it";
  EXPECT_EQ(rows({-5, 0, 49}, {-50, 0, 49}), 0) << "behind the eye";
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
