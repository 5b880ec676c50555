#include "worker/obstacles.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace veduta {

namespace {

std::vector<Box> bounds_of(const ExposedSurface& surface) {
  std::vector<Box> bounds;
  bounds.reserve(surface.size());
  for (uint32_t p = 0; p < surface.size(); ++p) {
    Box box;
    for (uint32_t c = surface.begin[p]; c < surface.begin[p + 1]; ++c) {
      // Rounded outwards, so that the box holds the piece.
      const glm::vec3 rounded(surface.corners[c]);
      constexpr float infinity = std::numeric_limits<float>::infinity();
      for (int axis = 0; axis < 3; ++axis) {
        box.lower[axis] = std::min(box.lower[axis], std::nextafter(rounded[axis], -infinity));
        box.upper[axis] = std::max(box.upper[axis], std::nextafter(rounded[axis], infinity));
      }
    }
    bounds.push_back(box);
  }
  return bounds;
}

}  // namespace

Obstacles::Obstacles(const ExposedSurface& surface, double cell_m)
    : surface_(surface), index_(bounds_of(surface), cell_m) {}

double Obstacles::nearest(uint32_t piece, const glm::dvec3& normal) const {
  double least = std::numeric_limits<double>::infinity();
  for (const glm::dvec3* corner = begin(piece); corner != end(piece); ++corner)
    least = std::min(least, glm::dot(normal, *corner));
  return least;
}

}  // namespace veduta
