#include "viewer/window/hud.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>
#include <imgui.h>

#include <filesystem>
#include <glm/common.hpp>
#include <glm/gtc/color_space.hpp>
#include <optional>

#include "gl/egl_context.h"
#include "scene/error.h"
#include "tests/pvs/small_city.h"
#include "viewer/draw/offscreen.h"
#include "viewer/window/legend.h"

namespace veduta {
namespace {

constexpr std::array<uint8_t, 3> background{90, 140, 60};

// What changed in a picture, from its upper left corner.
struct Changed {
  uint32_t left = ~0u, top = ~0u, right = 0,
           bottom = 0;            ///< [left, right) x [top, bottom)
  size_t pixels = 0, bright = 0;  ///< bright: letters
  uint32_t width() const { return right - left; }
  uint32_t height() const { return bottom - top; }
};

// Within rows and columns [from, to) of the picture.
Changed changed(const Image& image, glm::uvec2 from = {0, 0}, std::optional<glm::uvec2> to = {}) {
  Changed result;
  for (uint32_t y = from.y; y < (to ? to->y : image.height); ++y)
    for (uint32_t x = from.x; x < (to ? to->x : image.width); ++x) {
      const uint8_t* pixel = &image.rgb[3 * (size_t{y} * image.width + x)];
      if (std::equal(background.begin(), background.end(), pixel)) continue;
      ++result.pixels;
      result.bright += pixel[0] > 220 && pixel[1] > 220 && pixel[2] > 220;
      result.left = std::min(result.left, x), result.right = std::max(result.right, x + 1);
      result.top = std::min(result.top, y), result.bottom = std::max(result.bottom, y + 1);
    }
  return result;
}

bool has_colour(const Image& image, std::array<uint8_t, 3> colour) {
  for (size_t i = 0; i < image.rgb.size(); i += 3)
    if (std::equal(colour.begin(), colour.end(), &image.rgb[i])) return true;
  return false;
}

class HudTest : public testing::Test {
 protected:
  void SetUp() override {
    try {
      context_.emplace("auto");
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
    hud_.emplace();
    index_.row_begin = {0};
    for (uint32_t i = 0; i < 200; ++i) {
      index_.cells.push_back({{0, 0, 0}, {1, 1, 1}});
      index_.cell_row.push_back(i);
      index_.bake_us.push_back(1000 * i);
      index_.row_begin.push_back(index_.row_begin.back() + i);
      index_.objects.push_back({"House " + std::to_string(i), Kind::building, 100 * i, 100 * i + 100});
    }
    index_.objects[7].name = "Water tower";
    index_.objects[9].name = "TOWER BRIDGE";
  }

  void layout(double elapsed_s = 0.01) {
    time_s_ += elapsed_s;
    hud_->layout(state_, last_, status_, index_, size_, time_s_);
  }
  Image draw(bool converting = true) {
    Offscreen target(size_);
    glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer());
    glViewport(0, 0, static_cast<GLsizei>(size_.x), static_cast<GLsizei>(size_.y));
    glDisable(GL_FRAMEBUFFER_SRGB);
    const auto channel = [](uint8_t value) {  // the frame buffer takes it as it is
      return static_cast<float>(value) / 255;
    };
    glClearColor(channel(background[0]), channel(background[1]), channel(background[2]), 1);
    glClear(GL_COLOR_BUFFER_BIT);
    if (converting) glEnable(GL_FRAMEBUFFER_SRGB);
    hud_->draw();
    EXPECT_EQ(glIsEnabled(GL_FRAMEBUFFER_SRGB) == GL_TRUE, converting) << "left as it was";
    EXPECT_EQ(glGetError(), GLenum{GL_NO_ERROR});
    return read_picture(target.framebuffer(), size_);
  }
  Image picture() {
    layout();
    return draw();
  }

  void type(const char* text) {
    ImGui::GetIO().AddInputCharactersUTF8(text);
    layout();
  }
  void press(ImGuiKey key) {
    ImGuiIO& io = ImGui::GetIO();
    io.KeyMap[key] = static_cast<int>(key) + 1;  // as ImGui's GLFW backend does
    io.KeysDown[io.KeyMap[key]] = true;
    layout();
    io.KeysDown[io.KeyMap[key]] = false;
    layout();
  }
  void open_search() {
    state_.search = true;
    for (int i = 0; i < 3; ++i) layout();
  }
  std::optional<uint32_t> search(const char* text, int down = 0) {
    open_search();
    type(text);
    for (int i = 0; i < down; ++i) press(ImGuiKey_DownArrow);
    press(ImGuiKey_Enter);
    const std::optional<uint32_t> chosen = hud_->chosen();
    state_.search = false;
    layout();
    return chosen;
  }

