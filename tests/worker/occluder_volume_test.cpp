#include "worker/reference/occluder_volume.h"

#include <gtest/gtest.h>

#include "tests/worker/shrink_cities.h"

namespace veduta {
namespace {

using reference::BodySet;
using reference::OccluderVolume;
using reference::SealedReference;
using test::Mesh;

/// A house [0, 10] x [0, 8] x [0, 6] on level ground.
Scene one_house() {
  Mesh mesh;
  mesh.ground(-5, -5, 15, 13, 0);
  mesh.object();
  mesh.box({{0, 0, 0}, {10, 8, 6}});
  return mesh.scene;
}

TEST(OccluderVolume, OfAHouseIsKnown) {
  const SealedBlock block = make_sealed_block(one_house(), 0.25);
  const SealedReference reference(block);
  OccluderMesh half, all, none;
  half.add_box({{1, 1, 0}, {5, 7, 5.5f}});
  all.add_box({{1, 1, 0}, {9, 7, 5.5f}});
  const OccluderVolume v = occluder_volume(block, reference, {1, 1, 0.5}, {&half, &all, &none}, 20000);
  EXPECT_NEAR(v.eroded_m3(), 8 * 6 * 5.5, 4 * v.eroded_error_m3());
  EXPECT_LT(v.eroded_error_m3(), 5);
  EXPECT_NEAR(v.kept_share(0), 0.5, 4 * v.kept_error(0));
  EXPECT_EQ(v.kept_share(1), 1);
  EXPECT_EQ(v.kept_share(2), 0);
  EXPECT_EQ(v.kept[1].outside, 0u);
}

TEST(OccluderVolume, CountsWhatIsNotSealed) {
  const SealedBlock block = make_sealed_block(one_house(), 0.25);
  OccluderMesh wide;
  wide.add_box({{0.5f, 1, 0}, {9, 7, 5.5f}});
  EXPECT_GT(occluder_volume(block, SealedReference(block), {1, 1, 0.5}, {&wide}, 20000).kept[0].outside,
            100u);
}

TEST(OccluderVolume, BodiesOfAnyShape) {
  OccluderMesh mesh;  // an L, not convex, without floor
  const std::vector<glm::vec3> outline{{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {1, 1, 0}, {1, 4, 0}, {0, 4, 0}};
  const glm::vec3 up(0, 0, 3);
  for (size_t n = 0; n < outline.size(); ++n) {
    const glm::vec3 a = outline[n], b = outline[(n + 1) % outline.size()];
    mesh.add_face({a, b, b + up, a + up});
    mesh.add_face({b, a, a + up, b + up});  // both sides
  }
  mesh.add_face({outline[0] + up, outline[1] + up, outline[2] + up, outline[3] + up});
  mesh.add_face({outline[0] + up, outline[3] + up, outline[4] + up, outline[5] + up});
  mesh.end_body();
  const BodySet bodies(mesh);
  EXPECT_TRUE(bodies.inside({3, 0.5, 2}));
  EXPECT_TRUE(bodies.inside({0.5, 3, 2}));
  EXPECT_FALSE(bodies.inside({3, 3, 2})) << "in its bounds alone";
  EXPECT_FALSE(bodies.inside({0.5, 0.5, 3.5}));
}

/// Blocks of a city, cut out, hold what the city holds: volumes add up.
TEST(OccluderVolume, BlocksCutFromACityAddUp) {
  const Scene scene = test::random_city(11);
  const SealedBlock whole = make_sealed_block(scene, 0.25);
  const glm::dvec3 half(1, 1, 0.5);
  const OccluderVolume all = occluder_volume(whole, SealedReference(whole), half, {}, 20000);
  double sum = 0, variance = 0;
  for (const auto& [i0, i1] : {std::pair{0, 20}, {20, whole.i1}}) {
    const SealedBlock block = reference::cut_block(whole.region, whole.triangles, i0, i1, 0, whole.j1, 8);
    const OccluderVolume part = occluder_volume(block, SealedReference(block), half, {}, 20000);
    sum += part.eroded_m3(), variance += part.eroded_error_m3() * part.eroded_error_m3();
  }
  EXPECT_GT(all.eroded_m3(), 100);
  EXPECT_NEAR(sum, all.eroded_m3(), 4 * std::sqrt(variance + all.eroded_error_m3() * all.eroded_error_m3()));
}

}  // namespace
}  // namespace veduta
