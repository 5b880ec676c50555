#include "worker/canonical_axes.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <tuple>
#include <vector>

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

OctreeForest CanonicalAxes::from_canonical(const OctreeForest& forest) const {
  constexpr unsigned mixed = 2;
  OctreeForest turned = forest;
  // Root n reaches from lower + n edges to lower + (n + 1) edges; negated, it is number -1 - n from -lower.
  turned.lower = from_canonical(forest.lower);
  std::vector<uint32_t> queue(
      forest.roots.size());  // nodes of the canonical forest in the turned one's order
  std::iota(queue.begin(), queue.end(), 0u);
  for (glm::ivec3& root : turned.roots) {
    if (swap) std::swap(root.x, root.y);
    if (negate_x) root.x = -1 - root.x;
    if (negate_y) root.y = -1 - root.y;
  }
  std::sort(queue.begin(), queue.end(), [&, roots = turned.roots](uint32_t a, uint32_t b) {
    return std::tie(roots[a].z, roots[a].y, roots[a].x) < std::tie(roots[b].z, roots[b].y, roots[b].x);
  });
  std::vector<glm::ivec3> sorted;
  for (const uint32_t root : queue) sorted.push_back(turned.roots[root]);
  turned.roots = std::move(sorted);

  // The canonical child that lies where child k of the turned tree is.
  const auto source = [&](unsigned k) {
    unsigned x = k & 1u, y = k >> 1 & 1u;
    if (negate_x) x ^= 1u;
    if (negate_y) y ^= 1u;
    if (swap) std::swap(x, y);
    return x | y << 1 | (k & 4u);
  };
  turned.states.clear(), turned.first_child.clear();
  for (size_t q = 0; q < queue.size(); ++q) {  // breadth first, so that siblings stay together
    const unsigned states = forest.states[queue[q]];
    std::array<uint32_t, 8> child{};
    uint32_t next = forest.first_child[queue[q]];
    for (unsigned k = 0; k < 8; ++k) {
      if ((states >> 2 * k & 3u) == mixed) child[k] = next++;
    }
    unsigned turned_states = 0;
    const size_t first = queue.size();
    for (unsigned k = 0; k < 8; ++k) {
      const unsigned state = states >> 2 * source(k) & 3u;
      turned_states |= state << 2 * k;
      if (state == mixed) queue.push_back(child[source(k)]);
    }
    turned.states.push_back(static_cast<uint16_t>(turned_states));
    turned.first_child.push_back(queue.size() > first ? static_cast<uint32_t>(first) : 0);
  }
  return turned;
}

}  // namespace veduta
