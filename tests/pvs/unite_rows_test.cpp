#include "pvs/unite_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>

namespace veduta {
namespace {

constexpr int8_t slices = 3;

// All indices of an object of this many slices, and some that name more.
std::vector<VisibilityIndex> all_indices() {
  std::vector<VisibilityIndex> indices;
  for (int8_t z = 0; z <= slices + 1; ++z) {
    indices.push_back({0, 0, z});
    for (int8_t k = -slices; k <= slices; ++k)
      if (k != 0) indices.push_back({k, 0, z}), indices.push_back({0, k, z});
  }
  return indices;
}

// In each place of the lattice a triangle of one slice and a long one.
std::vector<TriangleSlices> all_triangles() {
  std::vector<TriangleSlices> triangles;
  for (uint8_t x = 1; x <= slices; ++x)
    for (uint8_t y = 1; y <= slices; ++y)
      for (uint8_t z = 1; z <= slices; ++z) {
        triangles.push_back({x, x, y, y, z, z});
        triangles.push_back({x, slices, y, slices, z, slices});
      }
  return triangles;
}

bool draws_any(const PvsRow& row, const TriangleSlices& triangle) {
  return std::any_of(row.begin(), row.end(),
                     [&](const PvsEntry& entry) { return draws(entry.index, triangle); });
}

PvsRow united(const PvsRow& a, const PvsRow& b) {
  PvsRow out{{99, {1, 1, 1}}};  // what was there before is gone
  unite_rows(a, b, out);
  return out;
}

TEST(UniteRows, ObjectsOfEitherByAscendingNumber) {
  const PvsRow a{{0, completely_visible}, {2, {0, 0, 3}}, {9, {0, 2, 0}}};
  const PvsRow b{{1, completely_visible}, {2, {1, 0, 0}}};
  const PvsRow both{{0, completely_visible}, {1, completely_visible}, {2, {1, 0, 3}}, {9, {0, 2, 0}}};
  EXPECT_EQ(united(a, b), both);
  EXPECT_EQ(united(b, a), both);
  EXPECT_EQ(united(a, a), a);
  EXPECT_EQ(united(a, {}), a);
  EXPECT_EQ(united({}, a), a);
  EXPECT_TRUE(united({}, {}).empty());
}

TEST(UniteRows, DrawsWhatEitherRowDraws) {
  const std::vector<TriangleSlices> triangles = all_triangles();
  for (const VisibilityIndex& a : all_indices())
    for (const VisibilityIndex& b : all_indices()) {
      const PvsRow row = united({{7, a}}, {{7, b}});
      ASSERT_LE(row.size(), 2u);
      for (const TriangleSlices& t : triangles) ASSERT_EQ(draws_any(row, t), draws(a, t) || draws(b, t));
      EXPECT_TRUE(row.size() < 2 || row[1].index.z == 0) << "z is drawn once";
      for (const PvsEntry& entry : row) {
        EXPECT_EQ(entry.object, 7u);
        EXPECT_FALSE(entry.index.nothing());
        EXPECT_TRUE(entry.index.x == 0 || entry.index.y == 0) << "drawn from two ranges at the most";
      }
    }
}

TEST(UniteRows, ThreeRowsInAnyOrder) {
  const std::vector<TriangleSlices> triangles = all_triangles();
  const std::vector<VisibilityIndex> indices = all_indices();
  for (size_t i = 0; i < indices.size(); i += 3)
    for (size_t j = 0; j < indices.size(); ++j)
      for (size_t k = 0; k < indices.size(); k += 2) {
        if (indices[i].nothing() || indices[j].nothing() || indices[k].nothing()) continue;
        const PvsRow a{{7, indices[i]}}, b{{7, indices[j]}}, c{{7, indices[k]}};
        for (const PvsRow& row : {united(united(a, b), c), united(c, united(a, b))}) {
          ASSERT_LE(row.size(), 3u);
          for (const TriangleSlices& t : triangles)
            ASSERT_EQ(draws_any(row, t), draws_any(a, t) || draws_any(b, t) || draws_any(c, t));
        }
      }
}

}  // namespace
}  // namespace veduta
