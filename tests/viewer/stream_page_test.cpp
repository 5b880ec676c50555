#include "viewer/stream/page.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "tests/viewer/memory_source.h"

namespace veduta {
namespace {

PvsIndex index_of_triangles(const std::vector<uint64_t>& triangles) {
  PvsIndex index;
  uint64_t begin = 0;
  for (uint64_t count : triangles) {
    const float x = static_cast<float>(index.objects.size());
    index.objects.push_back({"", Kind::building, begin, begin + count});
    index.bounds.push_back(count == 0 ? Box{} : Box{{x, 0, 0}, {x + 1, 1, 1}});
    index.slices.push_back({});
    begin += count;
  }
  return index;
}

TEST(Pages, AreRunsOfWholeObjects) {
  const std::vector<PageSpan> pages = make_pages(index_of_triangles({40, 60, 1, 0, 500, 0, 100, 20}), 100);
  ASSERT_EQ(pages.size(), 5u);
  const std::array<std::array<uint64_t, 3>, 5> expected{
      {{0, 2, 100}, {2, 4, 1}, {4, 6, 500}, {6, 7, 100}, {7, 8, 20}}};
  for (size_t p = 0; p < pages.size(); ++p) {
    EXPECT_EQ(pages[p].first_object, expected[p][0]);
    EXPECT_EQ(pages[p].last_object, expected[p][1]);
    EXPECT_EQ(pages[p].triangles, expected[p][2]);
  }
  EXPECT_EQ(pages[0].bounds, (Box{{0, 0, 0}, {2, 1, 1}}));
  EXPECT_EQ(pages[1].bounds, (Box{{2, 0, 0}, {3, 1, 1}}));  // the object without triangles is nowhere
}

TEST(Pages, OfNothing) {
  EXPECT_TRUE(make_pages(PvsIndex{}).empty());
  const std::vector<PageSpan> pages = make_pages(index_of_triangles({0, 0}));
  ASSERT_EQ(pages.size(), 1u);
  EXPECT_EQ(pages[0].last_object, 2u);
  EXPECT_TRUE(pages[0].bounds.empty());
}

using Corners = std::array<std::array<float, 3>, 3>;

Corners corners(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  return {{{a.x, a.y, a.z}, {b.x, b.y, b.z}, {c.x, c.y, c.z}}};
}

TEST(Pages, TheirRangesDrawWhatTheThreeBytesSay) {
  City city = toy::make_street().file.city;
  // Other slices than floors as well: triangle t of the tower from x-slice 1 + t % 3 to 1 + t % 4.
  const Object& tower = city.scene.objects[toy::Street::tower];
  city.slices[toy::Street::tower] = {4, 1, 6};
  for (uint64_t t = tower.triangle_begin; t < tower.triangle_end; ++t) {
    city.triangle_slices[t].x_first = static_cast<uint8_t>(1 + std::min(t % 3, t % 4));
    city.triangle_slices[t].x_last = static_cast<uint8_t>(1 + std::max(t % 3, t % 4));
  }
  const uint32_t first = toy::Street::shed, last = toy::Street::tower + 1;
  const Page page = make_page(toy::slice_of(city, first, last), first, 7);
  EXPECT_EQ(page.number, 7u);
  ASSERT_EQ(page.elements.size(), order_count * 3 * page.triangles);
  EXPECT_LE(page.gpu_bytes(), most_gpu_bytes(page.triangles));

  size_t drawn_somewhere = 0;
  for (uint32_t object = first; object < last; ++object)
    for (VisibilityIndex index :
         {VisibilityIndex{0, 0, 1}, {0, 0, 4}, {2, 0, 0}, {-2, 0, 5}, {1, 0, 6}, {0, 0, 0}}) {
      std::vector<Corners> expected, drawn;
      const Object& o = city.scene.objects[object];
      for (uint64_t t = o.triangle_begin; t < o.triangle_end; ++t)
        if (draws(index, city.triangle_slices[t])) {
          const glm::uvec3 v = city.scene.triangles[t];
          expected.push_back(
              corners(city.scene.vertices[v.x], city.scene.vertices[v.y], city.scene.vertices[v.z]));
        }
      const ObjectRanges ranges = page.ranges.ranges(object - first, index);
      for (uint8_t r = 0; r < ranges.count; ++r) {
        const TriangleRange& range = ranges.range[r];
        for (uint64_t i = range.begin; i < range.end; ++i) {
          const uint64_t e = 3 * (static_cast<uint64_t>(range.order) * page.triangles + i);
          const auto vertex = [&](uint64_t k) { return page.vertices[page.elements[e + k]]; };
          EXPECT_EQ(vertex(0).object, object);
          drawn.push_back(corners(vertex(0).position_m, vertex(1).position_m, vertex(2).position_m));
        }
      }
      std::sort(expected.begin(), expected.end());
      std::sort(drawn.begin(), drawn.end());
      drawn.erase(std::unique(drawn.begin(), drawn.end()), drawn.end());  // ranges may overlap
      EXPECT_EQ(drawn, expected) << "object " << object << ", z " << int{index.z} << ", x " << int{index.x};
      drawn_somewhere += drawn.size();
    }
  EXPECT_GT(drawn_somewhere, 60u);
}

}  // namespace
}  // namespace veduta