  std::optional<EglContext> context_;
  std::optional<Hud> hud_;
  ViewState state_;
  FrameStats last_;
  PvsIndex index_;
  CityStream::Status status_{130, 120, 0, 312000000};
  glm::uvec2 size_{1280, 720};
  double time_s_ = 1000;
};

TEST_F(HudTest, NothingIsDrawnWhenAllIsOff) {
  EXPECT_EQ(changed(picture()).pixels, 0u);
  state_.hud = true;
  EXPECT_GT(changed(picture()).pixels, 0u);
  state_.hud = false;
  EXPECT_EQ(changed(picture()).pixels, 0u) << "nothing stays of the panel";
}

TEST_F(HudTest, TheFirstPictureHasItAll) {
  state_.help = state_.search = true;
  state_.map = MapShown::inset;
  hud_->say("something");
  const Image first = picture();
  EXPECT_GT(changed(first).bright, 50u);
  state_.search = false;
  const Image help = picture();
  EXPECT_GT(changed(help).bright, 1000u);
  EXPECT_TRUE(picture() == help);
}

TEST_F(HudTest, FiguresAreInACompactPanelAtTheUpperLeft) {
  state_.hud = true;
  const Changed panel = changed(picture());
  EXPECT_GT(panel.left, 0u);
  EXPECT_GT(panel.top, 0u);
  EXPECT_LT(panel.right, size_.x * 3 / 10);
  EXPECT_LT(panel.bottom, size_.y * 45 / 100);
  EXPECT_GT(panel.bright, 200u) << "letters";
  EXPECT_GE(panel.pixels + 4 * 20, panel.width() * panel.height()) << "a rectangle, its corners round";
}

TEST_F(HudTest, FiguresFollowTheFrame) {
  state_.hud = true;
  const Image before = picture();
  last_.triangles = 1234567;
  EXPECT_FALSE(picture() == before);
  const Image triangles = picture();
  state_.pose.position_m.x = 77;
  EXPECT_FALSE(picture() == triangles);
}

TEST_F(HudTest, LettersGrowWithThePicture) {
  state_.hud = true;
  const Changed small = changed(picture());
  size_ = {2560, 1440};
  const Changed large = changed(picture());
  EXPECT_NEAR(large.width(), 2.0 * small.width(), 8);
  EXPECT_NEAR(large.height(), 2.0 * small.height(), 30);
}

TEST_F(HudTest, ColoursAreThoseOfTheLegendWhetherGlConvertsOrNot) {
  state_.map = MapShown::inset;
  layout();
  const Image converting = draw(true);
  EXPECT_TRUE(converting == draw(false));
  for (const LegendEntry& entry : map_legend()) {
    const glm::vec3 bytes = glm::round(255.0f * glm::convertLinearToSRGB(entry.colour));
    EXPECT_TRUE(has_colour(converting, {static_cast<uint8_t>(bytes.r), static_cast<uint8_t>(bytes.g),
                                        static_cast<uint8_t>(bytes.b)}))
        << entry.text;
  }
  const Changed legend = changed(converting);
  EXPECT_LT(legend.right, size_.x / 4);
  EXPECT_GT(legend.top, size_.y / 2);
}

TEST_F(HudTest, TheLegendOfCellsFollowsWhatTheyAreColouredBy) {
  state_.cells = CellColour::pvs_size;
  const Image sizes = picture();
  state_.cells = CellColour::bake_time;
  const Image times = picture();
  EXPECT_GT(changed(times).pixels, 0u);
  EXPECT_FALSE(times == sizes);
  hud_.reset(), hud_.emplace();
  EXPECT_TRUE(picture() == times) << "nothing stays of the other scale";
}

TEST_F(HudTest, HelpFitsIntoThePicture) {
  state_.help = true;
  size_ = {500, 300};
  const Changed narrow = changed(picture());
  EXPECT_GT(std::min(narrow.left, narrow.top), 0u);
  EXPECT_LT(narrow.right, size_.x);
  EXPECT_LT(narrow.bottom, size_.y);
  size_ = {1280, 720};
  const Changed help = changed(picture());
  EXPECT_GT(help.bright, 150u) << "letters";
  EXPECT_GT(std::min(help.left, help.top), 0u);
  EXPECT_LT(help.right, size_.x);
  EXPECT_LT(help.bottom, size_.y);
  state_.help = false, state_.hud = true;
  EXPECT_LT(changed(picture()).right, help.left) << "beside the figures";
}

TEST_F(HudTest, WarningsHaveAColourOfTheirOwn) {
  const auto orange = [&] {
    const Image image = picture();
    size_t pixels = 0;
    for (size_t i = 0; i < image.rgb.size(); i += 3)
      pixels += image.rgb[i] > 220 && image.rgb[i + 1] > 150 && image.rgb[i + 2] < 90;
    return pixels;
  };
  state_.hud = true, state_.stereo = StereoMode::side_by_side, last_.cell = 3;
  EXPECT_EQ(orange(), 0u);
  status_.pages_missing = 1;
  EXPECT_GT(orange(), 20u) << "the city is being loaded";
  status_.pages_missing = 0, last_.cell = -1, last_.all_drawn = true;
  EXPECT_GT(orange(), 20u) << "outside every view-cell";
  last_.cell = 3, last_.all_drawn = false, state_.optics.screen_distance_m = 1;
  EXPECT_GT(orange(), 20u) << "parallax of 3.7 degrees";
  state_.stereo = StereoMode::mono;
  EXPECT_EQ(orange(), 0u) << "one eye";
}

TEST_F(HudTest, ParallaxIsWarnedOfWhenAModeIsChosen) {
  state_.optics.screen_distance_m = 1;
  EXPECT_EQ(changed(picture()).pixels, 0u) << "one eye";
  state_.stereo = StereoMode::side_by_side;
  EXPECT_GT(changed(picture()).bright, 100u);
  layout(60);
  EXPECT_EQ(changed(picture()).pixels, 0u) << "once";
}

TEST_F(HudTest, MessagesStaySomeSeconds) {
  hud_->say("screenshot saved as %s%n veduta.png\x1b[31m");
  layout();
  const Changed message = changed(picture());
  EXPECT_GT(message.bright, 100u);
  EXPECT_GT(message.top, size_.y * 3 / 4);
  for (int i = 0; i < 30; ++i) layout(0.1);
  EXPECT_GT(changed(picture()).pixels, 0u);
  for (int i = 0; i < 30; ++i) layout(0.1);
  EXPECT_EQ(changed(picture()).pixels, 0u);
}

TEST_F(HudTest, ALongMessageIsWrapped) {
  hud_->say("short");
  const Changed line = changed(picture());
  layout(60);
  hud_->say("saved /a/long/path" + std::string(100, '/') + " with words in it, and then some more of them");
  const Changed message = changed(picture());
  EXPECT_GT(message.left, 0u);
  EXPECT_LT(message.right, size_.x);
  size_ = {640, 720};
  const Changed wrapped = changed(picture());
  EXPECT_GT(wrapped.left, 0u);
  EXPECT_LT(wrapped.right, size_.x);
  EXPECT_GT(wrapped.height(), line.height() + 10);
}

TEST_F(HudTest, SearchFindsAndEnterChooses) {
  EXPECT_FALSE(hud_->wants_keys());
  open_search();
  EXPECT_TRUE(hud_->wants_keys());
  const Changed empty = changed(picture());
  type("toWer");
  const Changed found = changed(picture());
  EXPECT_GT(found.height(), empty.height() + 20) << "the list below the field";
  EXPECT_GT(found.bright, empty.bright);
  EXPECT_FALSE(hud_->chosen()) << "not before Enter";
  press(ImGuiKey_Enter);
  EXPECT_EQ(hud_->chosen(), 9u);
  EXPECT_FALSE(hud_->chosen()) << "told once";
  state_.search = false;
  layout();
  EXPECT_FALSE(hud_->wants_keys());
  EXPECT_EQ(changed(picture()).pixels, 0u);
}

TEST_F(HudTest, ArrowsChooseAnotherAndEachSearchBeginsEmpty) {
  EXPECT_EQ(search("tower", 1), 7u);
  EXPECT_EQ(search("tower", 5), 7u) << "the last of two";
  EXPECT_EQ(search("house 12"), 12u);
  EXPECT_EQ(search("no such house"), std::nullopt);
  EXPECT_EQ(search(""), std::nullopt);
}

TEST_F(HudTest, HostileNamesStayInTheirLine) {
  open_search();
  type("house");
  const Changed plain = changed(picture());
  state_.search = false, layout();
  for (Object& object : index_.objects)
    object.name = "House%n%s\n\n\x1b]0;\xff\xfe##" + std::string(5000, 'W');
  hud_.reset(), hud_.emplace();  // another file
  open_search();
  type("house%n");
  const Changed hostile = changed(picture());
  EXPECT_EQ(hostile.height(), plain.height());
  EXPECT_EQ(hostile.width(), plain.width());
  EXPECT_GT(hostile.bright, plain.bright) << "all of them are there";
  press(ImGuiKey_Enter);
  EXPECT_EQ(hud_->chosen(), 0u);
}

TEST_F(HudTest, FiguresOfNoFileDoNoHarm) {
  state_.hud = state_.help = state_.search = true;
  state_.map = MapShown::full, state_.cells = CellColour::worker;
  last_.cell = 1000000, last_.triangles = ~uint64_t{0}, last_.ms = 1e30;
  state_.pose.position_m = glm::vec3(1e30f);
  index_ = {};
  for (const glm::uvec2 size : {glm::uvec2{1, 1}, {64, 48}, {320, 2000}, {4000, 30}}) {
    size_ = size;
    picture();
  }
}

TEST_F(HudTest, WritesNoFile) {
  const test::TemporaryDirectory directory;
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(directory.path());
  hud_->say("something");
  for (int i = 0; i < 10; ++i) layout(1);
  hud_.reset();
  EXPECT_TRUE(std::filesystem::is_empty(directory.path()));
  std::filesystem::current_path(before);
}

}  // namespace
}  // namespace veduta
