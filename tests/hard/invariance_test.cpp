// The same city is the same city wherever it lies, however it is turned, and in whatever unit: rows compared
// by the triangles that they draw, and byte for byte. (What the preparation makes of such cities is compared
// in preparation_test.cpp, what is visible of a turned one in occlusion_limits_test.cpp.)
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/vec2.hpp>
#include <map>
#include <set>

#include "gl/egl_context.h"
#include "scene/error.h"
#include "tests/hard/hard_case.h"
#include "worker/canonical_axes.h"

namespace veduta::hard {
namespace {

/// How a city is laid down: turned, then scaled, then moved.
struct Placing {
  CanonicalAxes turn;
  double scale = 1;
  glm::dvec3 shift{0};

  glm::dvec3 operator()(const glm::dvec3& p) const { return scale * turn.to_canonical(p) + shift; }
  glm::dvec3 back(const glm::dvec3& p) const { return turn.from_canonical((p - shift) / scale); }
};

/// Houses of storeys beside streets, lopsided, some turned. Coordinates are multiples of 2^-8 m, so that
/// doubles hold them 10^7 m away and floats near the origin. The ground is a road, which is not cut into
/// tiles: tiles lie on a lattice of their own.
class Town {
 public:
  Town() {
    add("road", {-41, -35, -1}, {43, 37, 0}, 0, 1);
    add("wall", {9, -20, 0}, {17, 12, 9}, 0, 3);
    add("behind", {21, -12, 0}, {25, -9, 3}, 0, 1);
    add("tower", {27, -4, 0}, {33, 2, 33}, 0, 11);
    add("turned", {-17, 6, 0}, {-9, 20, 7.5}, 0.5, 3);
    add("behind_turned", {-31, 19, 0}, {-24, 27, 8}, 0.2, 2);
    add("south", {-20, -23, 0}, {6, -13, 8}, 0, 2);
    add("behind_south", {-14, -31, 0}, {-6, -28, 18}, 0, 6);
    add("pole", {4, 9, 0}, {4.25, 9.25, 5}, 0, 1);
    add("far", {36, 20, 0}, {41, 33, 15}, 0.1, 4);
  }

  /// As triangles, so that all placings have the same ones; facing outwards.
  std::string text(const Placing& place) const {
    std::string text;
    for (const auto& [name, triangles] : objects_) {
      text += "o " + name + "\n";
      for (const auto& t : triangles) {
        for (const glm::dvec3& corner : t) {
          const glm::dvec3 p = place(corner);
          text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
        }
        text += place.turn.mirrors() ? "f -3 -1 -2\n" : "f -3 -2 -1\n";
      }
    }
    return text;
  }

 private:
  using Triangle = std::array<glm::dvec3, 3>;

  void add(const std::string& name, const glm::dvec3& lower, const glm::dvec3& upper, double turn,
           int storeys) {
    const glm::dvec3 middle = 0.5 * (lower + upper), half = 0.5 * (upper - lower);
    const auto exact = [](double x) { return std::round(x * 256) / 256; };
    std::array<glm::dvec2, 4> outline;
    for (size_t n = 0; n < 4; ++n) {
      const double x = (n == 1 || n == 2 ? 1 : -1) * half.x, y = (n >= 2 ? 1 : -1) * half.y;
      outline[n] = {exact(middle.x + std::cos(turn) * x - std::sin(turn) * y),
                    exact(middle.y + std::sin(turn) * x + std::cos(turn) * y)};
    }
    std::vector<Triangle> triangles;
    const auto quad = [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                          const glm::dvec3& d) {
      triangles.push_back({a, b, c}), triangles.push_back({a, c, d});
    };
    for (int storey = 0; storey < storeys; ++storey) {
      const double z0 = exact(lower.z + (upper.z - lower.z) * storey / storeys);
      const double z1 = exact(lower.z + (upper.z - lower.z) * (storey + 1) / storeys);
      for (size_t n = 0; n < 4; ++n) {
        const glm::dvec2 &a = outline[n], &b = outline[(n + 1) % 4];
        quad({a, z0}, {b, z0}, {b, z1}, {a, z1});
      }
    }
    const auto& [a, b, c, d] = outline;
    quad({d, lower.z}, {c, lower.z}, {b, lower.z}, {a, lower.z});
    quad({a, upper.z}, {b, upper.z}, {c, upper.z}, {d, upper.z});
    objects_.emplace_back(name, triangles);
  }

  std::vector<std::pair<std::string, std::vector<Triangle>>> objects_;
};

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
