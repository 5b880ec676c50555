#include "worker/eroded_samples.h"

#include <gtest/gtest.h>

#include "tests/worker/shrink_cities.h"
#include "worker/reference/grid_reference.h"

namespace veduta {
namespace {

using test::Mesh;

TEST(ErodedSamples, AreThoseWhoseWindowNoExposedPiecePasses) {
  size_t samples_looked_at = 0;
  for (uint32_t city = 0; city < 3; ++city) {
    const SealedBlock block = make_sealed_block(test::random_city(city), 0.25);
    const ExposedSurface surface = exposed_surface(block);
    const Obstacles obstacles(surface, 8);
    const glm::dvec3 window(1.1, 1.1, 0.6);
    const ErodedSamples samples(block, obstacles, window, -100);
    for (const auto& component : samples.components()) {
      for (const auto& sample : component) {
        ++samples_looked_at;
        for (uint32_t p = 0; p < obstacles.size(); ++p) {
          for (const glm::dvec3* c = obstacles.begin(p) + 2; c < obstacles.end(p); ++c) {
            const glm::dvec3 triangle[3] = {*obstacles.begin(p), c[-1], *c};
            ASSERT_FALSE(
                reference::triangle_touches_box(triangle, sample.at - window, sample.at + window, -1e-9));
          }
        }
      }
    }
  }
  EXPECT_GT(samples_looked_at, 200u);
}

TEST(ErodedSamples, OfABlockFillItWithoutTheWindow) {
  Mesh mesh;
  mesh.ground(-10, -10, 40, 30, 0);
  mesh.object();
  mesh.box({{0, 0, 0}, {24, 16, 9}});
  const SealedBlock block = make_sealed_block(mesh.scene, 0.125);
  const ExposedSurface surface = exposed_surface(block);
  const Obstacles obstacles(surface, 8);
  const ErodedSamples samples(block, obstacles, {2, 2, 0.5}, 0);
  ASSERT_EQ(samples.components().size(), 1u) << "and nothing of the ground";
  const auto& all = samples.components().front();
  const glm::dvec3 step = samples.step_m();
  EXPECT_NEAR(static_cast<double>(all.size()) * step.x * step.y * step.z, 20.0 * 12 * 8.5,
              0.1 * 20 * 12 * 8.5);
  EXPECT_GE(all.front().depth, all.back().depth);
  EXPECT_EQ(all.back().depth, 1u);
  EXPECT_NEAR(all.front().at.x, 12, 6.5) << "the deepest is in the middle";
  EXPECT_NEAR(all.front().at.y, 8, 2);
}

TEST(ErodedSamples, HousesApartAreComponentsAndTheGroundIsNone) {
  Mesh mesh;
  mesh.ground(-10, -10, 60, 30, 0);
  for (const float x : {0.0f, 20.0f, 40.0f}) {
    mesh.object();
    mesh.box({{x, 0, 0}, {x + 12, 10, 9}});
  }
  const SealedBlock block = make_sealed_block(mesh.scene, 0.25);
  const ExposedSurface surface = exposed_surface(block);
  const Obstacles obstacles(surface, 8);
  EXPECT_EQ(ErodedSamples(block, obstacles, {2, 2, 0.5}, -50).components().size(), 3u);
}

}  // namespace
}  // namespace veduta
