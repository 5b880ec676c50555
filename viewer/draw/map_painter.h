// The city from above, coloured by what the PVS says (thesis fig. 6.3).
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "gl/handle.h"
#include "gl/program.h"
#include "pvs/pvs_stream.h"
#include "viewer/draw/overlay_painter.h"

namespace veduta {

/// How the map colours an object, or that it does not draw it: completely visible red, partially visible
/// blue, invisible yellow.
enum class MapColour : uint8_t { hidden, complete, partial, invisible, ground };

struct MapView {
  glm::vec3 centre_m{0};
  float width_m = 600;  ///< across the picture
  float yaw_deg = 90;   ///< this direction is up
};

class MapPainter {
 public:
  MapPainter(const PvsIndex& index, bool to_layers);

  /// Takes over the colours, [N].
  void load(std::span<const MapColour> colours);
  /// How the map is seen in a rectangle (x, y, width, height in pixels).
  OverlayPainter::View look(const MapView& view, const glm::ivec4& rectangle) const;
  /// Makes ready for drawing the city's commands: its program, the view, the depth test.
  void use(const OverlayPainter::View& view) const;
  void set_first_eye(int eye) const;
  /// The roofs of the boxes of objects that are not here (of ground: the floors), as triangles.
  std::vector<ColouredPoint> absent(std::span<const MapColour> colours,
                                    const std::vector<bool>& object_here) const;

 private:
  const PvsIndex& index_;
  float lowest_m_ = 0, highest_m_ = 1;
  Program program_;
  GlTexture colours_;
  std::vector<MapColour> loaded_;
};

}  // namespace veduta
