// The same city is the same city wherever it lies, however it is turned, and in whatever unit: rows compared
// by the triangles that they draw, and byte for byte. (What the preparation makes of such cities is compared
// in preparation_test.cpp, what is visible of a turned one in occlusion_limits_test.cpp.)
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "gl/egl_context.h"
#include "scene/error.h"
#include "tests/hard/hard_case.h"
#include "tests/hard/town.h"

namespace veduta::hard {
namespace {

/// What a row says, in terms of the town as it was before it was placed.
struct Drawn {
  std::map<std::string, std::set<uint64_t>> triangles;  // by number within the object
  std::map<std::string, std::array<int, 3>> bytes;
  bool operator==(const Drawn&) const = default;
};
using Rows = std::map<std::array<int, 3>, Drawn>;  // by the middle of the cell, 2^-8 m

/// The bytes for axes that were turned. Seen from the other end, "the first k of n slices" is "the last k".
std::array<int, 3> turned_back(VisibilityIndex index, SliceCounts slices, const CanonicalAxes& turn) {
  const auto other_end = [](int byte, int n) { return byte == 0 ? 0 : byte > 0 ? byte - n : n + byte; };
  int x = index.x, y = index.y, nx = slices.x, ny = slices.y;
  if (turn.swap) std::swap(x, y), std::swap(nx, ny);
  if (turn.negate_x) x = other_end(x, nx);
  if (turn.negate_y) y = other_end(y, ny);
  return {x, y, index.z};
}

class Invariance : public testing::TestWithParam<std::string> {
 protected:
  Invariance() {
    settings_.cells.size_m = 4, settings_.cells.height_m = 1;
    settings_.occlusion.resolution = 256,
    settings_.occlusion.subdivide = GetParam() == "zoom" ? 1 : 2;  // zoom is slow
    settings_.occlusion.max_overestimate = 1;
  }
  void SetUp() override {
    try {
      EglContext("software");
    } catch (const Error&) {
      GTEST_SKIP() << "no EGL device with OpenGL 4.3 here";
    }
  }

  /// Everything in the settings that is a length goes with the town.
  Rows bake(const Placing& place) const {
    const test::TemporaryDirectory directory;
    test::write_bytes(directory / "city.obj", Town().text(place));
    Settings settings = settings_;
    settings.scene.model = {(directory / "city.obj").string()};
    for (double* length : {&settings.cells.size_m, &settings.cells.height_m, &settings.navigation.seed_size_m,
                           &settings.navigation.fly_lowest_m, &settings.navigation.fly_highest_m,
                           &settings.stereo.eye_margin_m})
      *length *= place.scale;
    for (const glm::dvec3& corner :
         {glm::dvec3(-4.5, -4.5, 0), {4.5, -4.5, 0}, {4.5, 4.5, 0}, {-4.5, 4.5, 0}}) {
      const glm::dvec3 p =
          place(corner + glm::dvec3(1, 1, 0));  // the middle of the road, where the origin is
      settings.cells.region.push_back({p.x, p.y});
    }
    const PvsFile file = bake_case(prepare_case(settings), settings, GetParam());
    expect_nothing_wrong(file, settings);
    return rows(file, place);
  }

  void expect_nothing_wrong(const PvsFile& file, const Settings& settings) const {
    HardCase town;
    town.settings = settings, town.looks = 8000;
    const auto& origin = file.city.scene.origin;
    for (const Box& cell : file.city.cells) {  // all of them in the open
      const glm::vec3 at = cell.center();
      town.stands.push_back({origin[0] + at.x, origin[1] + at.y, origin[2] + at.z});
    }
    const ExactReference reference(read_exact_model(settings.scene.model.front(), 1),
                                   places_of_eyes(town, file.city));
    const auto seen = look_from_cells(reference, town, file);
    EXPECT_EQ(seen.size(), file.city.cells.size());
    const Verdict verdict = judge(file, reference, seen);
    EXPECT_TRUE(verdict.wrong.empty()) << verdict.wrong.front();
  }

  static Rows rows(const PvsFile& file, const Placing& place) {
    const Scene& scene = file.city.scene;
    const glm::dvec3 origin(scene.origin[0], scene.origin[1], scene.origin[2]);
    Rows all;
    for (uint32_t cell = 0; cell < file.city.cells.size(); ++cell) {
      const glm::dvec3 middle = place.back(origin + glm::dvec3(file.city.cells[cell].center()));
      Drawn& drawn = all[{int(std::lround(256 * middle.x)), int(std::lround(256 * middle.y)),
                          int(std::lround(256 * middle.z))}];
      for (const PvsEntry& entry : file.row(cell)) {
        const Object& object = scene.objects[entry.object];
        drawn.bytes[object.name] = turned_back(entry.index, file.city.slices[entry.object], place.turn);
        for (uint64_t t = object.triangle_begin; t < object.triangle_end; ++t)
          if (draws(entry.index, file.city.triangle_slices[t]))
            drawn.triangles[object.name].insert(t - object.triangle_begin);
      }
    }
    return all;
  }

