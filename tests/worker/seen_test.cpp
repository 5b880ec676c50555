#include "worker/seen.h"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/verify/toy_city.h"
#include "tests/worker/mesh.h"

namespace veduta {
namespace {

/// A toy city, cut into slices.
struct Toy {
  City city;
  SliceBoxes boxes;

  Toy(Scene scene, const std::vector<Box>& cells, SliceCounts counts = {}) {
    city = toy::make_file(std::move(scene), cells, std::vector<PvsRow>(cells.size())).city;
    city.slices.assign(city.scene.objects.size(), counts);
    city.triangle_slices = slice_triangles(city.scene, city.slices);
    boxes = slice_boxes(city.scene, city.slices, city.triangle_slices);
  }
  std::vector<uint32_t> all() const {
    std::vector<uint32_t> objects(city.scene.objects.size());
    std::iota(objects.begin(), objects.end(), 0);
    return objects;
  }
};

std::vector<uint32_t> numbers(const Seen& seen) {
  std::vector<uint32_t> objects;
  for (uint32_t o = 0; o < seen.object.size(); ++o)
    if (seen.object[o] != 0) objects.push_back(o);
  return objects;
}

TEST(Seen, WhatStandsInTheOpenIsSeenAndWhatAWallHidesIsNot) {
  using toy::Street;
  const Toy toy(Street::scene(), {Street::cell()});
  const SeenSampler sampler(toy.city, toy.boxes);
  Seen seen;
  sampler.look(0, seen);
  sampler.aim(toy.all(), 1000, seen);
  EXPECT_EQ(numbers(seen), (std::vector<uint32_t>{Street::ground, Street::wall, Street::tower}));
  EXPECT_EQ(seen.objects, 3u);
}

// Eyes and objects below the top of a ring of walls: nothing outside can be seen. What a needle of a tower
// shows above it can.
TEST(Seen, ClosedWallsHideWhateverTheCity) {
  for (uint32_t seed = 0; seed < 6; ++seed) {
    test::Random random(seed);
    const auto real = [&](double a, double b) { return static_cast<float>(random.real(a, b)); };
    const float in = real(4, 12), out = in + real(0.5, 3), top = real(4, 9);
    Scene scene;
    toy::add_box(scene, "ground", {{-60, -60, -0.2f}, {60, 60, 0}}, Kind::terrain);
    toy::add_box(scene, "north", {{-out, in, 0}, {out, out, top}});
    toy::add_box(scene, "south", {{-out, -out, 0}, {out, -in, top}});
    toy::add_box(scene, "east", {{in, -out, 0}, {out, out, top}});
    toy::add_box(scene, "west", {{-out, -out, 0}, {-in, out, top}});
    const uint32_t tower = toy::add_box(scene, "tower", {{-2, 50, 0}, {0, 52, 60}});
    while (scene.objects.size() < 40) {
      const float x = real(-58, 50), y = real(-58, 44);
      const Box box{{x, y, 0}, {x + real(1, 6), y + real(1, 6), real(0.5, 0.999 * top)}};
      if (!toy::touch(box, {{-out, -out, 0}, {out, out, 1}}))
        toy::add_box(scene, std::to_string(scene.objects.size()), box);
    }
    const float edge = real(0.5, in - 1);
    const Toy toy(std::move(scene), {{{-edge, -edge, 1.45f}, {edge, edge, 1.95f}}});
    const SeenSampler sampler(toy.city, toy.boxes);
    Seen seen;
    sampler.look(0, seen);
    sampler.aim(toy.all(), 200, seen);
    EXPECT_EQ(numbers(seen), (std::vector<uint32_t>{0, 1, 2, 3, 4, tower})) << "city " << seed;
  }
}

// A wall of 12 m before a tower of 40 m, in slices of 5 m: the sight line from the farthest and highest eye
// over the near edge of the wall meets the front at 1.95 + (12 - 1.95) * 40 / 20 = 22.05 m.
TEST(Seen, TheLowestSliceIsTheOneInWhichSightEnds) {
  Scene scene;
  const uint32_t wall = toy::add_box(scene, "wall", {{20, -60, 0}, {21, 60, 12}});
  // Eight floors: of walls in one piece, none could be left out.
  const uint32_t tower = toy::add_box(scene, "tower", {{40, -20, 0}, {60, 20, 4.9f}});
  for (int floor = 1; floor < 8; ++floor) {
    const auto z = static_cast<float>(5 * floor);
    toy::add_box(scene, "floor", {{40, -20, z}, {60, 20, z + 4.9f}});
    scene.objects[tower].triangle_end = scene.objects.back().triangle_end;
    scene.objects.pop_back();
  }
  const uint32_t shed = toy::add_box(scene, "shed", {{25, -2, 0}, {28, 2, 3}});
  const Toy toy(std::move(scene), {{{0, -4, 1.45f}, {4, 4, 1.95f}}}, {1, 4, 8});
  const SeenSampler sampler(toy.city, toy.boxes);
  Seen seen;
  sampler.look(0, seen);
  const auto lowest = [&](uint32_t object, uint32_t slice) {
    return int{seen.lowest[toy.boxes.object_slice_begin[object] + slice]};
  };
  ASSERT_EQ(toy.boxes.object_slice_begin[tower + 1] - toy.boxes.object_slice_begin[tower], 5u);
  for (uint32_t slice = 0; slice < 5; ++slice) {
    EXPECT_EQ(lowest(tower, slice), 4) << "slice " << slice;
    EXPECT_EQ(lowest(shed, slice), 8) << "none: its count of z-slices";
  }
  EXPECT_EQ(lowest(wall, 0), 7) << "all that is seen of it reaches its top";
}

TEST(Seen, AnswersDoNotDependOnWhatWasAskedBefore) {
  using toy::Street;
  const Toy toy(Street::scene(), {Street::cell(), {{-8, -8, 1.45f}, {-4, -4, 1.95f}}}, {2, 2, 2});
  const auto look = [&](const SeenSampler& sampler, uint32_t cell, Seen& seen) {
    sampler.look(cell, seen);
    sampler.aim(toy.all(), 20, seen);
  };
  const SeenSampler first(toy.city, toy.boxes), second(toy.city, toy.boxes);
  Seen a, b;
  look(first, 0, a);
  look(second, 1, b);
  EXPECT_NE(a.eyes, b.eyes);
  look(second, 0, b);
  EXPECT_EQ(a.eyes, b.eyes);
  EXPECT_EQ(a.object, b.object);
  EXPECT_EQ(a.lowest, b.lowest);
  EXPECT_EQ(a.objects, b.objects);
  EXPECT_EQ(a.rays, b.rays);
}

TEST(Seen, AimingStopsAtWhatIsSeen) {
  using toy::Street;
  const Toy toy(Street::scene(), {Street::cell()});
  const SeenSampler sampler(toy.city, toy.boxes);
  Seen seen;
  sampler.look(0, seen);
  const uint64_t rays = seen.rays;
  const uint32_t wall = Street::wall;
  sampler.aim({&wall, 1}, 100, seen);
  EXPECT_EQ(seen.rays, rays) << "the wall was seen before";
  const uint32_t hut = Street::hut;
  sampler.aim({&hut, 1}, 100, seen);
  EXPECT_EQ(seen.rays, rays + 100) << "the hut never is";
}

TEST(Seen, NothingIsSeenWhereThereIsNothingOrNobody) {
  Seen seen;
  const Toy empty(Scene{}, {toy::Street::cell()});
  const SeenSampler of_empty(empty.city, empty.boxes);
  of_empty.look(0, seen);
  EXPECT_EQ(seen.objects, 0u);
  EXPECT_TRUE(seen.eyes.empty() && seen.object.empty() && seen.lowest.empty());

  // A cell inside of the wall.
  const Toy street(toy::Street::scene(), {{{10.2f, 0, 3}, {10.8f, 4, 4}}});
  const SeenSampler sampler(street.city, street.boxes);
  sampler.look(0, seen);
  sampler.aim(street.all(), 10, seen);
  EXPECT_TRUE(seen.eyes.empty());
  EXPECT_EQ(seen.objects, 0u);
  EXPECT_EQ(seen.rays, 0u);
  EXPECT_EQ(seen.lowest, std::vector<uint8_t>(8, 1));
}

TEST(Seen, ObjectsWithoutTrianglesAreNoAim) {
  Scene scene = toy::Street::scene();
  scene.objects.push_back({"nothing", Kind::other, scene.triangles.size(), scene.triangles.size()});
  scene.objects.insert(scene.objects.begin(), Object{"nothing yet", Kind::other, 0, 0});
  const Toy toy(std::move(scene), {toy::Street::cell()});
  const SeenSampler sampler(toy.city, toy.boxes);
  Seen seen;
  sampler.look(0, seen);
  sampler.aim(toy.all(), 200, seen);
  EXPECT_EQ(numbers(seen), (std::vector<uint32_t>{1, 2, 4}));
}

}  // namespace
}  // namespace veduta
