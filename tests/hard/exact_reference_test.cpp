// The exact reference itself: known answers, and its hierarchy against looking at every triangle.
#include "tests/hard/exact_reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "tests/hard/exact_geometry.h"
#include "tests/hard/segment_distance.h"
#include "tests/hard/sightings.h"

namespace veduta::hard {
namespace {

/// Triangles, each an object of its own.
ExactModel model_of(const std::vector<std::array<Point, 3>>& triangles) {
  ExactModel model;
  for (const auto& corners : triangles) {
    model.triangles.push_back({corners, static_cast<uint32_t>(model.objects.size())});
    model.objects.push_back(std::to_string(model.objects.size()));
  }
  return model;
}

const std::array<Point, 3> near_wall{{{1, -1, -1}, {1, 1, -1}, {1, 0, 1}}};
const std::array<Point, 3> far_wall{{{2, -4, -4}, {2, 4, -4}, {2, 0, 4}}};

std::vector<uint32_t> met(const ExactReference& reference, const Point& at) {
  const auto sight = reference.look({0, 0, 0}, at);
  return sight ? sight->triangles : std::vector<uint32_t>{};
}

TEST(ExactReference, MeetsTheNearest) {
  const ExactReference reference(model_of({far_wall, near_wall}), {{0, 0, 0}});
  EXPECT_EQ(met(reference, {2, 0, 0}), std::vector{1u});
  EXPECT_EQ(met(reference, {2, 1.5, -3}), std::vector{0u}) << "beside the near one";
  EXPECT_EQ(met(reference, {-2, 0, 0}), std::vector<uint32_t>{}) << "behind the eye";
  const auto sight = reference.look({0, 0, 0}, {4, 1, 0});
  ASSERT_TRUE(sight);
  EXPECT_EQ(sight->point, (Point{1, 0.25, 0}));
}

TEST(ExactReference, RefusesWhatItsIntegersDoNotHold) {
  const ExactReference reference(model_of({near_wall}), {{0, 0, 0}});
  EXPECT_THROW(reference.look({0, 0, 1e9}, {1, 0, 0}), std::out_of_range);
}

// By a hair on either side of an edge, and on the edge: beyond what a float or a rounded double tells apart.
TEST(ExactReference, EdgesAreDecidedExactly) {
  const double hair = std::exp2(-30);
  const ExactReference reference(model_of({near_wall, far_wall}), {{0, 0, 0}});
  EXPECT_EQ(met(reference, {1, 0, -1 + hair}), std::vector{0u});
  EXPECT_EQ(met(reference, {1, 0, -1 - hair}), std::vector{1u});
  EXPECT_EQ(met(reference, {1, 0, -1}), std::vector<uint32_t>{}) << "an edge on the way leaves a doubt";
  EXPECT_EQ(met(reference, {1, 0.5, 0}), std::vector<uint32_t>{}) << "on a slanting edge";
}

TEST(ExactReference, CoincidingTrianglesAreMetTogether) {
  const std::array<Point, 3> over{{{1, -1, -1}, {1, 0, -3}, {1, 0.5, 1}}};
  const ExactReference reference(model_of({near_wall, over, near_wall}), {{0, 0, 0}});
  EXPECT_EQ(met(reference, {1, -0.25, -0.5}), (std::vector{0u, 1u, 2u}));
  EXPECT_EQ(met(reference, {1, 0.75, -0.875}), (std::vector{0u, 2u}));
}

// Neither what has no area nor what is seen from the side is ever seen; both leave a doubt only where they
// are.
TEST(ExactReference, TrianglesWithoutArea) {
  const std::array<Point, 3> needle{{{0.5, -1, 0}, {0.5, 0, 0}, {0.5, 1, 0}}};
  const std::array<Point, 3> edge_on{
      {{0.5, -1, 0.5}, {0.75, -1, 0.75}, {0.5, 1, 0.5}}};  // its plane has the eye
  const ExactReference reference(model_of({near_wall, needle, edge_on}), {{0, 0, 0}});
  EXPECT_EQ(met(reference, {1, 0, 0}), std::vector<uint32_t>{});
  EXPECT_EQ(met(reference, {1, 0, 0.125}), std::vector{0u});
  EXPECT_EQ(met(reference, {1, 0, -0.5}), std::vector{0u}) << "below both";
}

TEST(ExactReference, TenMillionMetresAwayAHairIsAHair) {
  std::vector<std::array<Point, 3>> moved{near_wall, far_wall};
  for (auto& triangle : moved)
    for (Point& p : triangle) p[0] += 1e7, p[1] -= 1e7;
  const ExactReference reference(model_of(moved), {{1e7, -1e7, 0}});
  const double hair = std::exp2(-25);
  const auto met_at = [&](double z) { return reference.look({1e7, -1e7, 0}, {1e7 + 1, -1e7, z})->triangles; };
  EXPECT_EQ(met_at(-1 + hair), std::vector{0u});
  EXPECT_EQ(met_at(-1 - hair), std::vector{1u});
}

TEST(ExactReference, HierarchyFindsWhatASearchOfAllFinds) {
  std::mt19937 random(7);
  const auto real = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
  };
  for (const double grid : {0.0, 0.5}) {  // anywhere; and where edges, corners and planes coincide
    const auto point = [&](double reach) {
      Point p{real(-reach, reach), real(-reach, reach), real(-reach, reach)};
      for (double& c : p) c = grid > 0 ? grid * std::round(c / grid) : c;
      return p;
    };
    std::vector<std::array<Point, 3>> triangles;
    for (int n = 0; n < 300; ++n) {
      const Point middle = point(5);
      std::array<Point, 3> t{point(1), point(1), point(1)};
      for (Point& p : t)
        for (size_t axis = 0; axis < 3; ++axis) p[axis] += middle[axis];
      triangles.push_back(t);
    }
    const ExactReference reference(model_of(triangles), {{9, 9, 9}, {-9, -9, -9}});
    size_t seen = 0;
    for (int n = 0; n < 4000; ++n) {
      const Point eye = point(7), at = point(5);
      const auto slow = reference.look_at_all(eye, at), fast = reference.look(eye, at);
      if (slow) {
        ASSERT_TRUE(fast);
        EXPECT_EQ(slow->triangles, fast->triangles);
        ++seen;
      } else if (grid == 0) {
        EXPECT_FALSE(fast);  // else: a triangle whose plane has the line may be far away from it
      }
    }
    EXPECT_GT(seen, 500u);
  }
}

TEST(ExactGeometry, RatiosAreComparedExactly) {
  const Wide large = Wide{1} << 115;
  EXPECT_TRUE((Along{large - 1, large} < Along{large, large + 1}));
  EXPECT_FALSE((Along{large, large + 1} < Along{large - 1, large}));
  EXPECT_TRUE((Along{-large, large + 1} < Along{-large + 1, large}));
  EXPECT_TRUE((Along{-1, large} < Along{0, 1}));
  EXPECT_TRUE((Along{large, 3} == Along{2 * large, 6}));
}

TEST(SegmentDistance, KnownAnswers) {
  const std::array<Point, 3> t{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
  EXPECT_EQ(segment_distance({1, 1, 1}, {1, 1, -1}, t), 0) << "passes through";
  EXPECT_DOUBLE_EQ(segment_distance({1, 1, 3}, {1, 1, 1}, t), 1);
  EXPECT_DOUBLE_EQ(segment_distance({-2, -5, 0}, {-2, 5, 0}, t), 2) << "beside an edge, in the plane";
  EXPECT_DOUBLE_EQ(segment_distance({-3, 4, 4}, {9, 4, 4}, t), 4) << "over a corner";
  EXPECT_DOUBLE_EQ(point_distance({3, 3, 0}, t), std::sqrt(2));
}

// A room with a door: eyes are in the part of the cell from which one can walk to the stand.
TEST(Sightings, EyesAreWhereAViewerCertainlyCanBe) {
  // A wall at x = 0 from y = -9 to 9, ground below.
  const ExactReference reference(
      model_of({{{{0, -9, -9}, {0, 9, -9}, {0, 0, 30}}}, {{{-9, -9, 0}, {9, -9, 0}, {0, 18, 0}}}}), {});
  LookAbout about;
  about.stands = {{1, 0, 2}}, about.clearance_m = 0.25;
  const std::vector<Point> eyes = certain_eyes(reference, {{-1, -1, 0}, {1, 1, 1}}, about);
  EXPECT_EQ(eyes.size(), about.eyes);
  for (const Point& eye : eyes) {
    EXPECT_GT(eye[0], 0.25);
    EXPECT_GT(eye[2], 0.25);
  }
  about.stands.clear();
  EXPECT_TRUE(certain_eyes(reference, {{-1, -1, 0}, {1, 1, 1}}, about).empty());
}

TEST(Sightings, ASlitIsFoundAndToldApart) {
  // Two halves of a wall with a slit of a hundredth between them, something behind.
  const auto square = [](double x, double y0, double y1) {
    return std::vector<std::array<Point, 3>>{{{{x, y0, -5}, {x, y1, -5}, {x, y1, 5}}},
                                             {{{x, y0, -5}, {x, y1, 5}, {x, y0, 5}}}};
  };
  std::vector<std::array<Point, 3>> triangles;
  for (const auto& part : {square(2, -5, 0), square(2, 0.01, 5), square(4, -1, 1)})
    triangles.insert(triangles.end(), part.begin(), part.end());
  const ExactReference reference(model_of(triangles), {{0, 0, 0}});
  LookAbout about;
  const std::vector<Point> eyes{{0, 0, 0}, {0, 0.05, 0}, {0, -0.1, 0.3}};
  const auto behind = [&] {
    size_t found = 0;
    for (const Sighting& s : look_about(reference, eyes, about))
      if (s.sight.triangles.front() >= 4) found += 1 + 10 * s.through_gap;
    return found;
  };
  EXPECT_EQ(behind(), 2u);
  about.gaps = {{{1.9, -0.1, -5}, {2.1, 0.1, 5}}};
  EXPECT_EQ(behind(), 22u);
}

}  // namespace
}  // namespace veduta::hard
