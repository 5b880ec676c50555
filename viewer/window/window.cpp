#include "viewer/window/window.h"

#include <backends/imgui_impl_glfw.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <chrono>
#include <cstdio>

#include "viewer/draw/offscreen.h"
#include "viewer/frame_stats.h"
#include "viewer/image.h"
#include "viewer/window/controls.h"
#include "viewer/window/gl_window.h"
#include "viewer/window/hud.h"
#include "viewer/window/recorder.h"
#include "viewer/window/saver.h"

namespace veduta {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double rest_s = 0.25;  // to wait for an event when nothing moves
constexpr double settle_s = 5;   // that it goes on drawing after the last event: messages go away

/// Keys and the mouse for the HUD, through ImGui's own callbacks: they call ours.
class HudInput {
 public:
  explicit HudInput(GLFWwindow* window) { ImGui_ImplGlfw_InitForOpenGL(window, true); }
  ~HudInput() { ImGui_ImplGlfw_Shutdown(); }
  HudInput(const HudInput&) = delete;
  HudInput& operator=(const HudInput&) = delete;
};

class Session {
 public:
  Session(CityStream& stream, const WindowOptions& options);
  void run();
  void finish();  ///< writes what is still to be written

 private:
  void listen();
  void on_key(int key, int mods, bool pressed);
  void act(WindowAction action);
  void toggle_recording();
  void toggle_playing();
  glm::vec3 advance(double elapsed_s);
  void draw(double elapsed_s);
  void save_screenshot();
  void say_what_was_saved();
  bool still() const;

  CityStream& stream_;
  const WindowOptions& options_;
  GlWindow window_;
  Hud hud_;
  HudInput input_;
  FrameDrawer drawer_;
  Controls controls_;
  Saver saver_;

  std::optional<Recorder> recorder_;
  std::vector<Pose> path_;
  std::optional<Player> player_;
  std::vector<FrameStats> stats_;
  FrameStats last_;
  uint32_t frames_ = 0;
  glm::dvec2 mouse_{0};
  bool screenshot_ = false;
  Clock::time_point last_event_ = Clock::now();
};

Session& session_of(GLFWwindow* window) {
  return *static_cast<Session*>(glfwGetWindowUserPointer(window));
}

Session::Session(CityStream& stream, const WindowOptions& options)
    : stream_(stream),
      options_(options),
      window_(options.title, {options.width, options.height}, options.fullscreen,
              options.begin.stereo == StereoMode::quad_buffer),
      input_((listen(), window_.handle())),
      drawer_(stream, options.frame, &hud_),
      controls_(stream.index(), options.begin),
      saver_(options.folder),
      path_(options.path) {
  controls_.set_quad_buffer(window_.quad_buffer());
  if (options.begin.stereo == StereoMode::quad_buffer && !window_.quad_buffer()) {
    fmt::print(stderr, "veduta-view: this display has no quad-buffer stereo; showing side-by-side\n");
    controls_.state().stereo = StereoMode::side_by_side;
  }
  if (options.play && !path_.empty()) player_.emplace(path_, Player::Pace::pose_a_frame);
}

// Before ImGui's callbacks are put in, which call those that they find.
void Session::listen() {
  GLFWwindow* const window = window_.handle();
  glfwSetWindowUserPointer(window, this);
  glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int mods) {
    if (action != GLFW_REPEAT) session_of(w).on_key(key, mods, action == GLFW_PRESS);
  });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double, double up) {
    session_of(w).last_event_ = Clock::now();
    session_of(w).controls_.wheel(static_cast<float>(up));
  });
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) {
    Session& session = session_of(w);
    const glm::dvec2 way = glm::dvec2(x, y) - session.mouse_;
    session.mouse_ = {x, y};
    if (glfwGetMouseButton(w, GLFW_MOUSE_BUTTON_LEFT) != GLFW_PRESS) return;
    session.last_event_ = Clock::now();
    session.controls_.turn(static_cast<float>(way.x), static_cast<float>(-way.y));
  });
  glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int focused) {
    if (!focused) session_of(w).controls_.release_keys();
  });
  for (const auto set : {glfwSetWindowSizeCallback, glfwSetWindowPosCallback})
    set(window, [](GLFWwindow* w, int, int) { session_of(w).last_event_ = Clock::now(); });
  glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { session_of(w).last_event_ = Clock::now(); });
}

void Session::on_key(int key, int mods, bool pressed) {
  last_event_ = Clock::now();
  // Letters belong to the search while it is open; it is left by Escape. What is let go is let go.
  if (pressed && hud_.wants_keys() && key != GLFW_KEY_ESCAPE) return;
  act(controls_.key(key, mods, pressed));
}