  /// Otherwise all rows are alike for no reason.
  static void expect_something_to_compare(const Rows& rows) {
    EXPECT_EQ(rows.size(), 4u);
    size_t hidden = 0, parts = 0;  // of ten objects
    for (const auto& [cell, drawn] : rows) {
      hidden += 10 - drawn.bytes.size();
      for (const auto& [name, bytes] : drawn.bytes) parts += bytes != std::array{0, 0, 1};
    }
    EXPECT_GT(hidden, 4u);
    EXPECT_GT(parts, 4u);
  }

  Settings settings_;
};

size_t count(const Drawn& drawn) {
  size_t all = 0;
  for (const auto& [name, triangles] : drawn.triangles) all += triangles.size();
  return all;
}

/// Byte for byte; but x and y may save as many triangles as each other, and then the row takes x, which is y
/// of the turned town: those rows draw as many.
void expect_same(const Rows& rows, const Rows& expected, bool swapped = false) {
  ASSERT_EQ(rows.size(), expected.size());
  for (auto r = rows.begin(), e = expected.begin(); r != rows.end(); ++r, ++e) {
    EXPECT_EQ(r->first, e->first);
    EXPECT_EQ(count(r->second), count(e->second));
    for (const auto& [name, bytes] : e->second.bytes) {
      ASSERT_TRUE(r->second.bytes.contains(name)) << name;
      const auto& turned = r->second.bytes.at(name);
      if (swapped && turned[2] == bytes[2] && (turned[0] == 0) != (bytes[0] == 0)) {
        EXPECT_EQ(r->second.triangles.at(name).size(), e->second.triangles.at(name).size()) << name;
        continue;
      }
      EXPECT_EQ(turned, bytes) << name;
      EXPECT_EQ(r->second.triangles.at(name), e->second.triangles.at(name)) << name;
    }
  }
}

TEST_P(Invariance, TurnedByRightAnglesAndMirrored) {
  const Rows expected = bake({});
  expect_something_to_compare(expected);
  std::vector<CanonicalAxes> turns{{false, true, true}, {true, false, false}};  // by 90 degrees; mirrored
  if (GetParam() == "panorama") turns.insert(turns.end(), {{true, true, false}, {false, false, true}});
  for (const CanonicalAxes& turn : turns) {
    SCOPED_TRACE(fmt::format("{} {} {}", turn.negate_x, turn.negate_y, turn.swap));
    expect_same(bake({turn}), expected, turn.swap);
  }
}

TEST_P(Invariance, MovedByTenMillionMetres) {
  expect_same(bake({{}, 1, {1e7, -9999991, 4000}}), bake({}));
}

// The lattice of cells lies at whole metres: by other amounts the city moves against it. Ten million metres
// more then change coordinates by a unit in the last place of a float, for doubles have steps of 2e-9 m
// there.
TEST_P(Invariance, MovedByOddAmountsAndTenMillionMetres) {
  const glm::dvec3 odd(0.3, -0.7, 0.1);
  expect_same(bake({{}, 1, odd + glm::dvec3(1e7, -1e7, 0)}), bake({{}, 1, odd}));
}

TEST_P(Invariance, ScaledByPowersOfTwo) {
  // Not free of scale are: eyes within 0.25 m of their height (walk), slices of 8 m, and how far a body grows
  // (48 m) and which of its features count (1 cm) when occluders are shrunk: so an object that nobody sees
  // may be listed at one scale and not at another.
  settings_.navigation.mode = "fly", settings_.cells.height_m = 4, settings_.cells.largest = 1;
  settings_.navigation.fly_lowest_m = 0, settings_.navigation.fly_highest_m = 4;
  settings_.slices.max = 1;
  const auto scaled = [&](double scale) { return bake({{}, scale, -scale * glm::dvec3(1, 1, -1)}); };
  const Rows expected = scaled(1);
  for (const double scale : {0.5, 8.0}) {
    SCOPED_TRACE(scale);
    const Rows rows = scaled(scale);
    ASSERT_EQ(rows.size(), expected.size());
    size_t differ = 0;
    for (auto r = rows.begin(), e = expected.begin(); r != rows.end(); ++r, ++e) {
      EXPECT_EQ(r->first, e->first);
      for (const auto& [name, bytes] : r->second.bytes) differ += !e->second.bytes.contains(name);
      for (const auto& [name, bytes] : e->second.bytes) differ += !r->second.bytes.contains(name);
    }
    EXPECT_LE(differ, rows.size() * 10 / 40) << "of " << rows.size() << " rows over ten objects";
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, Invariance, testing::Values("panorama", "zoom"),
                         [](const auto& method) { return method.param; });

}  // namespace
}  // namespace veduta::hard
