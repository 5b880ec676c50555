// Draws a city's pages, and what is shown beside them, into one picture for each eye, on the current GL
// context.
#pragma once

#include <cstdint>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <vector>

#include "scene/box.h"
#include "viewer/draw/command_list.h"
#include "viewer/stereo.h"
#include "viewer/stream/page.h"

namespace veduta {

/// A box drawn by its edges, and by its faces where `fill` is not transparent.
struct ColouredBox {
  Box box;
  glm::vec4 edge{1};  ///< linear RGB, opacity
  glm::vec4 fill{0};
};

/// A line in the scene.
struct ColouredLine {
  glm::vec3 from, to;
  glm::vec4 colour{1};
};

/// How the map colours an object (fig. 6.3), or that it does not draw it.
enum class MapColour : uint8_t { hidden, completely_visible, partially_visible, invisible, ground };

struct MapView {
  glm::vec3 centre_m{0};
  float width_m = 600;  ///< across the picture
  float yaw_deg = 90;   ///< this direction is up
};

/// One vertex buffer and one element buffer hold what is there of the city; the city is one multi-draw call
/// for both eyes where the driver can draw to layers from vertex shaders, else one for each eye.
class Painter {
 public:
  /// \throw Error(usage) when the driver lacks a feature or the memory.
  Painter(const PvsIndex& index, uint64_t buffer_bytes, int samples, bool allow_one_pass = true);
  ~Painter();

  /// Puts a page up. \return where; nothing when there is no hole that it fits in.
  std::optional<PagePlace> add(const Page& page);
  void remove(uint32_t page);

  /// Clears the pictures of these eyes, width x height pixels each. \throw Error(usage) for too large a size.
  void begin(std::span<const EyeView> views, uint32_t width, uint32_t height);
  /// `lists`: one for all eyes, or one for each.
  void draw_city(std::span<const CommandList> lists);
  /// Over it, in red, what lists have nearer to the eye than all that was drawn.
  void draw_missing(std::span<const CommandList> lists);
  void draw_sky();
  void draw_boxes(std::span<const ColouredBox> boxes);
  void draw_lines(std::span<const ColouredLine> lines);
  /// Draws the map over a rectangle of every eye's picture (x, y, width, height in pixels, y up), at the
  /// depth of the screen. `colours`: [N]; objects whose page is not here are drawn as their boxes.
  void draw_map(const MapView& view, const CommandList& all, std::span<const MapColour> colours,
                std::span<const ColouredBox> boxes, const glm::ivec4& rectangle);
  /// Calls draw() with each eye's picture as the current frame buffer (the HUD).
  template <typename Draw>
  void draw_over(const Draw& draw) {
    for (size_t eye = 0; eye < eye_count(); ++eye) {
      bind_eye(eye);
      draw();
    }
  }
  /// Ends the pictures. \return a GL_TEXTURE_2D_ARRAY, one layer for each eye, sRGB.
  uint32_t end();

  bool one_pass() const;  ///< are both eyes drawn by one call?
  std::string renderer() const;

 private:
  size_t eye_count() const;
  void bind_eye(size_t eye);
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace veduta
