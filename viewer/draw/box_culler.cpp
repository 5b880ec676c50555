#include "viewer/draw/box_culler.h"

#include <algorithm>
#include <cmath>

namespace veduta {

BoxBlocks::BoxBlocks(const std::vector<Box>& boxes) : blocks_((boxes.size() + width - 1) / width) {
  for (size_t i = 0; i < boxes.size(); ++i) {
    const Box& box = boxes[i];
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<size_t>(axis);
      blocks_[i / width].side[a][i % width] = box.lower[axis];
      blocks_[i / width].side[a + 3][i % width] = box.upper[axis];
      if (!box.empty())
        largest_[a] =
            std::max({largest_[a], std::abs(double{box.lower[axis]}), std::abs(double{box.upper[axis]})});
    }
  }
}

BoxCuller::BoxCuller(const BoxBlocks& boxes, std::span<const Frustum> frusta) : boxes_(boxes) {
  for (const Frustum& frustum : frusta) {
    std::array<Plane, planes_each>& planes = planes_.emplace_back();
    for (size_t p = 0; p < planes_each; ++p) {
      const Frustum::Plane& from = frustum.planes[p];
      double greatest = std::abs(from.offset);  // that any sum on the way can be
      for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<size_t>(axis);
        planes[p].normal[a] = static_cast<float>(from.normal[axis]);
        planes[p].side_of[a] = static_cast<uint8_t>(from.normal[axis] > 0 ? a + 3 : a);
        greatest += std::abs(from.normal[axis]) * boxes.largest()[a];
      }
      // Each of the four terms is rounded when it is made, and each of the three sums: half an epsilon of
      // `greatest` for each of them at the most.
      const double slack = 4 * double{std::numeric_limits<float>::epsilon()} * greatest;
      planes[p].offset = static_cast<float>(from.offset + slack);
    }
  }
}

void BoxCuller::test(size_t block) {
  tested_ = block;
  const BoxBlocks::Block& boxes = boxes_[block];
  std::array<float, BoxBlocks::width> best;
  best.fill(-std::numeric_limits<float>::infinity());
  for (const std::array<Plane, planes_each>& planes : planes_) {
    std::array<float, BoxBlocks::width> least;
    least.fill(std::numeric_limits<float>::infinity());
    for (const Plane& plane : planes) {
      const std::array<float, BoxBlocks::width>&x = boxes.side[plane.side_of[0]],
                              &y = boxes.side[plane.side_of[1]], &z = boxes.side[plane.side_of[2]];
      for (size_t i = 0; i < BoxBlocks::width; ++i) {
        const float inside =
            plane.normal[0] * x[i] + plane.normal[1] * y[i] + plane.normal[2] * z[i] + plane.offset;
        least[i] = inside < least[i] ? inside : least[i];
      }
    }
    for (size_t i = 0; i < BoxBlocks::width; ++i) best[i] = least[i] > best[i] ? least[i] : best[i];
  }
  nearest_ = best;
}

}  // namespace veduta
