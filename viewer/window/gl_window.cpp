#include "viewer/window/gl_window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include "scene/error.h"

namespace veduta {
namespace {

constexpr const char* instead = "draw pictures with --headless --out DIR";

// GLFW's last complaint: it says why there is no display, or what the driver lacks.
std::string& complaint() {
  static std::string text;
  return text;
}

void keep_complaint(int, const char* text) {
  complaint() = text;
}

/// The screen that the middle of the window is on, else the first; nullptr without any.
GLFWmonitor* screen_of(GLFWwindow* window) {
  int x = 0, y = 0, width = 0, height = 0;
  glfwGetWindowPos(window, &x, &y);
  glfwGetWindowSize(window, &width, &height);
  x += width / 2, y += height / 2;
  int count = 0;
  GLFWmonitor** screens = glfwGetMonitors(&count);
  for (int i = 0; i < count; ++i) {
    int left = 0, top = 0;
    glfwGetMonitorPos(screens[i], &left, &top);
    const GLFWvidmode* mode = glfwGetVideoMode(screens[i]);
    if (mode && x >= left && y >= top && x < left + mode->width && y < top + mode->height) return screens[i];
  }
  return glfwGetPrimaryMonitor();
}

GLFWwindow* open(const std::string& title, const glm::uvec2& size, bool quad_buffer) {
  glfwDefaultWindowHints();
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  // Pictures are drawn elsewhere, with depth and many samples, and composed into the window.
  for (const int bits : {GLFW_DEPTH_BITS, GLFW_STENCIL_BITS, GLFW_ALPHA_BITS, GLFW_SAMPLES})
    glfwWindowHint(bits, 0);
  glfwWindowHint(GLFW_STEREO, quad_buffer);
  return glfwCreateWindow(static_cast<int>(size.x), static_cast<int>(size.y), title.c_str(), nullptr,
                          nullptr);
}

}  // namespace

GlWindow::GlWindow(const std::string& title, const glm::uvec2& size, bool fullscreen, bool quad_buffer) {
  glfwSetErrorCallback(keep_complaint);
  if (!glfwInit())
    throw Error(ExitStatus::usage,
                fmt::format("no display to open a window on ({}); set DISPLAY, or {}", complaint(), instead));
  if (quad_buffer) window_ = open(title, size, true);
  quad_buffer_ = window_ != nullptr;
  if (!window_) window_ = open(title, size, false);
  if (!window_) {
    const std::string why = complaint();
    glfwTerminate();
    throw Error(ExitStatus::usage,
                fmt::format("this display has no OpenGL 4.3 ({}); update its driver, or {}", why, instead));
  }
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(1);
  if (fullscreen) toggle_fullscreen();
}

GlWindow::~GlWindow() {
  glfwDestroyWindow(window_);
  glfwTerminate();
}

glm::uvec2 GlWindow::size() const {
  if (glfwGetWindowAttrib(window_, GLFW_ICONIFIED)) return glm::uvec2(0);
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  return glm::uvec2(width, height);
}

glm::ivec2 GlWindow::screen_position() const {
  glm::ivec2 position(0), screen(0);
  glfwGetWindowPos(window_, &position.x, &position.y);
  if (GLFWmonitor* const monitor = screen_of(window_)) glfwGetMonitorPos(monitor, &screen.x, &screen.y);
  return position - screen;
}

void GlWindow::toggle_fullscreen() {
  if (glfwGetWindowMonitor(window_)) {
    glfwSetWindowMonitor(window_, nullptr, position_.x, position_.y, size_.x, size_.y, GLFW_DONT_CARE);
    return;
  }
  GLFWmonitor* const screen = screen_of(window_);
  const GLFWvidmode* const mode = screen ? glfwGetVideoMode(screen) : nullptr;
  if (!mode) return;
  glfwGetWindowPos(window_, &position_.x, &position_.y);
  glfwGetWindowSize(window_, &size_.x, &size_.y);
  glfwSetWindowMonitor(window_, screen, 0, 0, mode->width, mode->height, mode->refreshRate);
  glfwSwapInterval(1);  // some drivers forget it
}

}  // namespace veduta
