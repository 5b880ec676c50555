// A small town that can be laid down anywhere, turned, mirrored, in any unit.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <utility>
#include <vector>

#include "worker/canonical_axes.h"

namespace veduta::hard {

/// How a city is laid down: turned, then scaled, then moved.
struct Placing {
  CanonicalAxes turn;
  double scale = 1;
  glm::dvec3 shift{0};

  glm::dvec3 operator()(const glm::dvec3& p) const { return scale * turn.to_canonical(p) + shift; }
  glm::dvec3 back(const glm::dvec3& p) const { return turn.from_canonical((p - shift) / scale); }
};

/// Houses of storeys beside streets, lopsided, some turned. Coordinates are multiples of 2^-8 m, so that
/// doubles hold them 10^7 m away and floats near the origin. The ground is a road, which is not cut into
/// tiles: tiles lie on a lattice of their own.
class Town {
 public:
  Town() {
    add("road", {-41, -35, -1}, {43, 37, 0}, 0, 1);
    add("wall", {9, -20, 0}, {17, 12, 9}, 0, 3);
    add("behind", {21, -12, 0}, {25, -9, 3}, 0, 1);
    add("tower", {27, -4, 0}, {33, 2, 33}, 0, 11);
    add("turned", {-17, 6, 0}, {-9, 20, 7.5}, 0.5, 3);
    add("behind_turned", {-31, 19, 0}, {-24, 27, 8}, 0.2, 2);
    add("south", {-20, -23, 0}, {6, -13, 8}, 0, 2);
    add("behind_south", {-14, -31, 0}, {-6, -28, 18}, 0, 6);
    add("pole", {4, 9, 0}, {4.25, 9.25, 5}, 0, 1);
    add("far", {36, 20, 0}, {41, 33, 15}, 0.1, 4);
  }

  /// As triangles, so that all placings have the same ones; facing outwards.
  std::string text(const Placing& place) const {
    std::string text;
    for (const auto& [name, triangles] : objects_) {
      text += "o " + name + "\n";
      for (const auto& t : triangles) {
        for (const glm::dvec3& corner : t) {
          const glm::dvec3 p = place(corner);
          text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
        }
        text += place.turn.mirrors() ? "f -3 -1 -2\n" : "f -3 -2 -1\n";
      }
    }
    return text;
  }

 private:
  using Triangle = std::array<glm::dvec3, 3>;

  void add(const std::string& name, const glm::dvec3& lower, const glm::dvec3& upper, double turn,
           int storeys) {
    const glm::dvec3 middle = 0.5 * (lower + upper), half = 0.5 * (upper - lower);
    const auto exact = [](double x) { return std::round(x * 256) / 256; };
    std::array<glm::dvec2, 4> outline;
    for (size_t n = 0; n < 4; ++n) {
      const double x = (n == 1 || n == 2 ? 1 : -1) * half.x, y = (n >= 2 ? 1 : -1) * half.y;
      outline[n] = {exact(middle.x + std::cos(turn) * x - std::sin(turn) * y),
                    exact(middle.y + std::sin(turn) * x + std::cos(turn) * y)};
    }
    std::vector<Triangle> triangles;
    const auto quad = [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                          const glm::dvec3& d) {
      triangles.push_back({a, b, c}), triangles.push_back({a, c, d});
    };
    for (int storey = 0; storey < storeys; ++storey) {
      const double z0 = exact(lower.z + (upper.z - lower.z) * storey / storeys);
      const double z1 = exact(lower.z + (upper.z - lower.z) * (storey + 1) / storeys);
      for (size_t n = 0; n < 4; ++n) {
        const glm::dvec2 &a = outline[n], &b = outline[(n + 1) % 4];
        quad({a, z0}, {b, z0}, {b, z1}, {a, z1});
      }
    }
    const auto& [a, b, c, d] = outline;
    quad({d, lower.z}, {c, lower.z}, {b, lower.z}, {a, lower.z});
    quad({a, upper.z}, {b, upper.z}, {c, upper.z}, {d, upper.z});
    objects_.emplace_back(name, triangles);
  }

  std::vector<std::pair<std::string, std::vector<Triangle>>> objects_;
};

}  // namespace veduta::hard
