#include "viewer/draw/box_culler.h"

#include <cmath>
#include <glm/common.hpp>
#include <limits>

namespace veduta {

glm::dvec3 largest_coordinates(std::span<const Box> boxes) {
  glm::dvec3 largest(0);
  for (const Box& box : boxes)
    if (!box.empty())
      largest = glm::max(largest, glm::max(glm::abs(glm::dvec3(box.lower)), glm::abs(glm::dvec3(box.upper))));
  return largest;
}

BoxCuller::BoxCuller(std::span<const Frustum> frusta, const glm::dvec3& largest) {
  for (const Frustum& frustum : frusta) {
    auto& planes = planes_.emplace_back();
    for (size_t p = 0; p < planes.size(); ++p) {
      const Frustum::Plane& from = frustum.planes[p];
      double greatest = std::abs(from.offset);  // that any sum on the way can be
      for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<size_t>(axis);
        planes[p].normal[a] = static_cast<float>(from.normal[axis]);
        planes[p].side_of[a] = static_cast<uint8_t>(from.normal[axis] > 0 ? a + 3 : a);
        greatest += std::abs(from.normal[axis]) * largest[axis];
      }
      // Seven roundings on a term's way at the most, of half an epsilon of `greatest` at the most.
      const double slack = 4 * double{std::numeric_limits<float>::epsilon()} * greatest;
      planes[p].offset = static_cast<float>(from.offset + slack);
    }
  }
}

// A function of its own: inlined, GCC 12 joins the loops over planes and boxes, and is half as fast.
[[gnu::noinline]] BoxCuller::Nearest BoxCuller::inside(const Plane& plane, const BoxBatch& boxes) {
  const auto &x = boxes.side[plane.side_of[0]], &y = boxes.side[plane.side_of[1]],
             &z = boxes.side[plane.side_of[2]];
  const auto [across, along, up] = plane.normal;
  const float offset = plane.offset;
  Nearest result;
  for (size_t i = 0; i < BoxBatch::capacity; ++i)
    result[i] = across * x[i] + along * y[i] + up * z[i] + offset;
  return result;
}

BoxCuller::Nearest BoxCuller::test(const BoxBatch& boxes) const {
  Nearest nearest;
  nearest.fill(planes_.empty() ? 0 : -std::numeric_limits<float>::infinity());
  for (const auto& planes : planes_) {
    Nearest least;
    least.fill(std::numeric_limits<float>::infinity());
    for (const Plane& plane : planes) {
      const Nearest other = inside(plane, boxes);
      for (size_t i = 0; i < BoxBatch::capacity; ++i) least[i] = other[i] < least[i] ? other[i] : least[i];
    }
    for (size_t i = 0; i < BoxBatch::capacity; ++i)
      nearest[i] = nearest[i] < least[i] ? least[i] : nearest[i];
  }
  return nearest;
}

}  // namespace veduta
