// What the scenes of a campaign are made of: solids with a few numbers, so that a scene can be made simpler
// number by number.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace veduta::campaign {

enum class Shape : uint8_t {
  box,
  prism,    ///< over a regular polygon of `sides` corners
  ell,      ///< over an L
  gable,    ///< a house: its ridge along its own x
  spike,    ///< a pyramid over a rectangle
  sheet,    ///< one upright rectangle without thickness, along its own x
  terrain,  ///< a height field of 8 x 8 squares, `size.z` from its lowest to its highest point at most
};

/// Lengths in metres. Its own x and y are turned about z; then it is moved to `foot`.
struct Piece {
  Shape shape = Shape::box;
  glm::dvec3 foot{0};  ///< the middle of what it stands on
  glm::dvec3 size{1};
  double turn = 0;     ///< rad
  double lean = 0;     ///< its top is moved by so many heights along its own x
  int sides = 4;       ///< of a prism
  uint64_t bumps = 0;  ///< which terrain
  bool open_top = false, inverted = false, twice = false;

  bool operator==(const Piece&) const = default;
};

/// One object of the model.
struct Thing {
  std::string name;
  std::vector<Piece> pieces;

  bool operator==(const Thing&) const = default;
};

using Polygon = std::vector<glm::dvec3>;

/// Its faces, counter-clockwise seen from outside where it is not inverted.
std::vector<Polygon> faces(const Piece& piece);

/// Height of a terrain over a point.
double terrain_height(const Piece& terrain, const glm::dvec2& at);

}  // namespace veduta::campaign
