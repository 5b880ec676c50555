#include "worker/occludee_quadtree.h"

#include <algorithm>
#include <array>
#include <glm/vec2.hpp>

namespace veduta {
namespace {

constexpr int most_levels = 24;  // objects at one place cannot be told apart

class Builder {
 public:
  Builder(const std::vector<Box>& boxes, uint32_t leaf_objects, OccludeeQuadtree& tree)
      : boxes_(boxes), leaf_objects_(leaf_objects), tree_(tree) {}

  /// Fills in a block that has its objects, over the square of half-edge `half_m` around `middle`.
  void divide(uint32_t block, const glm::vec2& middle, float half_m, int level) {
    const uint32_t first = tree_.blocks[block].first, count = tree_.blocks[block].count;
    const auto begin = tree_.objects.begin() + first, end = begin + count;
    for (auto o = begin; o != end; ++o) tree_.blocks[block].bounds.extend(boxes_[*o]);
    if (count <= leaf_objects_ || level == most_levels) return;
    const auto upper_y = std::stable_partition(begin, end, [&](uint32_t o) { return y(o) < middle.y; });
    const auto is_left = [&](uint32_t o) { return x(o) < middle.x; };
    const std::array starts{begin, std::stable_partition(begin, upper_y, is_left), upper_y,
                            std::stable_partition(upper_y, end, is_left), end};
    tree_.blocks[block].first_child = static_cast<uint32_t>(tree_.blocks.size());
    std::array<int, 4> quarters{};
    uint32_t children = 0;
    for (int quarter = 0; quarter < 4; ++quarter) {
      if (starts[quarter] == starts[quarter + 1]) continue;
      quarters[children++] = quarter;
      tree_.blocks.push_back({{},
                              0,
                              0,
                              static_cast<uint32_t>(starts[quarter] - tree_.objects.begin()),
                              static_cast<uint32_t>(starts[quarter + 1] - starts[quarter])});
    }
    tree_.blocks[block].children = children;
    const uint32_t child = tree_.blocks[block].first_child;
    const float step = 0.5f * half_m;
    for (uint32_t c = 0; c < children; ++c) {
      const bool right = quarters[c] % 2 == 1, upper = quarters[c] / 2 == 1;
      divide(child + c, middle + glm::vec2(right ? step : -step, upper ? step : -step), step, level + 1);
    }
  }

 private:
  float x(uint32_t o) const { return boxes_[o].center().x; }
  float y(uint32_t o) const { return boxes_[o].center().y; }

  const std::vector<Box>& boxes_;
  uint32_t leaf_objects_;
  OccludeeQuadtree& tree_;
};

}  // namespace

OccludeeQuadtree make_occludee_quadtree(const std::vector<Box>& object_boxes, uint32_t leaf_objects) {
  OccludeeQuadtree tree;
  Box ground;
  for (uint32_t o = 0; o < object_boxes.size(); ++o) {
    if (object_boxes[o].empty()) continue;
    tree.objects.push_back(o);
    ground.extend(object_boxes[o].center());
  }
  if (tree.objects.empty()) return tree;
  tree.blocks.push_back({{}, 0, 0, 0, static_cast<uint32_t>(tree.objects.size())});
  const glm::vec3 half = ground.half_extent();
  Builder(object_boxes, leaf_objects, tree)
      .divide(0, {ground.center().x, ground.center().y}, std::max(half.x, half.y), 0);
  return tree;
}

}  // namespace veduta
