#include "worker/slices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

#include "tests/worker/random_objects.h"
#include "worker/three_bytes.h"

namespace veduta {
namespace {

using test::Mesh;
using test::Random;
using test::random_objects;
using test::random_slice_counts;
using test::slice_of;

bool contains(const Box& box, const glm::dvec3& p, double slack) {
  for (int a = 0; a < 3; ++a) {
    if (p[a] < box.lower[a] - slack || p[a] > box.upper[a] + slack) return false;
  }
  return true;
}

TEST(SliceBoxes, HoldEveryPointOfATriangleInItsSliceFromItsHighestOn) {
  Random random(2);
  const Mesh mesh = random_objects(random, 80);
  const std::vector<SliceCounts> counts = random_slice_counts(random, mesh.scene, 12);
  const std::vector<TriangleSlices> touched = slice_triangles(mesh.scene, counts);
  const SliceBoxes boxes = slice_boxes(mesh.scene, counts, touched);
  for (size_t o = 0; o < mesh.scene.objects.size(); ++o) {
    const Object& object = mesh.scene.objects[o];
    const Box b = mesh.scene.bounds(o);
    for (uint64_t t = object.triangle_begin; t < object.triangle_end; ++t) {
      const glm::uvec3 v = mesh.scene.triangles[t];
      for (int sample = 0; sample < 40; ++sample) {
        double s = random.real(0, 1), r = random.real(0, 1);
        if (s + r > 1) s = 1 - s, r = 1 - r;
        if (sample < 3) s = sample == 1, r = sample == 2;  // the corners
        const glm::dvec3 a(mesh.scene.vertices[v.x]), ab(mesh.scene.vertices[v.y]),
            ac(mesh.scene.vertices[v.z]);
        const glm::dvec3 p = a + s * (ab - a) + r * (ac - a);
        const int x = slice_of(p.x, b.lower.x, b.upper.x, counts[o].x),
                  y = slice_of(p.y, b.lower.y, b.upper.y, counts[o].y);
        for (const int vertical : {x - 1, counts[o].x + y - 1}) {
          const VerticalSlice& slice = boxes.slices[boxes.object_slice_begin[o] + vertical];
          ASSERT_TRUE(contains(boxes.boxes[slice.first_box + touched[t].z_last - 1], p, 1e-9))
              << "object " << o << ", slice " << vertical;
        }
      }
    }
  }
}

TEST(SliceBoxes, AreTightAndNested) {
  Random random(3);
  const Mesh mesh = random_objects(random, 80);
  const std::vector<SliceCounts> counts = random_slice_counts(random, mesh.scene, 12);
  const SliceBoxes boxes = slice_boxes(mesh.scene, counts, slice_triangles(mesh.scene, counts));
  ASSERT_EQ(boxes.object_slice_begin.size(), mesh.scene.objects.size() + 1);
  ASSERT_EQ(boxes.object_slice_begin.back(), boxes.slices.size());
  size_t next_box = 0;
  for (uint32_t o = 0; o < mesh.scene.objects.size(); ++o) {
    const Box b = mesh.scene.bounds(o);
    const uint32_t begin = boxes.object_slice_begin[o];
    ASSERT_EQ(boxes.object_slice_begin[o + 1] - begin, static_cast<uint32_t>(counts[o].x + counts[o].y));
    Box all;
    for (int i = 0; i < counts[o].x + counts[o].y; ++i) {
      const VerticalSlice& slice = boxes.slices[begin + i];
      ASSERT_EQ(slice.object, o);
      ASSERT_EQ(slice.heights, counts[o].z);
      ASSERT_EQ(slice.first_box, next_box);
      next_box += slice.heights;
      const int axis = i < counts[o].x ? 0 : 1, n = axis == 0 ? counts[o].x : counts[o].y,
                k = axis == 0 ? i : i - counts[o].x;
      const double step = (b.upper[axis] - b.lower[axis]) / n, z_step = (b.upper.z - b.lower.z) / counts[o].z;
      for (uint32_t h = 0; h < slice.heights; ++h) {
        const Box& box = boxes.boxes[slice.first_box + h];
        if (box.empty()) continue;
        all.extend(box);
        ASSERT_TRUE(contains(b, box.lower, 1e-3) && contains(b, box.upper, 1e-3)) << "outside of the object";
        const double slack = 1e-3 + 1e-3 * step;
        ASSERT_GE(box.lower[axis], b.lower[axis] + k * step - slack);
        ASSERT_LE(box.upper[axis], b.lower[axis] + (k + 1) * step + slack);
        ASSERT_LE(box.upper.z, b.lower.z + (h + 1) * z_step + 1e-3 + 1e-3 * z_step);
        if (h == 0) continue;
        const Box& below = boxes.boxes[slice.first_box + h - 1];
        if (below.empty()) continue;
        ASSERT_TRUE(contains(box, below.lower, 0) && contains(box, below.upper, 0)) << "not nested";
      }
      for (uint32_t h = 1; h < slice.heights; ++h) {
        ASSERT_FALSE(boxes.boxes[slice.first_box + h].empty() &&
                     !boxes.boxes[slice.first_box + h - 1].empty());
      }
    }
    for (int a = 0; a < 3; ++a) {
      ASSERT_NEAR(all.lower[a], b.lower[a], 1e-3);
      ASSERT_NEAR(all.upper[a], b.upper[a], 1e-3);
    }
  }
  EXPECT_EQ(boxes.boxes.size(), next_box);
}

/// Bounds of the part of a triangle in a slab of an axis: its corners in there, and where its edges cross the
/// slab's planes.
Box bounds_in_slab(const std::array<glm::dvec3, 3>& corner, int axis, double low, double high) {
  Box box;
  for (size_t i = 0; i < 3; ++i) {
    const glm::dvec3 &a = corner[i], &b = corner[(i + 1) % 3];
    if (a[axis] >= low && a[axis] <= high) box.extend(glm::vec3(a));
    for (const double plane : {low, high}) {
      if ((a[axis] < plane) != (b[axis] < plane))
        box.extend(glm::vec3(glm::mix(a, b, (plane - a[axis]) / (b[axis] - a[axis]))));
    }
  }
  return box;
}

TEST(SliceBoxes, AreTheBoundsOfWhatARowLeavesOut) {
  Random random(5);
  const Mesh mesh = random_objects(random, 60);
  const std::vector<SliceCounts> counts = random_slice_counts(random, mesh.scene, 9);
  const std::vector<TriangleSlices> touched = slice_triangles(mesh.scene, counts);
  const SliceBoxes boxes = slice_boxes(mesh.scene, counts, touched);
  int compared = 0;
  for (uint32_t o = 0; o < mesh.scene.objects.size(); ++o) {
    const Object& object = mesh.scene.objects[o];
    const Box b = mesh.scene.bounds(o);
    for (int i = 0; i < counts[o].x + counts[o].y; ++i) {
      const int axis = i < counts[o].x ? 0 : 1, n = axis == 0 ? counts[o].x : counts[o].y,
                k = axis == 0 ? i : i - counts[o].x;
      const double step = (static_cast<double>(b.upper[axis]) - b.lower[axis]) / n;
      for (int h = 0; h < counts[o].z; ++h) {
        Box expected;
        for (uint64_t t = object.triangle_begin; t < object.triangle_end; ++t) {
          if (touched[t].z_last > h + 1) continue;
          const glm::uvec3 v = mesh.scene.triangles[t];
          const auto& vertices = mesh.scene.vertices;
          const Box part = bounds_in_slab(
              {glm::dvec3(vertices[v.x]), glm::dvec3(vertices[v.y]), glm::dvec3(vertices[v.z])}, axis,
              b.lower[axis] + k * step, b.lower[axis] + (k + 1) * step);
          if (!part.empty()) expected.extend(part);
        }
        if (expected.empty()) continue;  // a corner on a plane may have been given to either side
        const Box& box = boxes.boxes[boxes.slices[boxes.object_slice_begin[o] + i].first_box + h];
        ASSERT_TRUE(contains(box, expected.lower, 1e-4) && contains(box, expected.upper, 1e-4));
        // The slab is a little thicker than the slice: along a triangle that is nearly flat in it, by more.
        ASSERT_TRUE(contains(expected, box.lower, 0.1) && contains(expected, box.upper, 0.1));
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 1000);
}

// From boxes to bytes: whatever space is hidden, what a row leaves out lies in it.
TEST(SliceBoxes, ARowLeavesOutNothingButWhatLiesInHiddenSpace) {
  Random random(6);
  const Mesh mesh = random_objects(random, 60);
  const std::vector<SliceCounts> counts = random_slice_counts(random, mesh.scene, 9);
  const std::vector<TriangleSlices> touched = slice_triangles(mesh.scene, counts);
  const SliceBoxes boxes = slice_boxes(mesh.scene, counts, touched);
  const TriangleCounts triangle_counts(mesh.scene, counts, touched);
  int left_out = 0, drawn_in_part = 0;
  for (uint32_t o = 0; o < mesh.scene.objects.size(); ++o) {
    const Object& object = mesh.scene.objects[o];
    for (int round = 0; round < 40; ++round) {
      // A half-space over a side or a corner of the object, or what is below a height.
      const auto upwards = static_cast<float>(round % 3);
      const glm::vec3 normal = random.point({{-1, -1, -0.3f}, {1, 1, 1}}) * glm::vec3(1, 1, upwards);
      const float bound = glm::dot(normal, random.point(mesh.scene.bounds(o)));
      const auto hidden = [&](const glm::vec3& p) { return glm::dot(normal, p) <= bound; };
      const auto box_hidden = [&](const Box& box) {
        bool all = true;
        for (int k = 0; k < 8 && !box.empty(); ++k)
          all = all && hidden({k & 1 ? box.upper.x : box.lower.x, k & 2 ? box.upper.y : box.lower.y,
                               k & 4 ? box.upper.z : box.lower.z});
        return all;
      };
      std::vector<uint32_t> occluded;
      for (uint32_t i = boxes.object_slice_begin[o]; i < boxes.object_slice_begin[o + 1]; ++i) {
        const Box* box = &boxes.boxes[boxes.slices[i].first_box];
        const Box* end = box + boxes.slices[i].heights;
        occluded.push_back(static_cast<uint32_t>(std::find_if_not(box, end, box_hidden) - box));
      }
      const VisibilityIndex index = triangle_counts.choose(o, occluded.data());
      int drawn = 0;
      for (uint64_t t = object.triangle_begin; t < object.triangle_end; ++t) {
        if (draws(index, touched[t])) {
          ++drawn;
          continue;
        }
        for (int corner = 0; corner < 3; ++corner)
          ASSERT_TRUE(hidden(mesh.scene.vertices[mesh.scene.triangles[t][corner]])) << "object " << o;
        ++left_out;
      }
      drawn_in_part += drawn > 0 && !(index == completely_visible);
    }
  }
  EXPECT_GT(left_out, 500);
  EXPECT_GT(drawn_in_part, 100);
}

TEST(SliceBoxes, ABlockWithoutTrianglesIsEmpty) {
  Mesh mesh;  // two small things at either end of an object: nothing between, and nothing high on the left
  mesh.object();
  mesh.box({{0, 0, 0}, {1, 1, 1}});
  mesh.box({{9, 0, 0}, {10, 1, 8}});
  const std::vector<SliceCounts> counts{{5, 1, 4}};
  const SliceBoxes boxes = slice_boxes(mesh.scene, counts, slice_triangles(mesh.scene, counts));
  const auto box = [&](int slice, int height) { return boxes.boxes[boxes.slices[slice].first_box + height]; };
  for (int slice = 1; slice <= 3; ++slice) {
    for (int h = 0; h < 4; ++h) EXPECT_TRUE(box(slice, h).empty()) << slice << ' ' << h;
  }
  for (int h = 0; h < 4; ++h)
    EXPECT_NEAR(box(0, h).upper.z, 1, 1e-3) << "cumulated boxes do not grow into nothing";
  EXPECT_NEAR(box(4, 2).upper.z, 0, 1e-3) << "its walls reach the top, so its floor alone may be left out";
  EXPECT_NEAR(box(4, 3).upper.z, 8, 1e-3);
  EXPECT_NEAR(box(4, 1).lower.x, 9, 1e-3);
}

TEST(SliceBoxes, FlatObjectsHaveAll) {
  Mesh mesh;
  mesh.ground(0, 0, 10, 10, 3);  // no extent along z
  const std::vector<SliceCounts> counts{{2, 2, 3}};
  const std::vector<TriangleSlices> touched = slice_triangles(mesh.scene, counts);
  const SliceBoxes boxes = slice_boxes(mesh.scene, counts, touched);
  for (const TriangleSlices& t : touched) EXPECT_EQ(t.z_last, 1);
  for (const Box& box : boxes.boxes) {
    ASSERT_FALSE(box.empty());
    EXPECT_NEAR(box.lower.z, 3, 1e-3);
    EXPECT_NEAR(box.upper.z, 3, 1e-3);
  }
}

}  // namespace
}  // namespace veduta
