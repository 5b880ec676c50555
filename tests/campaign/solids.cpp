#include "tests/campaign/solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

#include "scene/random.h"

namespace veduta::campaign {
namespace {

constexpr int squares = 8;  // of a terrain, along an edge

glm::dvec2 turned(const glm::dvec2& p, double angle) {
  // Quarter turns are exact, so that what was snapped stays so.
  const double quarters = angle / (0.5 * std::numbers::pi);
  if (quarters == std::round(quarters)) {
    constexpr std::array<glm::dvec2, 4> along{glm::dvec2{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    const glm::dvec2 x = along[static_cast<size_t>(static_cast<int64_t>(quarters) & 3)];
    return {p.x * x.x - p.y * x.y, p.x * x.y + p.y * x.x};
  }
  const double c = std::cos(angle), s = std::sin(angle);
  return {p.x * c - p.y * s, p.x * s + p.y * c};
}

/// Counter-clockwise, around 0.
std::vector<glm::dvec2> outline(const Piece& piece) {
  const double x = 0.5 * piece.size.x, y = 0.5 * piece.size.y;
  if (piece.shape == Shape::ell) return {{-x, -y}, {x, -y}, {x, 0}, {0, 0}, {0, y}, {-x, y}};
  if (piece.shape != Shape::prism) return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
  std::vector<glm::dvec2> corners;
  for (int n = 0; n < piece.sides; ++n) {
    const double angle = 2 * std::numbers::pi * n / piece.sides;
    corners.push_back({x * std::cos(angle), y * std::sin(angle)});
  }
  return corners;
}

void add_walls(const std::vector<glm::dvec2>& corners, double height, std::vector<Polygon>& all) {
  for (size_t n = 0; n < corners.size(); ++n) {
    const glm::dvec2 &a = corners[n], &b = corners[(n + 1) % corners.size()];
    all.push_back({{a, 0}, {b, 0}, {b, height}, {a, height}});
  }
}

Polygon floor_of(const std::vector<glm::dvec2>& corners) {
  Polygon polygon;
  for (auto corner = corners.rbegin(); corner != corners.rend(); ++corner) polygon.push_back({*corner, 0});
  return polygon;
}

std::vector<Polygon> prism(const Piece& piece) {
  const std::vector<glm::dvec2> corners = outline(piece);
  std::vector<Polygon> all{floor_of(corners)};
  add_walls(corners, piece.size.z, all);
  if (piece.open_top) return all;
  Polygon& lid = all.emplace_back();
  for (const glm::dvec2& corner : corners) lid.push_back({corner, piece.size.z});
  return all;
}

std::vector<Polygon> gable(const Piece& piece) {
  const double x = 0.5 * piece.size.x, y = 0.5 * piece.size.y, eaves = 0.6 * piece.size.z,
               ridge = piece.size.z;
  std::vector<Polygon> all{floor_of(outline(piece))};
  all.push_back({{-x, -y, 0}, {x, -y, 0}, {x, -y, eaves}, {-x, -y, eaves}});
  all.push_back({{x, y, 0}, {-x, y, 0}, {-x, y, eaves}, {x, y, eaves}});
  all.push_back({{x, -y, 0}, {x, y, 0}, {x, y, eaves}, {x, 0, ridge}, {x, -y, eaves}});
  all.push_back({{-x, y, 0}, {-x, -y, 0}, {-x, -y, eaves}, {-x, 0, ridge}, {-x, y, eaves}});
  if (piece.open_top) return all;
  all.push_back({{-x, -y, eaves}, {x, -y, eaves}, {x, 0, ridge}, {-x, 0, ridge}});
  all.push_back({{x, y, eaves}, {-x, y, eaves}, {-x, 0, ridge}, {x, 0, ridge}});
  return all;
}

std::vector<Polygon> spike(const Piece& piece) {
  const std::vector<glm::dvec2> corners = outline(piece);
  std::vector<Polygon> all{floor_of(corners)};
  for (size_t n = 0; n < corners.size(); ++n)
    all.push_back({{corners[n], 0}, {corners[(n + 1) % corners.size()], 0}, {0, 0, piece.size.z}});
  return all;
}

/// Height of a terrain at a corner of its squares, above its foot.
double bump(const Piece& terrain, int i, int j) {
  const auto stream = static_cast<uint64_t>(j * (squares + 1) + i);
  return terrain.size.z * static_cast<double>(Random(terrain.bumps, stream).unit());
}

std::vector<Polygon> terrain(const Piece& piece) {
  std::vector<Polygon> all;
  const auto corner = [&](int i, int j) {
    return glm::dvec3(piece.size.x * (1.0 * i / squares - 0.5), piece.size.y * (1.0 * j / squares - 0.5),
                      bump(piece, i, j));
  };
  for (int j = 0; j < squares; ++j) {
    for (int i = 0; i < squares; ++i) {
      all.push_back({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)});
      all.push_back({corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)});
    }
  }
  return all;
}

std::vector<Polygon> upright(const Piece& piece) {
  const double x = 0.5 * piece.size.x;
  switch (piece.shape) {
    case Shape::gable:
      return gable(piece);
    case Shape::spike:
      return spike(piece);
    case Shape::sheet:
      return {{{-x, 0, 0}, {x, 0, 0}, {x, 0, piece.size.z}, {-x, 0, piece.size.z}}};
    case Shape::terrain:
      return terrain(piece);
    default:
      return prism(piece);
  }
}

}  // namespace

std::vector<Polygon> faces(const Piece& piece) {
  std::vector<Polygon> all = upright(piece);
  for (Polygon& polygon : all) {
    for (glm::dvec3& p : polygon)
      p = piece.foot + glm::dvec3(turned({p.x + piece.lean * p.z, p.y}, piece.turn), p.z);
    if (piece.inverted) std::reverse(polygon.begin(), polygon.end());
  }
  if (piece.twice) {
    const std::vector<Polygon> again = all;
    all.insert(all.end(), again.begin(), again.end());
  }
  return all;
}

double terrain_height(const Piece& terrain, const glm::dvec2& at) {
  const glm::dvec2 from_corner = (at - glm::dvec2(terrain.foot)) / glm::dvec2(terrain.size) + 0.5;
  const glm::dvec2 place = glm::clamp(from_corner, 0.0, 1.0) * static_cast<double>(squares);
  const int i = std::min(static_cast<int>(place.x), squares - 1),
            j = std::min(static_cast<int>(place.y), squares - 1);
  const double u = place.x - i, v = place.y - j;
  const double here = bump(terrain, i, j), across = bump(terrain, i + 1, j + 1);
  const double third = u > v ? bump(terrain, i + 1, j) : bump(terrain, i, j + 1);
  const double along =
      u > v ? (third - here) * u + (across - third) * v : (third - here) * v + (across - third) * u;
  return terrain.foot.z + here + along;
}

}  // namespace veduta::campaign
