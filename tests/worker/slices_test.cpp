#include "worker/slices.h"

#include <gtest/gtest.h>

#include "tests/worker/mesh.h"

namespace veduta {
namespace {

using test::Mesh;
using test::Random;

/// Objects of random triangles, some large and some small, at coordinates of a kilometre.
Mesh random_objects(Random& random, int objects) {
  Mesh mesh;
  for (int o = 0; o < objects; ++o) {
    const glm::vec3 lower = random.point({{-1000, -1000, -20}, {1000, 1000, 20}});
    const Box room{lower, lower + random.point({{5, 5, 3}, {60, 40, 30}})};
    mesh.object();
    const int triangles = random.integer(1, 30);
    for (int t = 0; t < triangles; ++t) {
      const glm::vec3 a = random.point(room);
      const auto near = static_cast<float>(random.chance(0.5) ? 1.0 : 0.1);
      mesh.triangle(a, glm::mix(a, random.point(room), near), glm::mix(a, random.point(room), near));
    }
  }
  return mesh;
}

std::vector<SliceCounts> random_counts(Random& random, const Scene& scene, int most) {
  std::vector<SliceCounts> counts;
  const auto count = [&] { return static_cast<uint8_t>(random.integer(1, most)); };
  for (size_t o = 0; o < scene.objects.size(); ++o) counts.push_back({count(), count(), count()});
  return counts;
}

/// The slice, 1-based, of a value, by the definition: n equal parts of the object's bounds.
int slice_of(double value, double lower, double upper, int n) {
  return upper > lower
             ? std::clamp(static_cast<int>(std::floor((value - lower) * n / (upper - lower))) + 1, 1, n)
             : 1;
}

bool contains(const Box& box, const glm::dvec3& p, double slack) {
  for (int a = 0; a < 3; ++a) {
    if (p[a] < box.lower[a] - slack || p[a] > box.upper[a] + slack) return false;
  }
  return true;
}

TEST(ChooseSlices, OneForEverySliceSizeUpToTheMost) {
  Mesh mesh;
  mesh.object();
  mesh.box({{0, 0, 0}, {20, 9, 1}});
  mesh.object();
  mesh.box({{0, 0, 0}, {800, 4, 900}});
  const std::vector<SliceCounts> counts = choose_slices(mesh.scene, 8, 4.0);
  EXPECT_EQ(counts[0], (SliceCounts{5, 2, 1}));
  EXPECT_EQ(counts[1], (SliceCounts{8, 1, 8}));
  EXPECT_EQ(choose_slices(mesh.scene, 127, 4.0)[1], (SliceCounts{127, 1, 127}));
}

TEST(SliceTriangles, HoldEveryCornerAndNothingBeyond) {
  Random random(1);
  const Mesh mesh = random_objects(random, 60);
  const std::vector<SliceCounts> counts = random_counts(random, mesh.scene, 127);
  const std::vector<TriangleSlices> touched = slice_triangles(mesh.scene, counts);
  ASSERT_EQ(touched.size(), mesh.scene.triangles.size());
  for (size_t o = 0; o < mesh.scene.objects.size(); ++o) {
    const Object& object = mesh.scene.objects[o];
    const Box b = mesh.scene.bounds(o);
    for (uint64_t t = object.triangle_begin; t < object.triangle_end; ++t) {
      const int n[3] = {counts[o].x, counts[o].y, counts[o].z};
      const int first[3] = {touched[t].x_first, touched[t].y_first, touched[t].z_first};
      const int last[3] = {touched[t].x_last, touched[t].y_last, touched[t].z_last};
      for (int a = 0; a < 3; ++a) {
        double low = 1e30, high = -1e30;
        for (int corner = 0; corner < 3; ++corner) {
          const double value = mesh.scene.vertices[mesh.scene.triangles[t][corner]][a];
          low = std::min(low, value), high = std::max(high, value);
        }
        // A corner on a plane between slices may be given to either.
        const double tiny = 1e-9 * (b.upper[a] - b.lower[a]);
        ASSERT_GE(first[a], slice_of(low - tiny, b.lower[a], b.upper[a], n[a]));
        ASSERT_LE(first[a], slice_of(low + tiny, b.lower[a], b.upper[a], n[a]));
        ASSERT_GE(last[a], slice_of(high - tiny, b.lower[a], b.upper[a], n[a]));
        ASSERT_LE(last[a], slice_of(high + tiny, b.lower[a], b.upper[a], n[a]));
      }
    }
  }
}

TEST(SliceBoxes, HoldEveryPointOfATriangleInItsSliceAtItsHeight) {
  Random random(2);
  const Mesh mesh = random_objects(random, 80);
  const std::vector<SliceCounts> counts = random_counts(random, mesh.scene, 12);
  const SliceBoxes boxes = slice_boxes(mesh.scene, counts, slice_triangles(mesh.scene, counts));
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
        const int z = slice_of(p.z, b.lower.z, b.upper.z, counts[o].z);
        for (const int vertical : {x - 1, counts[o].x + y - 1}) {
          const VerticalSlice& slice = boxes.slices[boxes.object_slice_begin[o] + vertical];
          ASSERT_TRUE(contains(boxes.boxes[slice.first_box + z - 1], p, 1e-9))
              << "object " << o << ", slice " << vertical;
        }
      }
    }
  }
}

TEST(SliceBoxes, AreTightAndNested) {
  Random random(3);
  const Mesh mesh = random_objects(random, 80);
  const std::vector<SliceCounts> counts = random_counts(random, mesh.scene, 12);
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
  EXPECT_NEAR(box(4, 1).upper.z, 4, 2e-3);
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
