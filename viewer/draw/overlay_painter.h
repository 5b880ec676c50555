// Boxes and lines: of view-cells, of what was searched for, of the eye on the map.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "gl/handle.h"
#include "gl/program.h"
#include "scene/box.h"

namespace veduta {

/// A box drawn by its edges, and by its faces where `fill` is not transparent.
struct ColouredBox {
  Box box;
  glm::vec4 edge{1};  ///< linear RGB, opacity
  glm::vec4 fill{0};
};

/// A line in the scene.
struct ColouredLine {
  glm::vec3 from{0}, to{0};
  glm::vec4 colour{1};  ///< linear RGB, opacity
};

/// A corner of a triangle of one colour.
struct ColouredPoint {
  glm::vec3 position_m{0};
  glm::vec4 colour{1};
};

class OverlayPainter {
 public:
  OverlayPainter();

  void load(std::span<const ColouredBox> boxes, std::span<const ColouredLine> lines);
  void load_triangles(std::span<const ColouredPoint> corners);  ///< three each, in place of what was loaded

  struct View {
    glm::vec3 position_m{0};
    glm::mat4 clip_from_offset{1};  ///< of (point - position_m)
    float nearest_w = 0;            ///< lines are cut where w is less
    glm::vec2 size_px{1};           ///< of the viewport
    float line_px = 2;              ///< width of lines
  };
  enum class Depth : uint8_t {
    ignored,    ///< over all that is there
    tested,     ///< faint where something is before it
    as_surface  ///< opaque, and hides what is behind it
  };
  /// Draws what was loaded into the current frame buffer.
  void draw(const View& view, Depth depth) const;

 private:
  void draw_triangles(const View& view, float opacity) const;
  void draw_lines(const View& view, float opacity) const;

  Program triangle_program_, line_program_;
  GlBuffer triangles_, lines_;
  GlVertexArray triangle_array_, line_array_;
  size_t corner_count_ = 0, line_count_ = 0;
};

}  // namespace veduta
