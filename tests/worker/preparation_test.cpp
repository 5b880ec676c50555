// The preparation as a whole: the same for any tiles, and for a city that was moved, turned or mirrored.
#include "worker/preparation.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "pvs/pvs_file.h"
#include "tests/pvs/small_city.h"
#include "tests/worker/mesh.h"
#include "worker/canonical_axes.h"
#include "worker/clustered_occluders.h"
#include "worker/preparation_parts.h"

namespace veduta {
namespace {

using test::Random;
using test::read_bytes;
using test::status_of;
using test::TemporaryDirectory;

/// A city of turned boxes on a plain, as OBJ, in coordinates that doubles and floats hold exactly.
struct ObjCity {
  struct Solid {
    std::string name;
    std::array<glm::dvec3, 8> corner;  // bit 0: x, bit 1: y, bit 2: z
  };
  std::vector<Solid> solids;

  static double exact(double x) { return std::round(x * 256) / 256; }

  void add(const std::string& name, glm::dvec2 at, glm::dvec2 half, double turn, double bottom, double top) {
    Solid solid{name, {}};
    for (size_t n = 0; n < 8; ++n) {
      const double x = (n & 1 ? 1 : -1) * half.x, y = (n & 2 ? 1 : -1) * half.y;
      solid.corner[n] = {exact(at.x + std::cos(turn) * x - std::sin(turn) * y),
                         exact(at.y + std::sin(turn) * x + std::cos(turn) * y), n & 4 ? top : bottom};
    }
    solids.push_back(solid);
  }

