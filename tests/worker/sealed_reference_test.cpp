#include "worker/reference/sealed_reference.h"

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include "tests/worker/shrink_cities.h"
#include "tests/worker/shrink_property.h"

namespace veduta {
namespace {

using reference::SealedReference;
using test::Looked;
using test::Mesh;
using test::Plot;

/// A house [0, 10] x [0, 8] x [0, 6] on level ground.
Mesh one_house() {
  Mesh mesh;
  mesh.ground(-5, -5, 15, 15, 0);
  mesh.object();
  mesh.box({{0, 0, 0}, {10, 8, 6}});
  return mesh;
}

TEST(SealedReference, AWindowMayEndAtAWallAndNotCrossIt) {
  for (const double seed : {0.25, 0.23, 0.4}) {  // the walls on the lattice and beside it
    const SealedReference sealed(one_house().scene, seed);
    const glm::dvec3 half(1, 1, 1);
    EXPECT_TRUE(sealed.sealed({5, 4, 3}, half));
    EXPECT_TRUE(sealed.sealed({1, 4, 3}, half)) << "ends at a wall";
    EXPECT_TRUE(sealed.sealed({1, 7, 5}, half)) << "ends at two walls and the roof";
    EXPECT_TRUE(sealed.sealed({5, 4, 0}, half)) << "reaches below the scene";
    EXPECT_TRUE(sealed.sealed({5, 4, -9}, half)) << "is below the scene";
    EXPECT_FALSE(sealed.sealed({0.99, 4, 3}, half));
    EXPECT_FALSE(sealed.sealed({5, 7.01, 3}, half));
    EXPECT_FALSE(sealed.sealed({5, 4, 5.01}, half));
    EXPECT_FALSE(sealed.sealed({-1.05, 4, 3}, half)) << "outside, and no wall in it";
    EXPECT_FALSE(sealed.sealed({-3, 4, 3}, half));
    EXPECT_FALSE(sealed.sealed({60, 4, 3}, half)) << "outside of the frame";
    EXPECT_FALSE(sealed.sealed({5, 4, 3}, {5.5, 1, 1}));
    EXPECT_FALSE(sealed.sealed({-0.02, 4, 3}, {0.015, 0.05, 0.05})) << "in the air of a wall's own seed";
  }
}

TEST(SealedReference, PartyWallsAreInsideAndSlitsAreNot) {
  for (const float gap : {0.0f, -0.005f, 0.1f, 0.6f}) {
    Mesh mesh;
    mesh.ground(-5, -5, 25, 15, 0);
    mesh.object();
    mesh.box({{0, 0, 0}, {10, 8, 6}});
    mesh.object();
    mesh.box({{10 + gap, 0, 0}, {20, 8, 6}});
    const SealedReference sealed(mesh.scene, 0.25);
    EXPECT_EQ(sealed.sealed({10, 4, 3}, {1, 1, 1}), gap < 0.5) << gap;
    EXPECT_TRUE(sealed.sealed({8.9, 4, 3}, {1, 1, 1}));
  }
}

TEST(SealedReference, TheFillOfABlockIsItsOwn) {
  const Scene scene = test::random_city(3);
  const SealedReference own(scene, 0.25), of_block(make_sealed_block(scene, 0.25));
  ASSERT_EQ(own.reached_seeds(), of_block.reached_seeds());
  int sealed = 0;
  test::Random random(5);
  for (int n = 0; n < 2000; ++n) {
    const glm::dvec3 q = random.point(scene.bounds()), half(random.real(0.2, 2), random.real(0.2, 2), 0.5);
    const bool here = own.sealed(q, half);
    ASSERT_EQ(here, of_block.sealed(q, half));
    sealed += here;
  }
  EXPECT_GT(sealed, 50);
  EXPECT_LT(sealed, 1500);
}

/// Where a point sees out of the box's window through its open side, the window is not sealed.
TEST(SealedReference, AnOpenBoxIsFreeInside) {
  const SealedReference open(test::one_plot(Plot::open_box, 1), 0.25);
  EXPECT_FALSE(open.sealed({0, 0, 3}, {1, 1, 1}));
  const SealedReference closed(test::one_plot(Plot::box, 1), 0.25);
  EXPECT_TRUE(closed.sealed({0, 0, 3}, {1, 1, 1}));
}

TEST(SealedReference, AHoleIsOpenFromTwoSeedsAndClosedBelowOne) {
  const SealedReference open(test::one_plot(Plot::hole_open, 1), 0.25);
  EXPECT_FALSE(open.sealed({0, 0, 3}, {1, 1, 1}));
  const SealedReference closed(test::one_plot(Plot::hole_closed, 1), 0.25);
  EXPECT_TRUE(closed.sealed({0, 0, 3}, {1, 1, 1}));
}

/// Shrinks the house of one_house as it should be, or less by `missing_m` at one side.
class HouseShrinker final : public Shrinker {
 public:
  explicit HouseShrinker(float missing_m) : missing_m_(missing_m) {}
  std::vector<WindowOccluders> shrink(const SealedBlock&, const ShrinkRequest& request) const override {
    std::vector<WindowOccluders> all;
    for (const glm::dvec3& e : request.half_extents_m) {
      WindowOccluders window{e, {}};
      for (const RingWindow& ring : request.rings(e)) {
        const glm::vec3 x = e + ring.h_m;
        OccluderMesh mesh;
        mesh.add_box({glm::vec3(x.x, x.y, -1), glm::vec3(10, 8, 6) - x + glm::vec3(missing_m_, 0, 0)});
        window.rings.push_back({ring.h_m, static_cast<float>(ring.depth_limit_m), mesh});
      }
      all.push_back(window);
    }
    return all;
  }

 private:
  float missing_m_;
};

TEST(SealedReference, ThePropertyTellsAMethodThatShrinksTooLittle) {
  ShrinkRequest request;
  request.half_extents_m = {{1, 1, 0.5}, {2, 2, 0.75}};
  request.resolution = 256;
  request.reach_m = 40;
  const Looked looked = test::expect_conservative(one_house().scene, HouseShrinker(0), request);
  EXPECT_GE(looked.bodies, 4u);
  EXPECT_GE(looked.points, 100u);
  ::testing::TestPartResultArray failures;
  {
    const ::testing::ScopedFakeTestPartResultReporter reporter(
        ::testing::ScopedFakeTestPartResultReporter::INTERCEPT_ONLY_CURRENT_THREAD, &failures);
    test::expect_conservative(one_house().scene, HouseShrinker(0.01f), request);
  }
  EXPECT_EQ(failures.size(), 1);
}

}  // namespace
}  // namespace veduta
