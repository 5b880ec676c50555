// How many slices, and which of them triangles touch: worker/slices.h without its boxes.
#include <gtest/gtest.h>

#include "tests/worker/random_objects.h"
#include "worker/slices.h"

namespace veduta {
namespace {

using test::Mesh;
using test::Random;

/// Triangles drawn for nothing along an axis, in the mean over ends of the visible part, by trying `ends` of
/// them: a triangle beyond the end, of which a slice is not.
double drawn_for_nothing(const Scene& scene, int axis, int n, int ends) {
  SliceCounts counts;
  (axis == 0 ? counts.x : axis == 1 ? counts.y : counts.z) = static_cast<uint8_t>(n);
  const std::vector<TriangleSlices> touched = slice_triangles(scene, {counts});
  const Box b = scene.bounds(0);
  uint64_t drawn = 0;
  for (int k = 0; k < ends; ++k) {
    const double share = (k + 0.5) / ends, end = b.lower[axis] + share * (b.upper[axis] - b.lower[axis]);
    const int upto = std::min(n, static_cast<int>(share * n) + 1);  // the slice in which the end lies
    for (size_t t = 0; t < touched.size(); ++t) {
      double low = 1e30, high = -1e30;
      for (int corner = 0; corner < 3; ++corner) {
        const double value = scene.vertices[scene.triangles[t][corner]][axis];
        low = std::min(low, value), high = std::max(high, value);
      }
      const int first = axis == 0 ? touched[t].x_first : touched[t].y_first;
      const int last = axis == 0 ? touched[t].x_last : axis == 1 ? touched[t].y_last : touched[t].z_last;
      drawn += axis < 2 && low > end && first <= upto;  // visible up to the end
      drawn += high < end && last >= upto;              // visible from the end on
    }
  }
  return static_cast<double>(drawn) / ends;
}

TEST(ChooseSlices, AsManyAsPay) {
  Random random(4);
  const auto cost = [](const Scene& scene, int axis, int n) {
    return drawn_for_nothing(scene, axis, n, 2000) + n;
  };
  int many = 0;
  for (int round = 0; round < 12; ++round) {
    const Mesh mesh = test::random_objects(random, 1);
    const SliceCounts chosen = choose_slices(mesh.scene, 12).at(0);
    const Box b = mesh.scene.bounds(0);
    for (int axis = 0; axis < 3; ++axis) {
      const int count = axis == 0 ? chosen.x : axis == 1 ? chosen.y : chosen.z;
      const int least = std::clamp(static_cast<int>(std::lround((b.upper[axis] - b.lower[axis]) / 8)), 1, 12);
      ASSERT_GE(count, least);
      ASSERT_LE(count, 12);
      const double chosen_cost = cost(mesh.scene, axis, count);
      for (int n = least; n <= 12; ++n)
        ASSERT_LE(chosen_cost, cost(mesh.scene, axis, n) + 0.05)
            << "round " << round << ", " << n << " slices";
      many += count > least;
    }
  }
  EXPECT_GT(many, 6);
}

TEST(ChooseSlices, ForKnownObjects) {
  Mesh mesh;
  mesh.object();  // four walls, roof and floor: two pairs of triangles to tell apart along x and y
  mesh.box({{0, 0, 0}, {7, 6, 5}});
  mesh.object();  // too long for tight test boxes, and no triangle to save
  mesh.triangle({0, 0, 0}, {800, 0, 0}, {0, 4, 30});
  mesh.ground(0, 0, 10, 10, 3);  // no extent along z
  mesh.object();                 // a hundred small things in a row
  for (int i = 0; i < 100; ++i) {
    const auto x = static_cast<float>(i) * 0.1f;
    mesh.triangle({x, 0, 0}, {x + 0.05f, 0, 0}, {x, 0.01f, 0.01f});
  }
  const std::vector<SliceCounts> counts = choose_slices(mesh.scene, 8);
  EXPECT_EQ(counts[0], (SliceCounts{2, 2, 1}));
  EXPECT_EQ(counts[1], (SliceCounts{8, 1, 4}));
  EXPECT_EQ(counts[2].z, 1);
  EXPECT_EQ(counts[3], (SliceCounts{8, 1, 1}));
  EXPECT_EQ(choose_slices(mesh.scene, 1), std::vector<SliceCounts>(4));
  EXPECT_EQ(choose_slices(mesh.scene, 127)[1].x, 100);
  EXPECT_LT(choose_slices(mesh.scene, 127)[3].x, 40) << "more would not pay";
}

TEST(SliceTriangles, HoldEveryCornerAndNothingBeyond) {
  Random random(1);
  const Mesh mesh = test::random_objects(random, 60);
  const std::vector<SliceCounts> counts = test::random_slice_counts(random, mesh.scene, 127);
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
        ASSERT_GE(first[a], test::slice_of(low - tiny, b.lower[a], b.upper[a], n[a]));
        ASSERT_LE(first[a], test::slice_of(low + tiny, b.lower[a], b.upper[a], n[a]));
        ASSERT_GE(last[a], test::slice_of(high - tiny, b.lower[a], b.upper[a], n[a]));
        ASSERT_LE(last[a], test::slice_of(high + tiny, b.lower[a], b.upper[a], n[a]));
      }
    }
  }
}

}  // namespace
}  // namespace veduta