  /// Writes it turned by `turn`, then moved.
  void write(const std::filesystem::path& file, const CanonicalAxes& turn = {}, double shift = 0) const {
    std::string text;
    size_t vertices = 0;
    for (const Solid& solid : solids) {
      text += "o " + solid.name + "\n";
      for (const glm::dvec3& corner : solid.corner) {
        const glm::dvec3 v = turn.to_canonical(corner) + glm::dvec3(shift, shift, 0);
        text += fmt::format("v {} {} {}\n", v.x, v.y, v.z);
      }
      for (const auto& side :
           {std::array{1, 3, 4, 2}, {5, 6, 8, 7}, {1, 2, 6, 5}, {3, 7, 8, 4}, {1, 5, 7, 3}, {2, 4, 8, 6}}) {
        text += "f";
        for (const int corner : side) text += fmt::format(" {}", vertices + static_cast<size_t>(corner));
        text += "\n";
      }
      vertices += 8;
    }
    std::ofstream(file) << text;
  }
};

ObjCity lopsided_city() {
  Random random(7);
  ObjCity city;
  city.add("ground", {3, -2}, {33, 21}, 0, -1, 0);
  for (int n = 0; n < 7; ++n) {
    city.add("house" + std::to_string(n), {-22 + 8.5 * n, random.real(-12, 6)},
             {random.real(2, 4), random.real(4, 6)}, random.real(0, 3), 0,
             ObjCity::exact(random.real(4, 14)));
  }
  return city;
}

struct PreparedCity {
  PreparedCity(const ObjCity& model, const PartSizes& sizes, const CanonicalAxes& turn = {}, double shift = 0,
               Settings settings = {}) {
    model.write(directory / "city.obj", turn, shift);
    settings.scene.model = {(directory / "city.obj").string()};
    settings.cells.size_m = 4;
    size = prepare_all(run, settings, {}, sizes);
    city = read_city(run.city());
    occluders = ClusteredOccluders::map(run.occluders()).meshes();
  }
  TemporaryDirectory directory;
  RunPaths run{directory.path()};
  PreparedSize size;
  City city;
  std::vector<WindowOccluders> occluders;
};

uint64_t bodies(const std::vector<WindowOccluders>& windows) {
  uint64_t count = 0;
  for (const WindowOccluders& window : windows) {
    for (const OccluderRing& ring : window.rings) count += ring.occluders.bodies();
  }
  return count;
}

TEST(Preparation, IsTheSameForAnyTiles) {
  const ObjCity model = lopsided_city();
  const PreparedCity one(model, {16, 1000});
  EXPECT_GT(one.size.cells, 50u);
  EXPECT_EQ(one.size.cells, one.city.cells.size());
  EXPECT_GE(one.size.objects, model.solids.size());
  EXPECT_EQ(one.size.objects, one.city.scene.objects.size());
  EXPECT_GT(bodies(one.occluders), 20u);
  EXPECT_FALSE(std::filesystem::exists(one.directory / "prepared.tmp"));
  for (const int tile_blocks : {1, 3}) {
    const PreparedCity tiled(model, {16, tile_blocks});
    EXPECT_EQ(read_bytes(tiled.run.city()), read_bytes(one.run.city())) << tile_blocks;
    EXPECT_EQ(read_bytes(tiled.run.occluders()), read_bytes(one.run.occluders())) << tile_blocks;
  }
}

using Corner = std::array<float, 3>;

Corner numbers(const glm::vec3& v) {
  return {v.x + 0.0f, v.y + 0.0f, v.z};  // + 0: no negative zeros
}

/// Cells, navigable space and occluders as sets, turned by `turn`.
struct Sets {
  Sets(const PreparedCity& prepared, const CanonicalAxes& turn) {
    for (const Box& scene_axes : prepared.city.cells) {
      const Box cell = turn.to_canonical(scene_axes);
      cells.push_back({numbers(cell.lower), numbers(cell.upper)});
    }
    std::sort(cells.begin(), cells.end());
    for (const WindowOccluders& window : prepared.occluders) {
      for (const OccluderRing& ring : window.rings) {
        std::vector<std::vector<Corner>> all;
        const OccluderMesh& mesh = ring.occluders;
        for (size_t b = 0; b < mesh.bodies(); ++b) {
          std::vector<Corner> body;
          for (uint32_t c = mesh.face_begin[mesh.body_begin[b]]; c < mesh.face_begin[mesh.body_begin[b + 1]];
               ++c)
            body.push_back(numbers(turn.to_canonical(mesh.corners[c])));
          std::sort(body.begin(), body.end());
          all.push_back(body);
        }
        std::sort(all.begin(), all.end());
        rings.push_back(all);
      }
    }
  }
  std::vector<std::array<Corner, 2>> cells;
  std::vector<std::vector<std::vector<Corner>>> rings;
};

TEST(Preparation, TurnsMovesAndMirrorsWithTheCity) {
  const ObjCity model = lopsided_city();
  const PreparedCity prepared(model, {16, 2});
  const Sets expected(prepared, {});
  ASSERT_GT(expected.cells.size(), 50u);
  Random random(8);
  for (int n = 0; n < 8; ++n) {
    const CanonicalAxes turn{(n & 1) != 0, (n & 2) != 0, (n & 4) != 0};
    const double shift = n % 2 == 0 ? 1e7 : 0;
    const PreparedCity turned(model, {16, 2}, turn, shift);
    // Where the importer put its origin; the model's own is what was turned and moved.
    const glm::dvec3 origin(prepared.city.scene.origin[0], prepared.city.scene.origin[1], 0);
    const glm::dvec3 moved = turn.to_canonical(origin) + glm::dvec3(shift, shift, 0);
    EXPECT_EQ(turned.city.scene.origin[0], moved.x);
    EXPECT_EQ(turned.city.scene.origin[1], moved.y);
    // Back: the inverse of a signed permutation.
    const CanonicalAxes back = turn.swap ? CanonicalAxes{turn.negate_y, turn.negate_x, true} : turn;
    const Sets sets(turned, back);
    EXPECT_TRUE(sets.cells == expected.cells) << n << ": " << sets.cells.size() << " cells";
    EXPECT_TRUE(sets.rings == expected.rings) << n;
    const Navigation &a = prepared.city.navigation, &b = turned.city.navigation;
    int inside = 0;
    for (int p = 0; p < 3000; ++p) {
      const glm::vec3 at = random.point({{-30, -20, -1}, {30, 20, 3}}), there = turn.to_canonical(at);
      inside += a.free.contains(at);
      ASSERT_EQ(b.free.contains(there), a.free.contains(at)) << n;
      ASSERT_EQ(b.surfaces.contains(there), a.surfaces.contains(at)) << n;
    }
    EXPECT_GT(inside, 100);
  }
}

TEST(Preparation, CellsAreMadeInTheRegionWhereverTheCityIsTurned) {
  const ObjCity model = lopsided_city();
  Settings settings;
  settings.cells.region = {{-10, -8}, {12, -8}, {12, 3}, {-10, 3}};
  for (const CanonicalAxes& turn : {CanonicalAxes{}, {true, false, true}}) {
    for (auto& corner : settings.cells.region) {
      const glm::dvec2 v = turn.to_canonical(glm::dvec2(corner[0], corner[1]));
      corner = {v.x, v.y};
    }
    const PreparedCity prepared(model, {16, 2}, turn, 0, settings);
    EXPECT_GT(prepared.size.cells, 5u);
    for (const Box& cell : prepared.city.cells) {
      const auto& o = prepared.city.scene.origin;
      const glm::dvec3 there = glm::dvec3(cell.center()) + glm::dvec3(o[0], o[1], o[2]);
      const glm::dvec3 c = turn.from_canonical(there);
      EXPECT_TRUE(c.x >= -10 && c.x <= 12 && c.y >= -8 && c.y <= 3) << c.x << ' ' << c.y;
    }
  }
}

TEST(Preparation, ACityThatCannotBePreparedIsOneLine) {
  TemporaryDirectory directory;
  const RunPaths run{directory.path()};
  ObjCity model = lopsided_city();
  model.write(directory / "city.obj");
  Settings settings;
  settings.scene.model = {(directory / "city.obj").string()};
  std::string message;
  settings.navigation.seed_size_m = 1e-6;
  EXPECT_EQ(status_of([&] { prepare_all(run, settings); }, &message), ExitStatus::usage);
  EXPECT_NE(message.find("use a seed of about"), std::string::npos) << message;

  ObjCity full;
  full.add("ground", {0, 0}, {20, 20}, 0, -1, 0);
  full.add("block", {0, 0}, {20, 20}, 0, 0, 10);
  full.write(directory / "city.obj");
  settings.navigation.seed_size_m = 0.25;
  EXPECT_EQ(status_of([&] { prepare_all(run, settings); }, &message), ExitStatus::bad_input);
  EXPECT_NE(message.find("no place to stand in"), std::string::npos) << message;
  EXPECT_FALSE(std::filesystem::exists(run.prepared()));

  settings.scene.model = {(directory / "none.obj").string()};
  EXPECT_EQ(status_of([&] { prepare_all(run, settings); }), ExitStatus::bad_input);

  // A step whose forerunner never came.
  std::filesystem::remove_all(directory / "prepared.tmp");
  EXPECT_EQ(status_of([&] { flood_tile(run, 0); }), ExitStatus::bad_input);
  EXPECT_EQ(status_of([&] { shrink_block(run, settings, 0); }), ExitStatus::bad_input);
  EXPECT_EQ(status_of([&] { finish_preparation(run, settings); }), ExitStatus::bad_input);
}

TEST(Preparation, TellsHowFarItIs) {
  TemporaryDirectory directory;
  lopsided_city().write(directory / "city.obj");
  Settings settings;
  settings.scene.model = {(directory / "city.obj").string()};
  std::vector<std::string> stages;
  uint32_t last_done = 0, last_total = 0;
  prepare_all({directory.path()}, settings,
              [&](const std::string& stage, uint32_t done, uint32_t total) {
                if (stages.empty() || stages.back() != stage) {
                  EXPECT_EQ(last_done, last_total) << "the stage before was finished";
                  stages.push_back(stage);
                } else {
                  EXPECT_EQ(done, last_done + 1);
                }
                last_done = done, last_total = total;
              },
              {32, 1});
  EXPECT_EQ(stages, (std::vector<std::string>{"import", "flood", "cells", "shrink", "finish"}));
  EXPECT_EQ(last_done, 1u);
}

}  // namespace
}  // namespace veduta
