// The hard cases of occlusion that pixels, rings and the faces of a cube make, each by name (DESIGN §11), for
// every method; checked as those of occlusion_cases_test.cpp.
#include <algorithm>
#include <glm/mat2x2.hpp>
#include <map>

#include "tests/worker/occlusion_checks.h"
#include "worker/cell_windows.h"
#include "worker/shrinker.h"

namespace veduta {
namespace {

using test::check_methods;
using test::OcclusionCity;

// A method that looks at pixels' centres sees no slit between two of them: at 80 m a pixel is 2.5 m wide
// here. Rings are shrunk by half a pixel for that. The cell is small, so that shrinking by the cell opens the
// slit little.
TEST(OcclusionLimit, SlitNarrowerThanAPixel) {
  SKIP_WITHOUT_GL();
  std::map<std::string, size_t> without_rings;  // what the check finds when all rings are shrunk as the first
  for (const double width : {1.25, 0.25}) {     // half a pixel; two seeds
    for (const double offset : {0.0, 0.85}) {
      SCOPED_TRACE("a slit of " + std::to_string(width) + " m at y = " + std::to_string(offset) + " m");
      OcclusionCity city;
      city.settings.cells.size_m = 0.5, city.settings.occlusion.subdivide = 1;
      city.settings.occlusion.resolution = 64;
      city.add("ground", {-4, -24, -8}, {116, 24, 0});
      city.add("south", {80, -24, 0}, {92, offset, 12});
      city.add("north", {80, offset + width, 0}, {92, 24, 12});
      city.add("behind_slit", {98, offset - 2, 0}, {102, offset + 2 + width, 8});
      city.add("behind_wall", {98, -16, 0}, {102, -12, 2});
      city.cells_within(0, 0, 0.6, 0.6);
      check_methods(city, [&](const auto& answers) {
        EXPECT_FALSE(city.hides(city.at(answers, {0.3, 0.3, 1.7}), "behind_slit"));
        EXPECT_TRUE(city.hides(city.at(answers, {0.3, 0.3, 1.7}), "behind_wall"));
      });
      const reference::CellReference exact(city.input());
      std::vector<WindowOccluders> windows = city.windows();
      for (WindowOccluders& window : windows) {
        for (OccluderRing& ring : window.rings) ring.occluders = window.rings.front().occluders;
      }
      for (const std::string& method : test::occlusion_methods)
        without_rings[method] += test::noticed(city, exact, method, windows, city.all_cells(), 27);
    }
  }
  EXPECT_GT(without_rings["panorama"], 0u) << "pixels of zoom are as small as what it looks at";
}

// An object on two or three faces of the cube is hidden when it is on each; its pixels at the edge are at the
// ends of two rows that know nothing of each other.
TEST(OcclusionLimit, ObjectsAcrossEdgesAndCornersOfTheCube) {
  SKIP_WITHOUT_GL();
  OcclusionCity city;
  city.add_ground(60);
  city.add("east", {12, -40, 0}, {22, 22, 12});
  city.add("north", {-40, 12, 0}, {12, 22, 12});
  city.add("low_at_edge", {26, 26, 0}, {32, 32, 4});       // on +x and +y
  city.add("tower_at_corner", {24, 24, 0}, {30, 30, 50});  // on +x, +y and +z
  city.add("arm", {-30, 26, 0}, {20, 30, 5});              // long, on +y and from some eyes on -x
  city.add("slab", {-30, -30, 9}, {8, 6, 15});             // over the cell: on five faces
  city.add("on_slab", {-14, -14, 15}, {-10, -10, 16});
  city.add("west", {-40, -40, 0}, {-30, 12, 12});
  city.cells_within(-2, -2, 6, 6);
  check_methods(city, [&](const auto& answers) {
    for (const double x : {1.0, 5.0}) {
      const CellOcclusion& answer = city.at(answers, {x, x, 1.7});
      EXPECT_TRUE(city.hides(answer, "low_at_edge"));
      EXPECT_TRUE(city.hides(answer, "arm"));
      EXPECT_TRUE(city.hides(answer, "on_slab"));
      EXPECT_FALSE(city.hides(answer, "tower_at_corner"));
      EXPECT_FALSE(city.hides(answer, "slab"));
    }
  });
}

// Nearer than the near plane nothing is drawn, and what is there cannot be projected: it has to count as
// visible. Eyes come within a millimetre of the pillar and of the wall that the cell touches.
TEST(OcclusionLimit, NearPlaneAndEyesThatTouchWalls) {
  SKIP_WITHOUT_GL();
  OcclusionCity city;
  city.add_ground(40);
  city.add("wall", {4, -30, 0}, {12, 30, 10});
  city.add("pillar", {1.9, 1.9, 0}, {2.1, 2.1, 3});
  city.add("plate", {3.97, 1, 0.5}, {3.99, 3, 2.5});  // 1 cm before the wall
  city.add("plaque", {0, 1, 1.69}, {0.01, 1.01, 1.71});
  city.add("behind", {16, -2, 0}, {20, 2, 3});
  city.cells_within(0, 0, 4, 4);
  check_methods(city, [&](const auto& answers) {
    for (const CellOcclusion& answer : answers) {
      for (const char* name : {"wall", "pillar", "plate", "plaque"})
        EXPECT_FALSE(city.hides(answer, name)) << name;
      EXPECT_TRUE(city.hides(answer, "behind"));
    }
  });
}

// The bounds of two posts hold the cell and its middle: nothing of them can be projected.
TEST(OcclusionLimit, BoundsAroundTheCell) {
  SKIP_WITHOUT_GL();
  OcclusionCity city;
  city.add_ground(40);
  city.begin("posts");
  city.add_box({-8, -8, 0}, {-7.8, -7.8, 4});
  city.add_box({9, 9, 0}, {9.2, 9.2, 4});
  city.add("wall", {12, -30, 0}, {20, 30, 10});
  city.add("behind", {24, -2, 0}, {28, 2, 3});
  city.cells_within(0, 0, 4, 4);
  check_methods(city, [&](const auto& answers) {
    for (const CellOcclusion& answer : answers) {
      EXPECT_FALSE(city.hides(answer, "posts"));
      EXPECT_TRUE(city.hides(answer, "behind"));
    }
  });
}

// Rings take turns: an occluder that straddles the limit of one is drawn in part by two, each with another
// amount taken off.
TEST(OcclusionLimit, OccluderAcrossTheLimitOfARing) {
  SKIP_WITHOUT_GL();
  for (const size_t ring : {1, 3, 5}) {
    OcclusionCity city;
    city.settings.cells.size_m = 2, city.settings.occlusion.subdivide = 1;
    city.settings.occlusion.resolution = 128;
    const double at = 1 + ring_windows(part_half_extent(city.settings, 0, 1), 128, 1000)[ring].depth_limit_m;
    SCOPED_TRACE("at " + std::to_string(at) + " m");
    city.add("ground", {-4, -24, -6}, {at + 16, 24, 0});
    city.add("across", {at - 4, -20, 0}, {at + 4, 8, 4 + 0.04 * at});
    city.add("along", {4, 12, 0}, {at + 14, 20, 9});
    city.add("behind", {at + 5, -8, 0}, {at + 6, -6, 1});
    city.add("beside", {at + 6, 8.5, 0}, {at + 7, 9, 3});
    city.add("mast", {at + 5, -4, 0}, {at + 5.2, -3.8, 9 + 0.15 * at});
    city.add("behind_along", {at, 21, 0}, {at + 1, 22, 1});
    city.cells_within(0, -1, 2, 1);
    check_methods(city, [&](const auto& answers) {
      const CellOcclusion& answer = city.at(answers, {1, 0, 1.7});
      EXPECT_TRUE(city.hides(answer, "behind"));
      EXPECT_TRUE(city.hides(answer, "behind_along"));
      EXPECT_FALSE(city.hides(answer, "mast"));
      EXPECT_FALSE(city.hides(answer, "across"));
    });
  }
}

// Beyond the limit of the last ring no occluder is drawn. Occludees are there all the same.
TEST(OcclusionLimit, BeyondTheLastRing) {
  SKIP_WITHOUT_GL();
  OcclusionCity city;
  city.settings.cells.size_m = 2;
  city.settings.occlusion.resolution = 128;
  city.add("ground", {-4, -20, -6}, {130, 20, 0});
  city.add("near", {14, 4, 0}, {24, 20, 6});
  city.add("far", {100, -16, 0}, {112, 2, 14});
  city.add("behind_near", {40, 14, 0}, {42, 15, 2});
  city.add("behind_far", {120, -8, 0}, {122, -7, 2});
  city.cells_within(0, -1, 2, 1);
  city.prepare();
  const reference::CellReference exact(city.input());
  std::vector<WindowOccluders> cut = city.windows();
  for (WindowOccluders& window : cut)
    std::erase_if(window.rings, [](const OccluderRing& ring) { return ring.depth_limit_m > 90; });
  ASSERT_FALSE(cut.front().rings.empty());
  for (const std::string& method : test::occlusion_methods) {
    SCOPED_TRACE(method);
    for (const bool last : {true, false}) {
      const auto answers = test::answers_of(
          method, {city.city(), city.slices(), last ? city.windows() : cut, city.settings}, city.all_cells());
      test::expect_nothing_wrong(city, exact, answers, 60'000, 27);
      const CellOcclusion& answer = city.at(answers, {1, 0, 1.7});
      EXPECT_TRUE(city.hides(answer, "behind_near"));
      if (method == "panorama") {  // zoom draws every occluder at every distance
        EXPECT_EQ(city.hides(answer, "behind_far"), last);
      }
    }
  }
}

// A city that is turned or mirrored is the same city. (Not so its slices: walls are cut into triangles along
// other diagonals.)
TEST(OcclusionLimit, TurnedAndMirrored) {
  SKIP_WITHOUT_GL();
  std::map<std::string, std::vector<uint32_t>> upright;  // what is visible, by method
  for (const glm::dmat2& turn : {glm::dmat2(1), glm::dmat2(0, 1, -1, 0), glm::dmat2(-1, 0, 0, 1)}) {
    OcclusionCity city;
    city.place = [&](const glm::dvec2& p) { return turn * p; };
    city.add_ground(40);
    test::Random random(8);
    for (int n = 0; n < 50; ++n) {
      const glm::dvec2 p(random.real(-38, 30), random.real(-38, 30)), q(random.real(1, 9), random.real(3, 9));
      if (p.x < 7 && p.x + q.x > -7 && p.y < 7 && p.y + q.y > -7) continue;
      city.add(std::to_string(n), {p, 0}, {p + q, random.real(3, 12)});
    }
    city.cells_within(-4, -4, 4, 4);
    city.prepare();
    for (const std::string& method : test::occlusion_methods) {
      SCOPED_TRACE(method);
      const auto answers = test::answers_of(method, city.input(), city.all_cells());
      std::vector<uint32_t> all;
      for (const glm::dvec2& eye : {glm::dvec2(-3, -3), {-3, 1}, {1, -3}, {1, 1}}) {
        const Occlusion& found = city.at(answers, {eye, 1.7}).occlusion;
        all.insert(all.end(), found.visible.begin(), found.visible.end());
      }
      const auto hidden = static_cast<size_t>(std::ranges::count(all, 0u));
      EXPECT_GT(hidden, 5u);
      EXPECT_EQ(upright.try_emplace(method, all).first->second, all);
    }
  }
}

}  // namespace
}  // namespace veduta