void Session::act(WindowAction action) {
  if (action == WindowAction::screenshot) screenshot_ = true;
  if (action == WindowAction::record) toggle_recording();
  if (action == WindowAction::play) toggle_playing();
  if (action == WindowAction::fullscreen) window_.toggle_fullscreen();
  if (action == WindowAction::quit) glfwSetWindowShouldClose(window_.handle(), GLFW_TRUE);
}

void Session::toggle_recording() {
  if (!recorder_) {
    recorder_.emplace();
    hud_.say("recording a path; R again saves it");
    return;
  }
  path_ = recorder_->path();
  recorder_.reset();
  if (path_.empty()) return;
  saver_.save(saver_.next_file("path", ".csv"),
              [path = path_](const std::filesystem::path& file) { write_path(file, path); });
}

void Session::toggle_playing() {
  if (player_) {
    player_.reset();
    hud_.say("stopped");
  } else if (path_.empty()) {
    hud_.say("no path to play; R records one");
  } else {
    player_.emplace(path_, Player::Pace::in_time);
    hud_.say("playing the path");
  }
}

// \return the velocity of the eye, m/s
glm::vec3 Session::advance(double elapsed_s) {
  if (!player_) return controls_.step(elapsed_s);
  Pose& pose = controls_.state().pose;
  const glm::vec3 before = pose.position_m;
  pose = player_->next(elapsed_s);
  if (player_->done()) {
    player_.reset();
    if (options_.play) glfwSetWindowShouldClose(window_.handle(), GLFW_TRUE);
  }
  return elapsed_s > 0 ? (pose.position_m - before) / static_cast<float>(elapsed_s) : glm::vec3(0);
}

void Session::draw(double elapsed_s) {
  const glm::vec3 velocity = advance(elapsed_s);
  if (const std::optional<uint32_t> object = hud_.chosen()) controls_.choose(*object);
  if (const std::string message = controls_.take_message(); !message.empty()) hud_.say(message);
  say_what_was_saved();
  if (recorder_) recorder_->add(elapsed_s, controls_.state().pose);

  ImGui_ImplGlfw_NewFrame();
  last_ = drawer_.draw(controls_.state(), velocity, {0, window_.size(), window_.screen_position()});
  last_.frame = frames_++, last_.interval_ms = 1000 * elapsed_s;
  if (!options_.stats.empty()) stats_.push_back(last_);
  if (std::exchange(screenshot_, false)) save_screenshot();
  glfwSwapBuffers(window_.handle());
}

// Before the buffers are swapped: what the user is about to see.
void Session::save_screenshot() {
  auto image = std::make_shared<const Image>(read_picture(0, window_.size()));
  saver_.save(saver_.next_file("screenshot", ".png"),
              [image](const std::filesystem::path& file) { write_png(file, *image); });
}

void Session::say_what_was_saved() {
  while (const std::optional<std::string> report = saver_.report()) {
    hud_.say(*report), fmt::print("{}\n", *report), std::fflush(stdout);
    last_event_ = Clock::now();
  }
}

// On a CPU that draws, a picture that stays as it is should cost nothing.
bool Session::still() const {
  const bool moved = last_.pose.position_m != controls_.state().pose.position_m;
  return !moved && !player_ && !recorder_ && !last_.waiting && !saver_.busy() && !controls_.state().hud &&
         std::chrono::duration<double>(Clock::now() - last_event_).count() > settle_s;
}

void Session::run() {
  const auto rests = [&] {
    const glm::uvec2 size = window_.size();
    return size.x == 0 || size.y == 0 || still();
  };
  Clock::time_point last = Clock::now();
  while (!glfwWindowShouldClose(window_.handle())) {
    if (rests())
      glfwWaitEventsTimeout(rest_s);
    else
      glfwPollEvents();
    if (rests()) continue;
    const Clock::time_point now = Clock::now();
    draw(std::chrono::duration<double>(now - std::exchange(last, now)).count());
  }
}

void Session::finish() {
  if (recorder_) toggle_recording();
  while (const std::optional<std::string> report = saver_.wait()) fmt::print("{}\n", *report);
  std::fflush(stdout);
  if (!options_.stats.empty()) write_frame_stats(options_.stats, stats_);
}

}  // namespace

void show_window(CityStream& stream, const WindowOptions& options) {
  Session session(stream, options);
  try {
    session.run();
  } catch (...) {
    session.finish();  // the walk until the disk failed is worth keeping
    throw;
  }
  session.finish();
}

}  // namespace veduta
