#include "viewer/window/controls.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <functional>
#include <glm/geometric.hpp>
#include <map>
#include <set>

#include "tests/worker/celled_city.h"

namespace veduta {
namespace {

using test::CelledCity;
using test::Mesh;

/// A plain with a house at (12..18, -3..3), and a place to stand in its middle.
PvsIndex make_index() {
  Mesh mesh;
  mesh.ground(-30, -30, 30, 30, 0);
  mesh.object();
  mesh.box({{12, -3, 0}, {18, 3, 8}});
  CelledCity city(mesh.scene, {});
  PvsIndex index;
  index.objects = mesh.scene.objects;
  for (size_t o = 0; o < index.objects.size(); ++o) index.bounds.push_back(mesh.scene.bounds(o));
  index.cells = city.cells;
  index.navigation = city.navigation;
  return index;
}

const PvsIndex& index_of_plain() {
  static const PvsIndex index = make_index();
  return index;
}

ViewState standing() {
  ViewState state;
  state.pose = {{0.1f, 0.1f, 1.7f}, 0, 0};
  return state;
}

struct Viewer {
  Controls controls{index_of_plain(), standing()};
  WindowAction press(int key, int mods = 0) {
    const WindowAction action = controls.key(key, mods, true);
    controls.key(key, mods, false);
    return action;
  }
  const ViewState& state() const { return controls.state(); }
  glm::vec3 eye() const { return state().pose.position_m; }
};

TEST(Controls, HasEveryKeyOnceAndSaysWhatItDoes) {
  std::set<std::pair<int, int>> seen;
  for (const KeyBinding& binding : key_bindings()) {
    EXPECT_NE(std::string(binding.name), "");
    EXPECT_NE(std::string(binding.does), "") << binding.name;
    if (binding.key) {
      EXPECT_TRUE(seen.emplace(binding.key, binding.mods).second) << binding.name;
    }
  }
  EXPECT_GT(seen.size(), 35u);
}

// What a press changes, beyond what is said: anything in the state, the movement, the pose after a second.
std::string print(const Controls& controls) {
  const ViewState& s = controls.state();
  std::string text;
  for (const double value : {static_cast<double>(s.pose.position_m.x),
                             static_cast<double>(s.pose.position_m.y),
                             static_cast<double>(s.pose.position_m.z),
                             static_cast<double>(s.pose.yaw_deg),
                             static_cast<double>(s.pose.pitch_deg),
                             static_cast<double>(s.optics.iod_m),
                             static_cast<double>(s.optics.screen_distance_m),
                             static_cast<double>(s.optics.vertical_fov_deg),
                             static_cast<double>(s.stereo),
                             static_cast<double>(s.swap_eyes),
                             static_cast<double>(s.pvs),
                             static_cast<double>(s.culling),
                             static_cast<double>(s.frozen.has_value()),
                             static_cast<double>(s.cells),
                             static_cast<double>(s.map),
                             static_cast<double>(s.map_width_m),
                             static_cast<double>(s.missing),
                             static_cast<double>(s.hud),
                             static_cast<double>(s.help),
                             static_cast<double>(s.search),
                             static_cast<double>(s.chosen.has_value()),
                             static_cast<double>(controls.movement())})
    text += std::to_string(value) + " ";
  return text;
}

TEST(Controls, EveryKeyDoesSomething) {
  for (const KeyBinding& binding : key_bindings()) {
    if (!binding.key || binding.key == GLFW_KEY_LEFT_SHIFT) continue;
    Viewer viewer;
    viewer.press(GLFW_KEY_TAB);  // flying, all keys that move do
    viewer.controls.state().help = true;
    viewer.controls.state().pose.yaw_deg = 3;
    const std::string before = print(viewer.controls);
    const WindowAction action = viewer.controls.key(binding.key, binding.mods, true);
    viewer.controls.step(0.1);
    EXPECT_TRUE(action != WindowAction::none || print(viewer.controls) != before) << binding.name;
  }
}

TEST(Controls, SwitchesEachFeatureRoundAndBack) {
  const std::map<int, std::pair<int, std::function<int(const ViewState&)>>> keys{
      {GLFW_KEY_P, {3, [](const ViewState& s) { return static_cast<int>(s.pvs); }}},
      {GLFW_KEY_C, {3, [](const ViewState& s) { return static_cast<int>(s.culling); }}},
      {GLFW_KEY_B, {4, [](const ViewState& s) { return static_cast<int>(s.cells); }}},
      {GLFW_KEY_M, {3, [](const ViewState& s) { return static_cast<int>(s.map); }}},
      {GLFW_KEY_T, {15, [](const ViewState& s) { return static_cast<int>(s.stereo); }}},
      {GLFW_KEY_X, {2, [](const ViewState& s) { return static_cast<int>(s.missing); }}},
      {GLFW_KEY_H, {2, [](const ViewState& s) { return static_cast<int>(s.hud); }}},
      {GLFW_KEY_Y, {2, [](const ViewState& s) { return static_cast<int>(s.swap_eyes); }}},
      {GLFW_KEY_F1, {2, [](const ViewState& s) { return static_cast<int>(s.help); }}},
      {GLFW_KEY_F, {2, [](const ViewState& s) { return static_cast<int>(s.frozen.has_value()); }}}};
  for (const auto& [key, rule] : keys) {
    Viewer viewer;
    std::set<int> values;
    const int before = rule.second(viewer.state());
    for (int i = 0; i < rule.first; ++i) viewer.press(key), values.insert(rule.second(viewer.state()));
    EXPECT_EQ(values.size(), static_cast<size_t>(rule.first)) << key;
    EXPECT_EQ(rule.second(viewer.state()), before) << key;
  }
}

TEST(Controls, PassesQuadBufferOverUnlessTheWindowHasIt) {
  for (const bool has : {false, true}) {
    Viewer viewer;
    viewer.controls.set_quad_buffer(has);
    std::set<StereoMode> modes;
    for (int i = 0; i < 16; ++i) {
      viewer.press(GLFW_KEY_T);
      modes.insert(viewer.state().stereo);
    }
    EXPECT_EQ(modes.count(StereoMode::quad_buffer), has);
    EXPECT_EQ(modes.size(), has ? 16u : 15u);
    const StereoMode mode = viewer.state().stereo;
    viewer.press(GLFW_KEY_T), viewer.press(GLFW_KEY_T, GLFW_MOD_SHIFT);
    EXPECT_EQ(viewer.state().stereo, mode);
  }
}

TEST(Controls, KeepsOpticsInTheirRangeAndWarnsOfParallax) {
  Viewer viewer;
  for (const int key : {GLFW_KEY_EQUAL, GLFW_KEY_MINUS, GLFW_KEY_0, GLFW_KEY_9, GLFW_KEY_COMMA,
                        GLFW_KEY_PERIOD, GLFW_KEY_LEFT_BRACKET, GLFW_KEY_RIGHT_BRACKET}) {
    for (int i = 0; i < 300; ++i) viewer.press(key);
    const Optics& optics = viewer.state().optics;
    EXPECT_TRUE(optics.iod_m > 0 && optics.iod_m <= 100) << key;
    EXPECT_TRUE(optics.screen_distance_m > 0 && optics.screen_distance_m <= 10000) << key;
    EXPECT_TRUE(optics.vertical_fov_deg >= 1 && optics.vertical_fov_deg <= 150) << key;
    EXPECT_TRUE(viewer.state().map_width_m > 0 && viewer.state().map_width_m < 1e6f) << key;
  }
  Viewer other;
  other.press(GLFW_KEY_MINUS);
  EXPECT_EQ(other.controls.take_message().find("comfortable"), std::string::npos);
  for (int i = 0; i < 20; ++i) other.press(GLFW_KEY_9);
  EXPECT_NE(other.controls.take_message().find("comfortable"), std::string::npos);
  EXPECT_EQ(other.controls.take_message(), "") << "said once";
}

TEST(Controls, WalksWhereItLooksAndSaysHowFast) {
  Viewer viewer;
  viewer.controls.state().pose.yaw_deg = 90;
  viewer.controls.key(GLFW_KEY_W, 0, true);
  const glm::vec3 velocity = viewer.controls.step(0.1);
  EXPECT_NEAR(velocity.y, 3, 0.05f);
  EXPECT_NEAR(velocity.x, 0, 0.05f);
  EXPECT_NEAR(viewer.eye().y, 0.4f, 0.01f);
  viewer.controls.key(GLFW_KEY_LEFT_SHIFT, 0, true);
  EXPECT_NEAR(viewer.controls.step(0.1).y, 12, 0.2f);
  viewer.controls.key(GLFW_KEY_RIGHT_SHIFT, 0, false);
  viewer.controls.wheel(1);
  EXPECT_NEAR(viewer.controls.step(0.1).y, 3.75f, 0.1f);
  viewer.controls.key(GLFW_KEY_W, GLFW_MOD_CONTROL, false);
  EXPECT_EQ(viewer.controls.step(0.1), glm::vec3(0)) << "let go with another key held";
  viewer.controls.key(GLFW_KEY_D, 0, true);
  EXPECT_GT(viewer.controls.step(0.1).x, 2) << "right of +y is +x";
  viewer.controls.release_keys();
  EXPECT_EQ(viewer.controls.step(0.1), glm::vec3(0));
}

TEST(Controls, ALongPauseIsNoLongWay) {
  Viewer viewer;
  viewer.controls.key(GLFW_KEY_S, 0, true);
  viewer.controls.step(60);
  EXPECT_GT(viewer.eye().x, -1);
  EXPECT_EQ(viewer.controls.step(0), glm::vec3(0));
  EXPECT_EQ(viewer.controls.step(-1), glm::vec3(0));
}

TEST(Controls, WalkingStopsAtTheHouseAndFlyingDoesNot) {
  Viewer viewer;
  viewer.controls.key(GLFW_KEY_W, 0, true);
  for (int i = 0; i < 100; ++i) viewer.controls.step(0.1);
  EXPECT_GT(viewer.eye().x, 11);
  EXPECT_LT(viewer.eye().x, 12);
  viewer.press(GLFW_KEY_TAB);
  EXPECT_EQ(viewer.controls.movement(), Movement::fly);
  viewer.controls.key(GLFW_KEY_W, 0, true);
  for (int i = 0; i < 10; ++i) viewer.controls.step(0.1);
  EXPECT_GT(viewer.eye().x, 20);
}

TEST(Controls, FliesUpAndDownAndComesBackToTheGround) {
  Viewer viewer;
  viewer.press(GLFW_KEY_TAB);
  viewer.controls.key(GLFW_KEY_E, 0, true);
  for (int i = 0; i < 20; ++i) viewer.controls.step(0.1);
  EXPECT_NEAR(viewer.eye().z, 31.7f, 0.1f);
  viewer.controls.key(GLFW_KEY_E, 0, false);
  viewer.press(GLFW_KEY_TAB), viewer.press(GLFW_KEY_TAB);
  EXPECT_EQ(viewer.controls.movement(), Movement::walk);
  EXPECT_NEAR(viewer.eye().z, 1.7f, 0.3f);
  EXPECT_TRUE(index_of_plain().navigation.free.contains(viewer.eye()));
}

TEST(Controls, FliesWithAReasonWhereNobodyCanStand) {
  ViewState state = standing();
  state.pose.position_m = {0, 0, 100};
  Controls above(index_of_plain(), state);
  EXPECT_EQ(above.movement(), Movement::fly);
  EXPECT_NE(above.take_message().find("fly"), std::string::npos);
  EXPECT_EQ(above.state().pose.position_m, state.pose.position_m) << "the pose that was asked for stays";

  const PvsIndex nothing;
  Controls lost(nothing, state);
  EXPECT_EQ(lost.movement(), Movement::fly);
  lost.take_message();
  lost.key(GLFW_KEY_TAB, 0, true), lost.key(GLFW_KEY_TAB, 0, true);  // orbit, then back to walking
  EXPECT_EQ(lost.movement(), Movement::fly);
  EXPECT_NE(lost.take_message().find("no free space"), std::string::npos);
}

TEST(Controls, OrbitsWhatIsInTheMiddle) {
  Viewer viewer;
  viewer.controls.state().pose.pitch_deg = 2;
  viewer.press(GLFW_KEY_TAB), viewer.press(GLFW_KEY_TAB);
  ASSERT_EQ(viewer.controls.movement(), Movement::orbit);
  EXPECT_LT(glm::distance(viewer.eye(), {0.1f, 0.1f, 1.7f}), 0.1f) << "turning to it is no jump";
  const glm::vec3 middle = viewer.eye() + 11.9f * axes(viewer.state().pose).forward;
  viewer.controls.turn(200, -100);
  EXPECT_NEAR(glm::distance(viewer.eye(), middle), 11.9f, 0.3f);
  EXPECT_GT(glm::distance(viewer.eye(), {0.1f, 0.1f, 1.7f}), 3);
  viewer.controls.wheel(2);
  EXPECT_LT(glm::distance(viewer.eye(), middle), 9.5f);
  EXPECT_NEAR(glm::dot(glm::normalize(middle - viewer.eye()), axes(viewer.state().pose).forward), 1, 0.01f);
}

TEST(Controls, TurnsWithTheMouseAndNeverOverTheTop) {
  Viewer viewer;
  viewer.controls.turn(100, 0);
  EXPECT_LT(viewer.state().pose.yaw_deg, 0) << "to the right is from +x towards -y";
  viewer.controls.turn(0, 1e6f);
  EXPECT_LT(viewer.state().pose.pitch_deg, 90);
  viewer.controls.turn(0, -1e7f);
  EXPECT_GT(viewer.state().pose.pitch_deg, -90);
}

TEST(Controls, LooksAtTheChosenBuildingAndGoesAroundIt) {
  Viewer viewer;
  viewer.controls.state().pose.yaw_deg = 120;
  viewer.press(GLFW_KEY_F, GLFW_MOD_CONTROL);
  EXPECT_TRUE(viewer.state().search);
  EXPECT_FALSE(viewer.state().frozen) << "F alone freezes";
  viewer.controls.choose(1);
  EXPECT_FALSE(viewer.state().search);
  EXPECT_EQ(viewer.state().chosen, 1u);
  EXPECT_NEAR(viewer.state().pose.yaw_deg, 0, 1);
  EXPECT_LT(glm::distance(viewer.eye(), {0.1f, 0.1f, 1.7f}), 1e-6f);
  viewer.press(GLFW_KEY_TAB), viewer.press(GLFW_KEY_TAB);
  const glm::vec3 middle{15, 0, 4};
  const float far_m = glm::distance(viewer.eye(), middle);
  viewer.controls.turn(300, 0);
  EXPECT_NEAR(glm::distance(viewer.eye(), middle), far_m, 0.01f);
  viewer.press(GLFW_KEY_ESCAPE);
  EXPECT_FALSE(viewer.state().chosen);
  viewer.controls.choose(77);  // of another file
  EXPECT_FALSE(viewer.state().chosen);
}

TEST(Controls, HandsOnWhatOnlyTheWindowCanDo) {
  Viewer viewer;
  EXPECT_EQ(viewer.press(GLFW_KEY_F12), WindowAction::screenshot);
  EXPECT_EQ(viewer.press(GLFW_KEY_R), WindowAction::record);
  EXPECT_EQ(viewer.press(GLFW_KEY_R, GLFW_MOD_SHIFT), WindowAction::play);
  EXPECT_EQ(viewer.press(GLFW_KEY_F11), WindowAction::fullscreen);
  EXPECT_EQ(viewer.press(GLFW_KEY_Q, GLFW_MOD_CONTROL), WindowAction::quit);
  EXPECT_EQ(viewer.press(GLFW_KEY_Q), WindowAction::none) << "Q flies down";
  EXPECT_EQ(viewer.press(GLFW_KEY_F12, GLFW_MOD_ALT), WindowAction::none);
  EXPECT_EQ(viewer.press(GLFW_KEY_UNKNOWN), WindowAction::none);
}

TEST(Controls, GoesHome) {
  Viewer viewer;
  viewer.press(GLFW_KEY_TAB);
  viewer.controls.state().pose = {{50, 60, 70}, 12, 34};
  viewer.press(GLFW_KEY_HOME);
  EXPECT_EQ(viewer.eye(), standing().pose.position_m);
  EXPECT_EQ(viewer.controls.movement(), Movement::walk);
}

}  // namespace
}  // namespace veduta
