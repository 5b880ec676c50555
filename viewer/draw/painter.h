// Draws a city's pages, and what is shown beside them, into one picture for each eye, on the current GL
// context.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "viewer/draw/command_list.h"
#include "viewer/draw/map_painter.h"
#include "viewer/draw/overlay_painter.h"
#include "viewer/stereo.h"
#include "viewer/stream/page.h"

namespace veduta {

/// One buffer holds what is there of the city, vertices and elements; the city is one multi-draw call for
/// both eyes where the driver can draw to layers from vertex shaders, else one for each eye.
class Painter {
 public:
  /// The index has to outlive it. \param buffer_bytes for pages; less is taken where all of the city needs
  /// less. Pages of unequal size that come and go leave holes, so it should be more than the pages to be
  /// here. \throw Error(usage) when the driver lacks a feature or the memory.
  Painter(const PvsIndex& index, uint64_t buffer_bytes, int samples, bool allow_one_pass = true);
  ~Painter();

  /// Puts a page up. \return where; nothing when there is no hole that it fits in.
  std::optional<PagePlace> add(const Page& page);
  void remove(uint32_t page);

  /// Clears the pictures of these eyes, one or two, width x height pixels each. \throw Error(usage) for a
  /// size that the driver cannot draw.
  void begin(std::span<const EyeView> views, uint32_t width, uint32_t height);
  /// `lists`: one for all eyes, or one for each.
  void draw_city(std::span<const CommandList> lists);
  /// Over it, in red, what lists have nearer to the eye than all that was drawn.
  void draw_missing(std::span<const CommandList> lists);
  void draw_sky();
  /// Boxes and lines are faint where the city is before them.
  void draw_boxes(std::span<const ColouredBox> boxes);
  void draw_lines(std::span<const ColouredLine> lines);
  /// Draws the map over a rectangle of every eye's picture (x, y, width, height in pixels, y up), at the
  /// depth of the screen. `all`: commands of all pages that are here. `colours`: [N]; objects whose page is
  /// not here are drawn as their boxes. `boxes` and `lines` lie over all of it.
  void draw_map(const MapView& view, const CommandList& all, std::span<const MapColour> colours,
                std::span<const ColouredBox> boxes, std::span<const ColouredLine> lines,
                const glm::ivec4& rectangle);
  /// Calls draw() with each eye's finished picture as the current frame buffer (the HUD): no depth, colours
  /// stored as they are given. After all other drawing.
  template <typename Draw>
  void draw_over(const Draw& draw) {
    for (size_t eye = 0; eye < eye_count(); ++eye) {
      bind_picture(eye);
      draw();
    }
  }
  /// Ends the pictures; GL's state is the default again. \return a GL_TEXTURE_2D_ARRAY, one layer for each
  /// eye, sRGB; stays as it is until the next begin().
  uint32_t end();

  bool one_pass() const;  ///< are both eyes drawn by one call?
  std::string renderer() const;

 private:
  size_t eye_count() const;
  void bind_picture(size_t eye);
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace veduta
