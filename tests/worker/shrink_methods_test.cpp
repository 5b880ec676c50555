// Every shrinking method against the contract of Shrinker, on cities that are hard to shrink.
#include <gtest/gtest.h>

#include "scene/error.h"
#include "tests/worker/shrink_cities.h"
#include "tests/worker/shrink_property.h"

namespace veduta {
namespace {

using test::Looked;
using test::Plot;

class ShrinkMethod : public testing::TestWithParam<const char*> {
 protected:
  std::unique_ptr<Shrinker> shrinker_ = make_shrinker(GetParam());
};

ShrinkRequest small_windows() {
  ShrinkRequest request;
  request.half_extents_m = {{1, 1, 0.5}, {2, 1.5, 0.75}};
  request.resolution = 256;
  request.reach_m = 60;
  return request;
}

TEST_P(ShrinkMethod, HoldsOnEachKindOfPlot) {
  Looked total;
  for (int n = 0; n < static_cast<int>(Plot::count); ++n) {
    for (const uint32_t seed : {0u, 1u}) {
      SCOPED_TRACE(std::string(test::plot_name(static_cast<Plot>(n))) + ' ' + std::to_string(seed));
      const Looked looked =
          test::expect_conservative(test::one_plot(static_cast<Plot>(n), seed), *shrinker_, small_windows());
      total.bodies += looked.bodies, total.points += looked.points;
    }
  }
  EXPECT_GT(total.points, 1000u) << "a method that makes no occluders is not tested";
}

TEST_P(ShrinkMethod, HoldsInMixedCitiesOnSlopes) {
  Looked total;
  for (uint32_t seed = 0; seed < 4; ++seed) {
    SCOPED_TRACE(seed);
    const Looked looked = test::expect_conservative(test::random_city(seed), *shrinker_, small_windows());
    total.bodies += looked.bodies, total.points += looked.points;
  }
  EXPECT_GT(total.points, 1000u);
}

TEST_P(ShrinkMethod, GivesTheSameAgain) {
  const SealedBlock block = make_sealed_block(test::random_city(7), 0.25);
  const auto first = shrinker_->shrink(block, small_windows()),
             second = shrinker_->shrink(block, small_windows());
  ASSERT_EQ(first.size(), second.size());
  for (size_t w = 0; w < first.size(); ++w) {
    for (size_t r = 0; r < first[w].rings.size(); ++r) {
      EXPECT_EQ(first[w].rings[r].occluders.corners, second[w].rings[r].occluders.corners);
      EXPECT_EQ(first[w].rings[r].occluders.face_begin, second[w].rings[r].occluders.face_begin);
      EXPECT_EQ(first[w].rings[r].occluders.body_begin, second[w].rings[r].occluders.body_begin);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, ShrinkMethod, testing::Values("sealed", "planes", "sections", "vertex"),
                         [](const auto& method) { return std::string(method.param); });

}  // namespace
}  // namespace veduta
