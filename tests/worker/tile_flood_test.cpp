// The fill of a city tile by tile, against one fill of the whole.
#include "worker/tile_flood.h"

#include <gtest/gtest.h>

#include <thread>

#include "tests/worker/tiled_city.h"
#include "worker/seed_region.h"
#include "worker/tile_sides.h"
#include "worker/tile_state.h"

namespace veduta {
namespace {

using test::Random;
using test::TiledCity;

Settings coarse_settings(double seed_m) {
  Settings settings;
  settings.navigation.seed_size_m = seed_m;
  return settings;
}

SeedRegion whole(const Scene& scene, const PreparationPlan& plan) {
  std::vector<PlacedTriangle> triangles = all_triangles(scene);
  for (PlacedTriangle& t : triangles) t = plan.axes.to_canonical(t);
  return make_seed_region(triangles, plan.frame);
}

/// A rectangle of the city in one region and the other.
void expect_equal(const SeedRegion& part, const SeedRegion& city) {
  const GridFrame &p = part.frame(), &c = city.frame();
  ASSERT_EQ(p.nz, c.nz);
  test::each_voxel(p, [&](int i, int j, int k) {
    const int a = i + p.i0 - c.i0, b = j + p.j0 - c.j0;
    ASSERT_EQ(part.occupied->get(i, j, k), city.occupied->get(a, b, k)) << i << ' ' << j << ' ' << k;
    ASSERT_EQ(part.free.get(i, j, k), city.free.get(a, b, k)) << i << ' ' << j << ' ' << k;
    if (!part.occupied->get(i, j, k)) return;
    ASSERT_EQ(part.touched.at(i, j, k), city.touched.at(a, b, k)) << i << ' ' << j << ' ' << k;
    ASSERT_EQ(part.reached.at(i, j, k), city.reached.at(a, b, k)) << i << ' ' << j << ' ' << k;
  });
}

TEST(TileFlood, IsTheFillOfTheWholeCityForAnyTilesAndAnyOrder) {
  Random random(1);
  uint64_t beyond_first_fills = 0;
  for (int round = 0; round < 6; ++round) {
    const test::Mesh mesh = round % 2 == 0 ? test::wandering_town(random) : test::triangle_soup(random);
    const Settings settings = coarse_settings(round % 4 < 2 ? 0.125 : 0.2);
    for (const PartSizes& sizes : {PartSizes{4, 1}, PartSizes{7, 1}, PartSizes{5, 2}, PartSizes{8, 1000}}) {
      TiledCity city(mesh.scene, settings, sizes);
      beyond_first_fills += static_cast<uint64_t>(city.flood(random)) - city.plan.tiles();
      const SeedRegion expected = whole(mesh.scene, city.plan);
      expect_equal(load_region(city.run, city.plan, city.plan.grown({0, 0, 0, 0}, 1 << 20)), expected);
      if (HasFatalFailure()) FAIL() << round << ": blocks of " << sizes.block_voxels;
      for (int part = 0; part < 3; ++part) {
        const GridFrame& f = city.plan.frame;
        const int i = f.i0 + random.integer(0, f.nx - 1), j = f.j0 + random.integer(0, f.ny - 1);
        expect_equal(load_region(city.run, city.plan, city.plan.grown({i, i + 1, j, j + 1}, 9)), expected);
      }
    }
  }
  EXPECT_GT(beyond_first_fills, 100u) << "a town in which nothing flows back and forth";
}

TEST(TileFlood, MissesNothingWhenTilesAreFloodedAtTheSameTime) {
  Random random(2);
  for (int round = 0; round < 3; ++round) {
    const test::Mesh mesh = test::wandering_town(random);
    TiledCity city(mesh.scene, coarse_settings(0.2), {4, 1});
    // In rounds: all that are named, at the same time; two threads may get the same tile.
    std::vector<uint32_t> waiting;
    for (uint32_t tile = 0; tile < city.plan.tiles(); ++tile) waiting.push_back(tile);
    while (!waiting.empty()) {
      std::vector<std::vector<uint32_t>> named(3);
      std::vector<std::thread> threads;
      for (size_t t = 0; t < named.size(); ++t) {
        threads.emplace_back([&, t] {
          for (size_t n = t; n < waiting.size(); n += named.size()) {
            for (const uint32_t next : flood_tile(city.run, city.plan, waiting[n])) named[t].push_back(next);
          }
        });
      }
      for (std::thread& thread : threads) thread.join();
      waiting.clear();
      for (const auto& some : named) waiting.insert(waiting.end(), some.begin(), some.end());
      std::sort(waiting.begin(), waiting.end());
      waiting.erase(std::unique(waiting.begin(), waiting.end()), waiting.end());
    }
    expect_equal(load_region(city.run, city.plan, city.plan.grown({0, 0, 0, 0}, 1 << 20)),
                 whole(mesh.scene, city.plan));
  }
}

TEST(TileFlood, GoesOnAfterAWorkerThatDiedBetweenItsFiles) {
  Random random(3);
  const test::Mesh mesh = test::wandering_town(random);
  TiledCity city(mesh.scene, coarse_settings(0.2), {6, 1});
  std::vector<uint32_t> waiting;
  for (uint32_t tile = 0; tile < city.plan.tiles(); ++tile) waiting.push_back(tile);
  for (size_t n = 0; n < waiting.size(); ++n) {
    const uint32_t tile = waiting[n];
    const auto sides = part_file(city.run, "sides", tile), kept = city.directory / "kept";
    std::error_code error;
    std::filesystem::copy_file(sides, kept, std::filesystem::copy_options::overwrite_existing, error);
    const bool first = static_cast<bool>(error);
    flood_tile(city.run, city.plan, tile);  // its answer is lost, and so are its sides
    std::filesystem::remove(sides);
    if (!first) std::filesystem::rename(kept, sides);
    for (const uint32_t next : flood_tile(city.run, city.plan, tile)) {
      if (std::find(waiting.begin() + static_cast<std::ptrdiff_t>(n) + 1, waiting.end(), next) ==
          waiting.end())
        waiting.push_back(next);
    }
  }
  expect_equal(load_region(city.run, city.plan, city.plan.grown({0, 0, 0, 0}, 1 << 20)),
               whole(mesh.scene, city.plan));
}

TEST(TileFlood, ATileThatNothingFlowsIntoNamesNobody) {
  test::Mesh mesh;
  mesh.ground(-20, -20, 20, 20, 0);
  TiledCity city(mesh.scene, coarse_settings(0.25), {8, 1});
  ASSERT_GT(city.plan.tiles(), 9u);
  for (uint32_t tile = 0; tile < city.plan.tiles(); ++tile) flood_tile(city.run, city.plan, tile);
  for (uint32_t tile = 0; tile < city.plan.tiles(); ++tile)
    EXPECT_TRUE(flood_tile(city.run, city.plan, tile).empty()) << "all of an open plain is free at once";
}

TEST(TileFlood, DamagedFilesAreBadInput) {
  Random random(4);
  const test::Mesh mesh = test::triangle_soup(random);
  TiledCity city(mesh.scene, coarse_settings(0.25), {8, 1});
  city.flood(random);
  for (const char* what : {"space", "surface", "sides", "triangles"}) {
    const auto file = part_file(city.run, what, 0);
    const std::string bytes = test::read_bytes(file);
    for (const size_t keep : {size_t{0}, size_t{20}, bytes.size() / 2, bytes.size() - 1}) {
      test::write_bytes(file, bytes.substr(0, keep));
      EXPECT_EQ(test::status_of([&] {
                  read_tile_sides(city.run, city.plan, 0);
                  load_block(city.run, city.plan, 0);
                }),
                ExitStatus::bad_input)
          << what << ' ' << keep;
    }
    for (int flip = 0; flip < 60; ++flip) {  // no crash; most are seen, and what is read has the right size
      std::string damaged = bytes;
      damaged[static_cast<size_t>(random.integer(0, static_cast<int>(bytes.size()) - 1))] ^= 0x10;
      test::write_bytes(file, damaged);
      const ExitStatus status = test::status_of([&] {
        read_tile_sides(city.run, city.plan, 0);
        load_block(city.run, city.plan, 0);
      });
      EXPECT_TRUE(status == ExitStatus::bad_input || status == ExitStatus::done) << what;
    }
    test::write_bytes(file, bytes);
  }
}

TEST(LoadBlock, HasTheTrianglesAndTheColumnsOfItsHalo) {
  Random random(5);
  const test::Mesh mesh = test::wandering_town(random);
  for (const PartSizes& sizes : {PartSizes{9, 1}, PartSizes{9, 2}}) {
    TiledCity city(mesh.scene, coarse_settings(0.2), sizes);
    city.flood(random);
    std::vector<int> covered(static_cast<size_t>(city.plan.frame.nx * city.plan.frame.ny), 0);
    for (uint32_t b = 0; b < city.plan.blocks(); ++b) {
      const SealedBlock block = load_block(city.run, city.plan, b);
      const GridFrame &f = block.region.frame(), &c = city.plan.frame;
      for (int j = block.j0; j < block.j1; ++j) {
        for (int i = block.i0; i < block.i1; ++i)
          ++covered[static_cast<size_t>((j + f.j0 - c.j0) * c.nx + i + f.i0 - c.i0)];
      }
      EXPECT_EQ(block.i0 == 0, city.plan.block(b).i0 == c.i0) << "a halo unless the city ends";
      // All that touch the region's box, in the scene's order.
      std::vector<PlacedTriangle> expected;
      for (const PlacedTriangle& scene_axes : all_triangles(mesh.scene)) {
        const PlacedTriangle t = city.plan.axes.to_canonical(scene_axes);
        const Box box = bounds(t);
        if (box.upper.x >= f.x(0) && box.lower.x <= f.x(f.nx) && box.upper.y >= f.y(0) &&
            box.lower.y <= f.y(f.ny))
          expected.push_back(t);
      }
      EXPECT_EQ(block.triangles, expected);
    }
    EXPECT_EQ(std::count(covered.begin(), covered.end(), 1), static_cast<std::ptrdiff_t>(covered.size()))
        << "the cores are a partition of the city";
  }
}

}  // namespace
}  // namespace veduta
