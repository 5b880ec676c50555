#include "worker/reference/exact_erosion.h"

#include <gtest/gtest.h>

#include "scene/error.h"
#include "tests/worker/shrink_cities.h"
#include "worker/reference/occluder_volume.h"

namespace veduta {
namespace {

using reference::ExactErosion;
using test::Mesh;
using Solid = std::vector<ExactErosion::Triangle>;

Solid solid_of(const Mesh& mesh) {
  Solid solid;
  for (const PlacedTriangle& t : all_triangles(mesh.scene)) solid.push_back(t.corner);
  return solid;
}

Solid box(const Box& b) {
  Mesh mesh;
  mesh.object();
  mesh.box(b);
  return solid_of(mesh);
}

TEST(ExactErosion, OfABoxIsABoxThatStandsOnTheGround) {
  const ExactErosion eroded({box({{0, 0, 0}, {10, 8, 6}})}, {1, 1, 0.5});
  EXPECT_NEAR(eroded.volume_m3(), 8 * 6 * 5.5, 1e-9);
  EXPECT_TRUE(eroded.contains({1, 1, 0}));
  EXPECT_TRUE(eroded.contains({5, 4, 5.5}));
  EXPECT_FALSE(eroded.contains({0.999, 4, 3}));
  EXPECT_FALSE(eroded.contains({5, 4, 5.501}));
}

TEST(ExactErosion, OfTouchingBoxesIsThatOfTheirUnion) {
  const ExactErosion together({box({{0, 0, 0}, {3, 8, 6}}), box({{3, 0, 0}, {6, 8, 6}})}, {1, 1, 0.5});
  EXPECT_NEAR(together.volume_m3(), 4 * 6 * 5.5, 1e-9);
  const ExactErosion one({box({{0, 0, 0}, {3, 8, 6}})}, {1, 1, 0.5});
  EXPECT_NEAR(one.volume_m3(), 1 * 6 * 5.5, 1e-9);
}

TEST(ExactErosion, OfWhatIsThinnerThanTheWindowIsNothing) {
  const ExactErosion eroded({box({{0, 0, 0}, {1.9f, 8, 6}})}, {1, 1, 0.5});
  EXPECT_EQ(eroded.volume_m3(), 0);
  EXPECT_FALSE(eroded.contains({0.95, 4, 3}));
}

void expect_refused(const Solid& solid, ExitStatus status, size_t most_facets = 100) {
  try {
    ExactErosion({solid}, {1, 1, 1}, most_facets);
    FAIL() << "was taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), status) << error.what();
  }
}

TEST(ExactErosion, RefusesWhatIsNoSolid) {
  Solid open = box({{0, 0, 0}, {4, 4, 4}});
  open.pop_back();
  expect_refused(open, ExitStatus::bad_input);
  Solid turned = box({{0, 0, 0}, {4, 4, 4}});
  std::swap(turned[0][0], turned[0][1]);
  expect_refused(turned, ExitStatus::bad_input);
  Solid crossing = box({{0, 0, 0}, {4, 4, 4}});
  const Solid other = box({{2, 2, 2}, {6, 6, 6}});
  crossing.insert(crossing.end(), other.begin(), other.end());
  expect_refused(crossing, ExitStatus::bad_input);
  expect_refused(box({{0, 0, 0}, {4, 4, 4}}), ExitStatus::usage, 11);
}

/// Seeds and random points against exact arithmetic: a turned house with a gable.
TEST(ExactErosion, AgreesWithTheReferenceOfSealedSpace) {
  const Scene scene = test::one_plot(test::Plot::gable, 4);
  Solid solid;
  for (const PlacedTriangle& t : all_triangles(scene)) {
    if (t.kind == Kind::building) solid.push_back(t.corner);
  }
  const glm::dvec3 half(1, 1, 0.5);
  const ExactErosion exact({solid}, half);
  const SealedBlock block = make_sealed_block(scene, 0.25);
  const reference::SealedReference sealed(block);
  const auto sampled = occluder_volume(block, sealed, half, {}, 40000);
  EXPECT_GT(exact.volume_m3(), 50);
  EXPECT_NEAR(sampled.eroded_m3(), exact.volume_m3(), 4 * sampled.eroded_error_m3());
  test::Random random(9);
  int inside = 0;
  for (int n = 0; n < 300; ++n) {
    const glm::dvec3 q(random.real(-6, 6), random.real(-6, 6), random.real(0.01, 13));
    EXPECT_EQ(exact.contains(q), sealed.sealed(q, half)) << q.x << ' ' << q.y << ' ' << q.z;
    inside += exact.contains(q);
  }
  EXPECT_GT(inside, 20);
}

}  // namespace
}  // namespace veduta
