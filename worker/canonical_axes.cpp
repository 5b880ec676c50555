#include "worker/canonical_axes.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace veduta {
namespace {

/// Sums of powers of a coordinate in whole units: exact, so that neither order nor sign leaves a trace.
struct PowerSums {
  __extension__ using Integer = __int128;
  int64_t count = 0;
  Integer first = 0, second = 0, third = 0;

  void add(int64_t value) {
    ++count;
    first += value, second += Integer{value} * value, third += Integer{value} * value * value;
  }
  // Rounding is symmetric about zero, so moments of -x are those of x, or their negative, to the last bit.
  double mean() const { return static_cast<double>(first) / static_cast<double>(count); }
  double variance() const {
    return static_cast<double>(second) / static_cast<double>(count) - mean() * mean();
  }
  double skewness() const {  // third central moment
    const double m = mean(), n = static_cast<double>(count);
    return static_cast<double>(third) / n - 3 * m * (static_cast<double>(second) / n) + 2 * m * m * m;
  }
};

}  // namespace

CanonicalAxes choose_axes(const Scene& scene) {
  float largest = 0;
  visit_placed_triangles(scene, [&](const PlacedTriangle& t) {
    for (const glm::vec3& c : t.corner) largest = std::max({largest, std::abs(c.x), std::abs(c.y)});
  });
  CanonicalAxes axes;
  if (!(largest > 0)) return axes;
  // 2^24 units for the largest coordinate: cubes of as many corners as there can be fit in 128 bits.
  const int scale = 24 - std::ilogb(largest);
  const auto units = [&](float value) { return std::llround(std::ldexp(static_cast<double>(value), scale)); };
  PowerSums x, y;
  visit_placed_triangles(scene, [&](const PlacedTriangle& t) {
    for (const glm::vec3& c : t.corner) x.add(units(c.x)), y.add(units(c.y));
  });
  axes.negate_x = x.skewness() < 0, axes.negate_y = y.skewness() < 0;
  axes.swap = y.variance() > x.variance();
  return axes;
}

Box CanonicalAxes::to_canonical(const Box& box) const {
  if (box.empty()) return box;
  Box turned;
  turned.extend(to_canonical(box.lower)), turned.extend(to_canonical(box.upper));
  return turned;
}

Box CanonicalAxes::from_canonical(const Box& box) const {
  if (box.empty()) return box;
  Box turned;
  turned.extend(from_canonical(box.lower)), turned.extend(from_canonical(box.upper));
  return turned;
}

PlacedTriangle CanonicalAxes::to_canonical(PlacedTriangle triangle) const {
  for (glm::vec3& corner : triangle.corner) corner = to_canonical(corner);
  if (mirrors()) std::swap(triangle.corner[1], triangle.corner[2]);
  return triangle;
}

void CanonicalAxes::turn_back(OccluderMesh& mesh) const {
  for (glm::vec3& corner : mesh.corners) corner = from_canonical(corner);
  if (!mirrors()) return;
  for (size_t f = 0; f < mesh.faces(); ++f)
    std::reverse(mesh.corners.begin() + mesh.face_begin[f], mesh.corners.begin() + mesh.face_begin[f + 1]);
}

HeightField CanonicalAxes::from_canonical(const HeightField& field) const {
  HeightField turned = field;
  if (swap) std::swap(turned.nx, turned.ny), std::swap(turned.lower_x, turned.lower_y);
  const auto far_side = [&](float lower, uint32_t count) {
    return static_cast<float>(-(static_cast<double>(lower) + static_cast<double>(count) * field.step_m));
  };
  if (negate_x) turned.lower_x = far_side(turned.lower_x, turned.nx);
  if (negate_y) turned.lower_y = far_side(turned.lower_y, turned.ny);
  for (uint32_t j = 0; j < turned.ny; ++j) {
    for (uint32_t i = 0; i < turned.nx; ++i) {
      uint32_t a = negate_x ? turned.nx - 1 - i : i, b = negate_y ? turned.ny - 1 - j : j;
      if (swap) std::swap(a, b);
      turned.height[static_cast<size_t>(j) * turned.nx + i] =
          field.height[static_cast<size_t>(b) * field.nx + a];
    }
  }
  return turned;
}

FreeOctree CanonicalAxes::from_canonical(const FreeOctree& octree) const {
  constexpr unsigned mixed = 2;
  FreeOctree turned = octree;
  const double edge = std::ldexp(static_cast<double>(octree.leaf_size_m), static_cast<int>(octree.depth));
  if (swap) std::swap(turned.lower.x, turned.lower.y);
  if (negate_x) turned.lower.x = static_cast<float>(-(static_cast<double>(turned.lower.x) + edge));
  if (negate_y) turned.lower.y = static_cast<float>(-(static_cast<double>(turned.lower.y) + edge));
  if (octree.states.empty()) return turned;
  // The canonical child that lies where child k of the turned tree is.
  const auto source = [&](unsigned k) {
    unsigned x = k & 1u, y = k >> 1 & 1u;
    if (negate_x) x ^= 1u;
    if (negate_y) y ^= 1u;
    if (swap) std::swap(x, y);
    return x | y << 1 | (k & 4u);
  };
  turned.states.clear(), turned.first_child.clear();
  std::vector<uint32_t> queue{
      0};  // nodes of the canonical tree, breadth first, so that siblings stay together
  for (size_t q = 0; q < queue.size(); ++q) {
    const unsigned states = octree.states[queue[q]];
    std::array<uint32_t, 8> child{};
    uint32_t next = octree.first_child[queue[q]];
    for (unsigned k = 0; k < 8; ++k) {
      if ((states >> 2 * k & 3u) == mixed) child[k] = next++;
    }
    unsigned turned_states = 0;
    turned.first_child.push_back(static_cast<uint32_t>(queue.size()));
    for (unsigned k = 0; k < 8; ++k) {
      const unsigned state = states >> 2 * source(k) & 3u;
      turned_states |= state << 2 * k;
      if (state == mixed) queue.push_back(child[source(k)]);
    }
    turned.states.push_back(static_cast<uint16_t>(turned_states));
  }
  return turned;
}

}  // namespace veduta
