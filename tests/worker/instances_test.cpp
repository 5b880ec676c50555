// Preparation of a scene with instances is that of the same scene with every triangle written out.
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "pvs/pvs_file.h"
#include "tests/worker/mesh.h"
#include "worker/brick_grid.h"
#include "worker/seed_grid.h"
#include "worker/slices.h"

namespace veduta::test {
namespace {

// Random triangles, some in objects of their own, some in a mesh that stands in seven places.
Scene scene_with_instances(Random& random) {
  Mesh own;
  const Box box{{-9, -9, 0}, {9, 9, 7}};
  for (int o = 0; o < 3; ++o) {
    own.object(o == 0 ? Kind::terrain : Kind::building);
    for (int t = 0; t < 20; ++t) own.triangle(random.point(box), random.point(box), random.point(box));
  }
  Scene scene = own.scene;
  SharedMesh shared;
  for (uint32_t t = 0; t < 25; ++t) {
    for (int corner = 0; corner < 3; ++corner)
      shared.vertices.push_back(random.point({{-2, -2, 0}, {2, 2, 5}}));
    shared.triangles.push_back(glm::uvec3(0, 1, 2) + 3 * t);
    shared.material.push_back(t % 2 == 0 ? Material::wall : Material::window);
  }
  scene.meshes.push_back(shared);
  for (int i = 0; i < 7; ++i) {
    const double angle = 0.9 * i, c = std::cos(angle), s = std::sin(angle), side = i == 3 ? -1 : 1;
    scene.instances.push_back({0, glm::dmat4x3(c, s, 0, -side * s, side * c, 0, 0, 0, 1, random.real(-40, 40),
                                               random.real(-40, 40), random.real(-1, 3))});
    const uint64_t begin = scene.triangle_count();
    scene.objects.push_back({"instance" + std::to_string(i), Kind::building, begin, begin + 25});
  }
  return scene;
}

City city_of(Scene scene) {
  City city;
  city.scene = std::move(scene);
  city.slices = choose_slices(city.scene, 8);
  city.triangle_slices = slice_triangles(city.scene, city.slices);
  city.cells = {{{0, 0, 0}, {1, 1, 1}}};
  city.navigation.ground.step_m = 1;
  city.navigation.free.leaf_size_m = 1;
  return city;
}

TEST(Instances, PrepareAsIfWrittenOut) {
  std::string name = (std::filesystem::temp_directory_path() / "veduta-instances-XXXXXX").string();
  ASSERT_NE(mkdtemp(name.data()), nullptr);
  const std::filesystem::path file = std::filesystem::path(name) / "city.h5";
  Random random(7);
  for (int round = 0; round < 5; ++round) {
    const City placed = city_of(scene_with_instances(random));
    write_city(file, placed);
    const City flat = read_city(file);
    EXPECT_TRUE(flat.scene.instances.empty());
    ASSERT_EQ(flat.scene.triangles.size(), placed.scene.triangle_count());
    EXPECT_EQ(flat.scene.bounds(), placed.scene.bounds());
    for (size_t o = 0; o < flat.scene.objects.size(); ++o)
      EXPECT_EQ(flat.scene.bounds(o), placed.scene.bounds(o)) << o;
    EXPECT_EQ(flat.scene.material[60 + 25], Material::wall);
    EXPECT_EQ(flat.scene.material[60 + 26], Material::window);

    const City again = city_of(flat.scene);
    EXPECT_TRUE(std::equal(
        again.triangle_slices.begin(), again.triangle_slices.end(), placed.triangle_slices.begin(),
        placed.triangle_slices.end(),
        [](const TriangleSlices& a, const TriangleSlices& b) { return std::memcmp(&a, &b, sizeof a) == 0; }));
    const SliceBoxes a = slice_boxes(placed.scene, placed.slices, placed.triangle_slices);
    const SliceBoxes b = slice_boxes(flat.scene, flat.slices, flat.triangle_slices);
    EXPECT_EQ(a.boxes, b.boxes);

    const GridFrame frame = make_frame(flat.scene.bounds(), 0.5);
    const BitGrid grid = seed_test(placed.scene, frame), reference = seed_test(flat.scene, frame);
    for (int j = 0; j < frame.ny; ++j)
      for (int i = 0; i < frame.nx; ++i)
        for (int w = 0; w < grid.words(); ++w) ASSERT_EQ(grid.column(i, j)[w], reference.column(i, j)[w]);
    EXPECT_GT(grid.count(), 1000u);
  }
  std::filesystem::remove_all(name);
}

}  // namespace
}  // namespace veduta::test
