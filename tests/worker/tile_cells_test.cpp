#include "worker/tile_cells.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "scene/error.h"
#include "tests/worker/celled_city.h"

namespace veduta {
namespace {

using test::CelledCity;
using test::Mesh;
using test::Random;

/// A slope with houses, a courtyard and a bridge, at no whole numbers.
Scene small_city() {
  Random random(11);
  Mesh mesh;
  mesh.object(Kind::terrain);
  mesh.quad({-31.3f, -22.2f, -1}, {33.4f, -22.2f, 4}, {33.4f, 27.7f, 5}, {-31.3f, 27.7f, 0});
  for (int h = 0; h < 14; ++h) {
    const auto x = static_cast<float>(random.real(-30, 24)), y = static_cast<float>(random.real(-20, 20));
    mesh.object();
    mesh.box({{x, y, -1}, {x + 7, y + 5, static_cast<float>(random.real(4, 14))}});
  }
  mesh.object();
  for (const Box& side : {Box{{-20, -20, -1}, {-19, -5, 9}}, Box{{-5, -20, -1}, {-4, -5, 9}},
                          Box{{-20, -21, -1}, {-4, -20, 9}}, Box{{-20, -5, -1}, {-4, -4, 9}}})
    mesh.box(side);
  mesh.object(Kind::bridge);
  mesh.box({{3, -22, 8}, {8, 27, 9}});
  return mesh.scene;
}

std::vector<CellOptions> several_options() {
  CellOptions walk, small, region, fly, low;
  small.size_m = 3.7, small.height_m = 0.6;
  region.size_m = 4;
  region.region = {{-20, -20}, {25, -10}, {10, 5}, {20, 25}, {-25, 15}};
  fly.fly = true, fly.size_m = 4, fly.height_m = 2, fly.fly_highest_m = 30, fly.largest = 8;
  low.fly = true, low.size_m = 2.3, low.height_m = 2.3, low.fly_lowest_m = -1, low.fly_highest_m = 7;
  return {walk, small, region, fly, low};
}

TEST(TileCells, DoNotDependOnTheTiles) {
  const Scene scene = small_city();
  for (const CellOptions& options : several_options()) {
    CelledCity city(scene, options, 0.25);
    const std::vector<Box> cells = city.cells;
    const Navigation navigation = city.navigation;
    ASSERT_GT(cells.size(), 10u);
    ASSERT_GT(navigation.free.states.size(), 100u);
    for (const auto& [x, y] : {std::pair{64, 64}, {50, 1000}, {1000, 97}, {37, 41}, {130, 12}}) {
      city.make(x, y, x % 2 == 0);
      ASSERT_EQ(city.cells, cells) << x << ' ' << y;
      ASSERT_EQ(city.navigation.free, navigation.free) << x << ' ' << y;
      ASSERT_EQ(city.navigation.surfaces, navigation.surfaces) << x << ' ' << y;
      ASSERT_TRUE(test::same_ground(city.navigation.ground, navigation.ground)) << x << ' ' << y;
    }
  }
}

TEST(TileCells, RefuseAHaloNarrowerThanACell) {
  const CelledCity city(small_city(), {});
  const SeedRegion part = test::crop(city.region, 95, 205, 0, city.region.frame().ny);
  EXPECT_THROW(make_tile_cells(part, city.triangles, 5, 105, 0, city.region.frame().ny, city.options), Error);
}

TEST(TileCells, RefuseATileOfAnotherCity) {
  Mesh mesh;
  mesh.ground(0, 0, 5, 5, 0);
  const CelledCity small(mesh.scene, {}), large(small_city(), {});
  CellGatherer gatherer(small.options);
  const GridFrame& f = large.region.frame();
  EXPECT_THROW(gatherer.add(make_tile_cells(large.region, large.triangles, 0, f.nx, 0, f.ny, large.options)),
               Error);
}

TEST(TileCells, FilesGiveBackWhatWasWritten) {
  CellOptions options = several_options()[3];
  const CelledCity city(small_city(), options, 0.5);
  const GridFrame& f = city.region.frame();
  const TileCells tile = make_tile_cells(city.region, city.triangles, 0, f.nx, 0, f.ny, city.options);
  const auto file =
      std::filesystem::temp_directory_path() / ("tile_cells_test." + std::to_string(::getpid()));
  write_tile_cells(file, tile);
  CellGatherer gatherer(city.options);
  gatherer.add(read_tile_cells(file));
  Navigation navigation;
  EXPECT_EQ(gatherer.finish(navigation), city.cells);
  EXPECT_EQ(navigation.free, city.navigation.free);
  EXPECT_EQ(navigation.surfaces, city.navigation.surfaces);
  EXPECT_TRUE(test::same_ground(navigation.ground, city.navigation.ground));

  // Any byte changed, any length cut: one clear error.
  std::ifstream in(file, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  const auto status_of = [&](const std::string& damaged) {
    std::ofstream(file, std::ios::binary) << damaged;
    try {
      read_tile_cells(file);
    } catch (const Error& error) {
      return error.status();
    }
    return ExitStatus::done;
  };
  Random random(1);
  for (int round = 0; round < 50; ++round) {
    const auto at = static_cast<size_t>(random.integer(0, static_cast<int>(bytes.size()) - 1));
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << random.integer(0, 7)));
    ASSERT_EQ(status_of(damaged), ExitStatus::bad_input) << at;
    ASSERT_EQ(status_of(bytes.substr(0, at)), ExitStatus::bad_input) << at;
  }
  EXPECT_EQ(status_of(bytes), ExitStatus::done);
  std::filesystem::remove(file);
  EXPECT_EQ(status_of(""), ExitStatus::bad_input);
  std::filesystem::remove(file);
}

TEST(CellOptionsOf, SettingsAndScene) {
  Settings settings;
  settings.navigation.mode = "fly";
  settings.cells.region = {{1000, 2000}, {1010, 2000}, {1000, 2010}};
  settings.cells.largest = 2;
  CellOptions options = cell_options(settings, {1000, 1990, 5}, GridFrame{}, -3, true);
  EXPECT_TRUE(options.fly);
  EXPECT_EQ(options.largest, 2);
  EXPECT_EQ(options.region, (std::vector<glm::dvec2>{{0, 10}, {10, 10}, {0, 20}}));
  EXPECT_FALSE(options.level_ground_m.has_value());
  options = cell_options(settings, {1000, 1990, 5}, GridFrame{}, -3, false);
  EXPECT_EQ(options.level_ground_m, -3.0f);
}

}  // namespace
}  // namespace veduta
