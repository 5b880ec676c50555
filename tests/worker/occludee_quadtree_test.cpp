#include "worker/occludee_quadtree.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/worker/mesh.h"

namespace veduta {
namespace {

bool within(const Box& inner, const Box& outer) {
  return outer.contains(inner.lower) && outer.contains(inner.upper);
}

/// Counts the objects of the leaves below a block, and checks its bounds and its children's.
size_t check_block(const OccludeeQuadtree& tree, uint32_t number, const std::vector<Box>& boxes,
                   uint32_t leaf_objects) {
  const QuadtreeBlock& block = tree.blocks[number];
  Box tight;
  for (uint32_t n = block.first; n < block.first + block.count; ++n) tight.extend(boxes[tree.objects[n]]);
  EXPECT_EQ(block.bounds, tight);
  EXPECT_GT(block.count, 0u);
  if (block.children == 0) {
    EXPECT_LE(block.count, leaf_objects);
    return block.count;
  }
  EXPECT_GT(block.count, leaf_objects);
  EXPECT_LE(block.children, 4u);
  size_t objects = 0;
  for (uint32_t c = block.first_child; c < block.first_child + block.children; ++c) {
    EXPECT_TRUE(within(tree.blocks[c].bounds, block.bounds));
    EXPECT_GE(tree.blocks[c].first, block.first);
    objects += check_block(tree, c, boxes, leaf_objects);
  }
  EXPECT_EQ(objects, block.count);
  return objects;
}

TEST(OccludeeQuadtree, EveryObjectIsInOneLeaf) {
  test::Random random(1);
  for (const int count : {1, 8, 9, 300}) {
    std::vector<Box> boxes;
    for (int n = 0; n < count; ++n) {
      const glm::vec3 lower = random.point({{-500, 20, 0}, {900, 300, 5}});
      boxes.push_back({lower, lower + random.point({{0, 0, 0}, {40, 40, 30}})});
    }
    const OccludeeQuadtree tree = make_occludee_quadtree(boxes);
    EXPECT_EQ(check_block(tree, 0, boxes, 8), boxes.size());
    std::vector<uint32_t> sorted = tree.objects;
    std::sort(sorted.begin(), sorted.end());
    for (uint32_t o = 0; o < boxes.size(); ++o) EXPECT_EQ(sorted[o], o);
  }
}

TEST(OccludeeQuadtree, BlocksAreSquaresOfGround) {
  // Two rows far apart share no block but the root.
  std::vector<Box> boxes;
  for (int n = 0; n < 12; ++n) {
    const glm::vec3 p(n % 2 == 0 ? 0 : 100, n, 0);
    boxes.push_back({p, p + 0.5f});
  }
  const OccludeeQuadtree tree = make_occludee_quadtree(boxes);
  ASSERT_EQ(tree.blocks.size(), 5u);
  for (const uint32_t child : {1u, 2u, 3u, 4u}) {
    const Box& bounds = tree.blocks[child].bounds;
    EXPECT_LT(bounds.upper.x - bounds.lower.x, 1);
    EXPECT_EQ(tree.blocks[child].count, 3u);
  }
}

TEST(OccludeeQuadtree, ObjectsWithoutBoundsAreInNoBlock) {
  EXPECT_TRUE(make_occludee_quadtree({}).blocks.empty());
  EXPECT_TRUE(make_occludee_quadtree({Box{}, Box{}}).blocks.empty());
  const OccludeeQuadtree tree = make_occludee_quadtree({Box{}, {{1, 2, 3}, {4, 5, 6}}});
  ASSERT_EQ(tree.blocks.size(), 1u);
  EXPECT_EQ(tree.objects, std::vector<uint32_t>{1});
}

TEST(OccludeeQuadtree, ManyObjectsAtOnePlaceEnd) {
  const std::vector<Box> boxes(50, Box{{1, 1, 0}, {2, 2, 3}});
  const OccludeeQuadtree tree = make_occludee_quadtree(boxes);
  EXPECT_EQ(tree.objects.size(), 50u);
  EXPECT_LE(tree.blocks.size(), 30u);
}

}  // namespace
}  // namespace veduta
