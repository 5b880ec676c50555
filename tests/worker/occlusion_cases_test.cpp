// The hard cases of occlusion that places make, each by name (DESIGN §11), for every method: no ray meets
// what a row does not draw, nothing is hidden that no occluder hides, and what plainly is hidden is found
// hidden, so that a case fails too when everything is called visible.
#include "tests/worker/occlusion_checks.h"

namespace veduta {
namespace {

using test::check_methods;
using test::OcclusionCity;

// T2 takes the occludee smaller by the cell: of a pole nothing is left but its middle axis, and that must be
// tested all the same, not dropped and not called hidden because it covers no pixel.
TEST(OcclusionCase, OccludeesThinnerThanTheCell) {
  SKIP_WITHOUT_GL();
  OcclusionCity city;
  city.add_ground(60);
  city.add("wall", {12, -20, 0}, {22, 20, 10});
  city.add("pole_hidden", {30, 0, 0}, {30.1, 0.1, 4});
  city.add("wire_hidden", {30, -8, 2}, {30.05, 8, 2.05});
  city.add("pole_before", {8, 0, 0}, {8.1, 0.1, 4});
  city.add("pole_high", {30, 4, 0}, {30.1, 4.1, 40});
  city.add("wire_past_the_end", {24, 2, 2}, {24.05, 56, 2.05});
  std::vector<std::string> penumbra;  // seen from some part of the cell or from none
  for (int n = 0; n < 10; ++n) {
    penumbra.push_back("pole_penumbra_" + std::to_string(n));
    city.add(penumbra.back(), {30, 28.0 + 3 * n, 0}, {30.1, 28.1 + 3 * n, 4});
  }
  city.cells_within(0, 0, 4, 4);
  check_methods(city, [&](const auto& answers) {
    const CellOcclusion& answer = city.at(answers, {2, 2, 1.7});
    EXPECT_TRUE(city.hides(answer, "pole_hidden"));
    EXPECT_TRUE(city.hides(answer, "wire_hidden"));
    for (const char* name : {"pole_before", "pole_high", "wire_past_the_end"})
      EXPECT_FALSE(city.hides(answer, name)) << name;
    EXPECT_TRUE(city.hides(answer, penumbra.front()));
    EXPECT_FALSE(city.hides(answer, penumbra.back()));
  });
}

// An object hides itself: what lies behind its own wall may be left out, its wall may not, though the wall's
// own occluder stands in it.
TEST(OcclusionCase, OccludeeBehindItsOwnWall) {
  SKIP_WITHOUT_GL();
  OcclusionCity city;
  city.add_ground(60);
  city.begin("house");
  city.add_box({12, -20, 0}, {22, 20, 12});
  city.add_box({22, -10, 0}, {34, 10, 3});  // a low wing behind
  city.begin("outer");
  city.add_box({-30, -10, 0}, {-12, 10, 12});
  city.add("inner", {-24, -3, 1}, {-18, 3, 4});
  city.cells_within(0, 0, 4, 4);
  check_methods(city, [&](const auto& answers) {
    const CellOcclusion& answer = city.at(answers, {2, 2, 1.7});
    EXPECT_FALSE(city.hides(answer, "outer"));
    EXPECT_TRUE(city.hides(answer, "inner"));
    ASSERT_FALSE(city.hides(answer, "house"));
    const uint32_t house = city.object("house");
    uint64_t drawn = 0;
    const Object& object = city.city().scene.objects[house];
    for (uint64_t t = object.triangle_begin; t < object.triangle_end; ++t)
      drawn += draws(city.row_entry(answer, house), city.city().triangle_slices[t]);
    EXPECT_LT(drawn, object.triangle_end - object.triangle_begin) << "the wing is hidden";
  });
}

// Eyes are on both sides of the wall, and in it is nobody: from a centre in the wall everything would be
// hidden.
TEST(OcclusionCase, CellCutByAWall) {
  SKIP_WITHOUT_GL();
  for (const auto& [wall, x] : {std::pair{0.4, 2.0}, {1.5, 4.6}}) {
    {
      SCOPED_TRACE("a wall of " + std::to_string(wall) + " m at x = " + std::to_string(x) + " m");
      OcclusionCity city;
      city.settings.cells.size_m = 8;
      city.add_ground(60);
      city.add("wall", {x, -30, 0}, {x + wall, 30, 10});
      city.add("slanting", {-0.2, 5, 0}, {3, 5.3, 10});
      city.add("near_east", {12, 1, 0}, {13, 2, 2});
      city.add("near_west", {-6, 1, 0}, {-5, 2, 2});
      city.add("east", {20, -30, 0}, {30, 30, 12});
      city.add("west", {-30, -30, 0}, {-20, 30, 12});
      city.add("behind_east", {36, -4, 0}, {40, 4, 4});
      city.add("behind_west", {-40, -4, 0}, {-36, 4, 4});
      city.cells_within(0, 0, 8, 8);
      check_methods(city, [&](const auto& answers) {
        const CellOcclusion& answer = city.at(answers, {1, 1, 1.7});
        for (const char* name : {"wall", "slanting", "near_east", "near_west", "east", "west"})
          EXPECT_FALSE(city.hides(answer, name)) << name;
        EXPECT_TRUE(city.hides(answer, "behind_east"));
        EXPECT_TRUE(city.hides(answer, "behind_west"));
      });
    }
  }
}

// Walls on all sides, so all but the highest is hidden; and through the arcade's arch of 1 m one sees out.
TEST(OcclusionCase, CellInACourtyard) {
  SKIP_WITHOUT_GL();
  for (const bool arch : {false, true}) {
    OcclusionCity city;
    city.add_ground(60);
    city.add("west", {-26, -26, 0}, {-12, 26, 9});
    city.begin("east");
    if (arch) {
      city.add_box({12, -26, 0}, {26, 1, 9});
      city.add_box({12, 2, 0}, {26, 26, 9});
      city.add_box({12, 1, 3}, {26, 2, 9});
    } else {
      city.add_box({12, -26, 0}, {26, 26, 9});
    }
    city.add("south", {-12, -26, 0}, {12, -12, 9});
    city.add("north", {-12, 12, 0}, {12, 26, 9});
    city.add("outside", {40, -2, 0}, {46, 4, 4});
    city.add("far_west", {-46, -2, 0}, {-40, 4, 4});
    city.add("spire", {34, 34, 0}, {40, 40, 50});
    city.cells_within(-4, -4, 4, 4);
    check_methods(city, [&](const auto& answers) {
      for (const CellOcclusion& answer : answers) {
        EXPECT_TRUE(city.hides(answer, "far_west"));
        EXPECT_FALSE(city.hides(answer, "spire"));
      }
      EXPECT_EQ(city.hides(city.at(answers, {2, 2, 1.7}), "outside"), !arch);
    });
  }
}

// Each pillar hides something from every eye, all of them together hide nothing from all.
TEST(OcclusionCase, FenceOfThinPillars) {
  SKIP_WITHOUT_GL();
  OcclusionCity city;
  city.add_ground(60);
  city.begin("fence");
  for (int n = 0; n < 60; ++n) city.add_box({10, -15 + 0.5 * n, 0}, {10.15, -14.8 + 0.5 * n, 6});
  city.add("behind_fence", {14, 0, 0}, {14.5, 0.5, 2});
  city.add("wall", {20, -40, 0}, {30, 40, 10});
  city.add("behind_wall", {36, -4, 0}, {40, 4, 3});
  city.cells_within(0, 0, 4, 4);
  check_methods(city, [&](const auto& answers) {
    const CellOcclusion& answer = city.at(answers, {2, 2, 1.7});
    EXPECT_FALSE(city.hides(answer, "behind_fence"));
    EXPECT_FALSE(city.hides(answer, "wall"));
    EXPECT_TRUE(city.hides(answer, "behind_wall"));
  });
}

// The occluder is above the eyes, where no skyline counts it, and reaches over the cell and past it.
TEST(OcclusionCase, RoofOverhangingTheCell) {
  SKIP_WITHOUT_GL();
  OcclusionCity city;
  city.add_ground(60);
  city.begin("canopy");
  city.add_box({-16, -16, 4}, {12, 16, 9});
  city.add_box({-16, -16, 0}, {-14, -14, 4});
  city.add_box({-16, 14, 0}, {-14, 16, 4});
  city.add("on_top", {-3, -3, 9}, {1, 1, 11});
  city.add("under", {8, 8, 0}, {8.5, 8.5, 3});
  city.add("beyond", {30, -3, 0}, {34, 3, 6});
  city.add("wall", {-40, -40, 0}, {-28, 40, 10});
  city.add("behind_wall", {-50, -4, 0}, {-46, 4, 3});
  city.cells_within(-4, -4, 0, 0);
  check_methods(city, [&](const auto& answers) {
    const CellOcclusion& answer = city.at(answers, {-2, -2, 1.7});
    for (const char* name : {"canopy", "under", "beyond", "wall"})
      EXPECT_FALSE(city.hides(answer, name)) << name;
    EXPECT_TRUE(city.hides(answer, "on_top"));
    EXPECT_TRUE(city.hides(answer, "behind_wall"));
  });
}

// Shrunk for the whole cell, nothing is left of the wall; for its parts, enough.
TEST(OcclusionCase, WallThinnerThanTheCell) {
  SKIP_WITHOUT_GL();
  OcclusionCity city;
  city.settings.cells.size_m = 8, city.settings.occlusion.subdivide = 8;
  city.add_ground(60);
  city.add("wall", {16, -40, 0}, {18, 40, 10});
  city.add("behind_wall", {24, -4, 1}, {28, 4, 3});
  city.add("thin", {-16, -40, 0}, {-15.7, 40, 10});  // thinner than the parts: may hide nothing
  city.add("behind_thin", {-28, -4, 0}, {-24, 4, 3});
  city.add("high", {24, 8, 0}, {28, 12, 30});
  city.cells_within(0, 0, 8, 8);
  check_methods(city, [&](const auto& answers) {
    const CellOcclusion& answer = city.at(answers, {4, 4, 1.7});
    EXPECT_TRUE(city.hides(answer, "behind_wall"));
    for (const char* name : {"wall", "thin", "high"}) EXPECT_FALSE(city.hides(answer, name)) << name;
  });
}

// Ten thousand kilometres from the origin of its CRS a float has steps of a metre.
TEST(OcclusionCase, CoordinatesAtTenMillionMetres) {
  SKIP_WITHOUT_GL();
  std::vector<std::vector<CellOcclusion>> first;
  for (const double shift : {0.0, 1e7}) {
    OcclusionCity city;
    city.place = [&](const glm::dvec2& p) { return p + shift; };
    city.add_ground(60);
    city.add("wall", {10, -40, 0}, {20, 40, 12});
    city.add("behind", {30, -3, 0}, {36, 3, 3});
    city.add("tower", {40, -5, 0}, {50, 5, 45});
    city.add("turned", {0, 0, 0}, {0.5, 0.5, 2});
    city.add("slit", {30, 10, 0}, {30.3, 30, 2});
    city.cells_within(-6, -3, 1, 3);
    std::vector<std::vector<CellOcclusion>> all;
    check_methods(city, [&](const auto& answers) {
      EXPECT_TRUE(city.hides(city.at(answers, {-2, 2, 1.7}), "behind"));
      EXPECT_FALSE(city.hides(city.at(answers, {-2, 2, 1.7}), "tower"));
      all.push_back(answers);
    });
    if (first.empty()) first = all;
    ASSERT_EQ(first.size(), all.size());
    for (size_t m = 0; m < all.size(); ++m) {
      ASSERT_EQ(first[m].size(), all[m].size());
      for (size_t c = 0; c < all[m].size(); ++c) {
        EXPECT_EQ(first[m][c].occlusion.visible, all[m][c].occlusion.visible);
        EXPECT_EQ(first[m][c].occlusion.occluded, all[m][c].occlusion.occluded);
      }
    }
  }
}

}  // namespace
}  // namespace veduta
