// The toy street on a painter, for the tests of what it draws.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "gl/egl_context.h"
#include "gl/handle.h"
#include "scene/error.h"
#include "tests/viewer/toy_city.h"
#include "tests/viewer/toy_page.h"
#include "viewer/draw/offscreen.h"
#include "viewer/draw/painter.h"

namespace veduta {

using toy::Street;
inline constexpr uint32_t width = 160, height = 120;
inline constexpr uint64_t plenty = 1 << 20;

/// Red, green, blue, 0..255.
using Pixel = std::array<int, 3>;

/// x from the left, y from the top.
inline Pixel at(const Image& image, uint32_t x, uint32_t y) {
  const uint8_t* p = &image.rgb[3 * (size_t{y} * image.width + x)];
  return {p[0], p[1], p[2]};
}

inline bool is_red(const Pixel& p) {
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

}  // namespace veduta
