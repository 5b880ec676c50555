// A window with OpenGL in it.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <string>

struct GLFWwindow;

namespace veduta {

/// One at a time: GLFW and the current context are of the process.
class GlWindow {
 public:
  /// Opens it, with an OpenGL 4.3 core context that is current from then on, synchronised with the screen.
  /// The bytes of its frame buffer are sRGB and are not converted. `quad_buffer`: two back buffers, left and
  /// right, are asked for. \throw Error(usage) without a display, or without OpenGL 4.3 on it.
  GlWindow(const std::string& title, const glm::uvec2& size, bool fullscreen, bool quad_buffer);
  ~GlWindow();
  GlWindow(const GlWindow&) = delete;
  GlWindow& operator=(const GlWindow&) = delete;

  GLFWwindow* handle() const { return window_; }
  bool quad_buffer() const { return quad_buffer_; }
  glm::uvec2 size() const;  ///< pixels; 0 while it is minimised
  glm::ivec2 screen_position()
      const;  ///< of its upper left pixel on its screen, from the screen's own corner
  void toggle_fullscreen();

 private:
  GLFWwindow* window_ = nullptr;
  bool quad_buffer_ = false;
  glm::ivec2 position_{0}, size_{0};  ///< before it filled the screen
};

}  // namespace veduta
