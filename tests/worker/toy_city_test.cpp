// Toy cities through the whole worker: "A must not see B", "C must be seen", and rays that agree.
#include "tests/worker/toy_city.h"

#include <map>
#include <optional>

namespace veduta {
namespace {

using test::ToyCity;

TEST(ToyCity, WallHidesWhatIsBehindAndLower) {
  ToyCity city;
  city.add_ground(60);
  city.add("wall", {10, -40, 0}, {20, 40, 12});
  city.add("b", {30, -3, 0}, {36, 3, 3});
  city.add("tower", {40, -5, 0}, {50, 5, 45});
  city.add("left", {-20, 10, 0}, {-12, 18, 6});
  city.cells_within(-10, -8, 0, 8);
  BAKE_OR_SKIP(city);
  EXPECT_FALSE(city.sees({-6, 2, 1.7}, "b")) << "the wall is 12 m high and 80 m long";
  EXPECT_TRUE(city.sees({-6, 2, 1.7}, "wall"));
  EXPECT_TRUE(city.sees({-6, 2, 1.7}, "left"));
  ASSERT_TRUE(city.sees({-6, 2, 1.7}, "tower")) << "it stands out above the wall";
  const VisibilityIndex tower = city.seen_from({-6, 2, 1.7}, "tower");
  EXPECT_TRUE(tower == completely_visible || tower.z >= 1) << "its top must be drawn";
  city.expect_verified();
}

TEST(ToyCity, StreetCanyonShowsItsEndAndHidesTheNextStreet) {
  ToyCity city;
  city.add_ground(90);
  city.add("south_row", {-80, -20, 0}, {60, -6, 10});
  city.add("north_row", {-80, 6, 0}, {60, 20, 10});
  city.add("next_street", {-10, 30, 0}, {0, 38, 8});
  city.add("street_end", {70, -5, 0}, {78, 5, 8});
  city.cells_within(-30, -4, 0, 4);
  BAKE_OR_SKIP(city);
  for (const double x : {-26.0, -14.0, -2.0}) {
    EXPECT_FALSE(city.sees({x, 2, 1.7}, "next_street")) << "from x = " << x;
    EXPECT_TRUE(city.sees({x, 2, 1.7}, "street_end")) << "from x = " << x;
    EXPECT_TRUE(city.sees({x, 2, 1.7}, "north_row"));
    EXPECT_TRUE(city.sees({x, 2, 1.7}, "south_row"));
  }
  city.expect_verified();
}

TEST(ToyCity, CourtyardSeesOnlyWhatRisesAboveIt) {
  ToyCity city;
  city.add_ground(90);
  city.add("west", {-30, -30, 0}, {-18, 30, 9});
  city.add("east", {18, -30, 0}, {30, 30, 9});
  city.add("south", {-18, -30, 0}, {18, -18, 9});
  city.add("north", {-18, 18, 0}, {18, 30, 9});
  city.add("outside", {50, -4, 0}, {58, 4, 5});
  city.add("spire", {60, 20, 0}, {68, 28, 60});
  city.cells_within(-6, -6, 6, 6);
  BAKE_OR_SKIP(city);
  EXPECT_FALSE(city.sees({1, 1, 1.7}, "outside"));
  EXPECT_TRUE(city.sees({1, 1, 1.7}, "spire"));
  for (const char* wing : {"west", "east", "south", "north"})
    EXPECT_TRUE(city.sees({1, 1, 1.7}, wing)) << wing;
  city.expect_verified();
}

TEST(ToyCity, GapOfTwoSeedsIsSeenThrough) {
  // The gap lies askew to the grid, where it is hardest to find.
  for (const double offset : {0.0, 0.031, 0.0625, 0.1}) {
    ToyCity city;
    const double seed = city.settings().navigation.seed_size_m, gap = 2 * seed;
    city.add_ground(60);
    city.add("wall_south", {10, -40, 0}, {20, offset, 12});
    city.add("wall_north", {10, offset + gap, 0}, {20, 40, 12});
    city.add("b", {30, -3, 0}, {36, 3, 3});
    city.cells_within(0, -1, 8, 4);
    BAKE_OR_SKIP(city);
    EXPECT_TRUE(city.sees({4, 1, 1.7}, "b")) << "through a gap of " << gap << " m at y = " << offset << " m";
    city.expect_verified();
  }
}

TEST(ToyCity, WallsThatTouchHideTogether) {
  // Ten houses 6 m wide: each alone is too narrow for the 4 m cells' parts to leave much of it.
  ToyCity city;
  city.settings().occlusion.subdivide = 1;
  city.add_ground(60);
  for (int n = 0; n < 10; ++n)
    city.add("house" + std::to_string(n), {12, -30 + 6 * n, 0}, {22, -24 + 6 * n, 10});
  city.add("b", {34, -3, 0}, {38, 3, 3});
  city.cells_within(-4, -4, 4, 4);
  BAKE_OR_SKIP(city);
  EXPECT_FALSE(city.sees({1, 1, 1.7}, "b"));
  city.expect_verified();
}

TEST(ToyCity, SameRowsFarFromTheCoordinateOrigin) {
  std::optional<std::map<std::string, VisibilityIndex>> first;
  for (const double shift : {0.0, 1e7}) {
    ToyCity city;
    const glm::dvec3 s(shift, shift, 0);
    city.add("ground", s + glm::dvec3(-60, -60, -1), s + glm::dvec3(60, 60, 0));
    city.add("wall", s + glm::dvec3(10, -40, 0), s + glm::dvec3(20, 40, 12));
    city.add("b", s + glm::dvec3(30, -3, 0), s + glm::dvec3(36, 3, 3));
    city.add("tower", s + glm::dvec3(40, -5, 0), s + glm::dvec3(50, 5, 45));
    city.cells_within(shift - 6, shift - 3, shift + 1, shift + 3);
    BAKE_OR_SKIP(city);
    std::map<std::string, VisibilityIndex> row;
    for (const char* name : {"wall", "b", "tower"})
      row[name] = city.seen_from(s + glm::dvec3(-2, 2, 1.7), name);
    if (!first) first = row;
    EXPECT_EQ(*first, row);
  }
}

TEST(ToyCity, NoPlaceToStandIsBadInput) {
  ToyCity city;
  city.add_ground(20);
  city.add("block", {-20, -20, 0}, {20, 20, 10});
  try {
    city.bake();
    FAIL() << "baked a city without a place to stand in";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::bad_input);
  }
}

}  // namespace
}  // namespace veduta
