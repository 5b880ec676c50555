#include "worker/three_bytes.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/worker/mesh.h"

namespace veduta {
namespace {

using test::Random;

/// An object known by the slices of its triangles alone: TriangleCounts asks for no more.
struct Sliced {
  Scene scene;
  std::vector<SliceCounts> counts;
  std::vector<TriangleSlices> touched;

  void add(Random& random, int most, int triangles) {
    const auto count = [&] { return static_cast<uint8_t>(random.integer(1, most)); };
    counts.push_back({count(), count(), count()});
    const uint64_t begin = touched.size();
    const auto range = [&](int n, uint8_t& first, uint8_t& last) {
      first = static_cast<uint8_t>(random.integer(1, n));
      last = static_cast<uint8_t>(std::min(n, first + (random.chance(0.7) ? 0 : random.integer(0, n))));
    };
    for (int t = 0; t < triangles; ++t) {
      TriangleSlices s;
      range(counts.back().x, s.x_first, s.x_last), range(counts.back().y, s.y_first, s.y_last);
      range(counts.back().z, s.z_first, s.z_last);
      touched.push_back(s);
    }
    scene.objects.push_back({"object", Kind::building, begin, touched.size()});
  }
};

/// Heights as occlusion leaves them: all or nothing at times, runs of equal ones at others.
std::vector<uint32_t> random_heights(Random& random, const SliceCounts& n) {
  std::vector<uint32_t> heights;
  const int kind = random.integer(0, 3);
  uint32_t last = static_cast<uint32_t>(random.integer(0, n.z));
  for (int i = 0; i < n.x + n.y; ++i) {
    if (kind == 0 || random.chance(0.3)) last = static_cast<uint32_t>(random.integer(0, n.z));
    if (kind == 1 && random.chance(0.6)) last = n.z;
    heights.push_back(last);
  }
  return heights;
}

/// Is the triangle wholly in slices that are hidden, seen along x or seen along y?
bool hidden(const TriangleSlices& t, const SliceCounts& n, const uint32_t* occluded) {
  bool x = true, y = true;
  for (int i = t.x_first; i <= t.x_last; ++i) x = x && occluded[i - 1] >= t.z_last;
  for (int i = t.y_first; i <= t.y_last; ++i) y = y && occluded[n.x + i - 1] >= t.z_last;
  return x || y;
}

/// Does an index leave out hidden slices alone? Slices are what was tested: a triangle is no witness.
bool conservative(VisibilityIndex index, const SliceCounts& n, const uint32_t* occluded) {
  const uint32_t height =
      index.z == 0 ? n.z : static_cast<uint32_t>(index.z) - 1;  // left out: z-slices 1..height
  const auto all_hidden = [&](const uint32_t* slice, int count, int byte) {
    for (int i = 1; i <= count; ++i) {
      const bool left_out = byte == 0 || (byte > 0 ? i > byte : i <= -byte);
      if (left_out && slice[i - 1] < height) return false;
    }
    return true;
  };
  if (index.x != 0) return all_hidden(occluded, n.x, index.x);
  if (index.y != 0) return all_hidden(occluded + n.x, n.y, index.y);
  return all_hidden(occluded, n.x, 0) || all_hidden(occluded + n.x, n.y, 0);
}

size_t saved(VisibilityIndex index, const Sliced& s, size_t object) {
  size_t count = 0;
  for (uint64_t t = s.scene.objects[object].triangle_begin; t < s.scene.objects[object].triangle_end; ++t)
    count += !draws(index, s.touched[t]);
  return count;
}

size_t best_saved(const Sliced& s, size_t object, const uint32_t* occluded) {
  const SliceCounts& n = s.counts[object];
  size_t best = 0;
  const auto consider = [&](int x, int y, int z) {
    const VisibilityIndex index{static_cast<int8_t>(x), static_cast<int8_t>(y), static_cast<int8_t>(z)};
    if (conservative(index, n, occluded)) best = std::max(best, saved(index, s, object));
  };
  for (int z = 0; z <= n.z; ++z) {
    for (int x = -n.x; x <= n.x; ++x) consider(x, 0, z);
    for (int y = -n.y; y <= n.y; ++y) consider(0, y, z);
  }
  return best;
}

TEST(ThreeBytes, NeverLeaveATriangleOutThatIsNotHiddenAndSaveTheMost) {
  Random random(1);
  Sliced s;
  constexpr int objects = 300;
  for (int o = 0; o < objects; ++o) s.add(random, o % 3 == 0 ? 3 : 9, random.integer(0, 25));
  const TriangleCounts counts(s.scene, s.counts, s.touched);
  size_t something = 0;
  for (uint32_t o = 0; o < objects; ++o) {
    for (int round = 0; round < 8; ++round) {
      const std::vector<uint32_t> occluded = random_heights(random, s.counts[o]);
      const VisibilityIndex index = counts.choose(o, occluded.data());
      for (uint64_t t = s.scene.objects[o].triangle_begin; t < s.scene.objects[o].triangle_end; ++t)
        ASSERT_TRUE(draws(index, s.touched[t]) || hidden(s.touched[t], s.counts[o], occluded.data()))
            << "object " << o;
      ASSERT_TRUE(conservative(index, s.counts[o], occluded.data())) << "object " << o;
      ASSERT_TRUE(index.x == 0 || index.y == 0);
      ASSERT_EQ(saved(index, s, o), best_saved(s, o, occluded.data())) << "object " << o;
      something += saved(index, s, o) > 0;
    }
  }
  EXPECT_GT(something, 500u);
}

TEST(ThreeBytes, AllHiddenIsNothingAndNothingHiddenIsAll) {
  Random random(2);
  Sliced s;
  for (int o = 0; o < 40; ++o) s.add(random, 127, 50);
  const TriangleCounts counts(s.scene, s.counts, s.touched);
  for (uint32_t o = 0; o < 40; ++o) {
    const SliceCounts& n = s.counts[o];
    std::vector<uint32_t> occluded(static_cast<size_t>(n.x) + n.y, n.z);
    EXPECT_TRUE(counts.choose(o, occluded.data()).nothing());
    std::fill(occluded.begin(), occluded.end(), 0);
    EXPECT_EQ(counts.choose(o, occluded.data()), completely_visible);
    // Hidden along one axis is hidden.
    std::fill(occluded.begin(), occluded.begin() + n.x, n.z);
    EXPECT_TRUE(counts.choose(o, occluded.data()).nothing());
    std::fill(occluded.begin(), occluded.begin() + n.x, 0);
    std::fill(occluded.begin() + n.x, occluded.end(), n.z);
    EXPECT_TRUE(counts.choose(o, occluded.data()).nothing());
  }
}

TEST(ThreeBytes, WeighsByTrianglesNotByArea) {
  Sliced
      s;  // four x-slices, two z-slices: 1 triangle in each of the right-hand three, 9 in the left-hand one
  s.counts.push_back({4, 1, 2});
  for (int t = 0; t < 9; ++t) s.touched.push_back({1, 1, 1, 1, 1, 1});
  for (uint8_t i = 2; i <= 4; ++i) s.touched.push_back({i, i, 1, 1, 1, 1});
  s.scene.objects.push_back({"object", Kind::building, 0, s.touched.size()});
  const TriangleCounts counts(s.scene, s.counts, s.touched);
  const uint32_t occluded[] = {2, 0, 2, 2, 0};  // the first slice, or the last two
  EXPECT_EQ(counts.choose(0, occluded), (VisibilityIndex{-1, 0, 0}));
}

}  // namespace
}  // namespace veduta
