// The reference itself against boxes, where everything is known.
#include "worker/reference/cell_reference.h"

#include <gtest/gtest.h>

#include "tests/worker/convex_bodies.h"
#include "tests/worker/mesh.h"

namespace veduta {
namespace {

using reference::GrownPolygons;
using test::Random;

/// Does the segment meet the box? By slabs.
bool meets_box(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& lower,
               const glm::dvec3& upper) {
  double enter = 0, leave = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double step = to[axis] - from[axis], a = (lower[axis] - from[axis]) / step,
                 b = (upper[axis] - from[axis]) / step;
    enter = std::max(enter, std::min(a, b)), leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave;
}

TEST(GrownPolygons, ABoxGrownByABoxIsALargerBox) {
  Random random(1);
  int met = 0, apart = 0;
  for (int n = 0; n < 200; ++n) {
    const Box space{{-10, -10, -10}, {10, 10, 10}};
    GrownPolygons polygons;
    std::vector<std::pair<glm::dvec3, glm::dvec3>> grown;
    for (int b = 0; b < 7; ++b) {
      Box box;
      box.extend(random.point(space)), box.extend(box.lower + 0.2f * glm::abs(random.point(space)));
      const glm::dvec3 by(0.1 * b, random.real(0, 1), random.real(0, 1));
      OccluderMesh mesh;
      mesh.add_box(box);
      polygons.add(mesh, by);
      grown.emplace_back(glm::dvec3(box.lower) - by, glm::dvec3(box.upper) + by);
    }
    polygons.build();
    for (int s = 0; s < 50; ++s) {
      const glm::dvec3 from(3.0f * random.point(space)), to(random.point(space));
      const auto in = [&](const glm::dvec3& p) {
        return std::any_of(grown.begin(), grown.end(), [&](const auto& b) {
          return meets_box(p, p + glm::dvec3(1e-9, 2e-9, 3e-9), b.first, b.second);
        });
      };
      if (in(from)) continue;  // the inside of a body is nobody's place to ask from
      const bool expected = std::any_of(
          grown.begin(), grown.end(), [&](const auto& b) { return meets_box(from, to, b.first, b.second); });
      EXPECT_EQ(polygons.meet(from, to), expected);
      (expected ? met : apart) += 1;
    }
  }
  EXPECT_GT(met, 500);
  EXPECT_GT(apart, 500);
}

/// Bodies of many shapes: a segment that comes within a box of a point of them meets them grown by that box.
TEST(GrownPolygons, ReachAsFarAsTheBoxAndNoFarther) {
  Random random(2);
  int met = 0;
  for (int n = 0; n < 100; ++n) {
    OccluderMesh mesh;
    test::add_body(mesh, test::random_body(random, {2, 2, 2}), {0, 0, 0});
    const glm::dvec3 by(random.real(0, 1), random.real(0, 1), random.real(0, 1));
    GrownPolygons grown;
    grown.add(mesh, by), grown.build();
    for (int s = 0; s < 100; ++s) {
      // Through a point of a polygon, moved by less than the box, or by a little more than its corner.
      const size_t f = static_cast<size_t>(random.integer(0, static_cast<int>(mesh.faces()) - 1));
      const glm::dvec3 a(mesh.corners[mesh.face_begin[f]]), b(mesh.corners[mesh.face_begin[f] + 1]);
      const glm::dvec3 on = glm::mix(a, b, random.real(0, 1));
      const glm::dvec3 moved =
          on + by * glm::dvec3(random.real(-1, 1), random.real(-1, 1), random.real(-1, 1));
      const glm::dvec3 direction(random.real(-9, 9), random.real(-9, 9), random.real(-9, 9));
      EXPECT_TRUE(grown.meet(moved - direction, moved + direction));
      const glm::dvec3 corner(mesh.bounds(0).upper);
      const glm::dvec3 beyond = corner + by + 1e-5, along(direction.x, -direction.x, 0);
      met += grown.meet(beyond, beyond + glm::dvec3(glm::abs(direction)));
      met += grown.meet(beyond - glm::dvec3(0, 0, 9), beyond + glm::dvec3(0, 0, 9));
    }
  }
  EXPECT_EQ(met, 0) << "no body is there";
}

TEST(GrownPolygons, NothingMeetsNothing) {
  GrownPolygons none;
  none.build();
  EXPECT_FALSE(none.meet({0, 0, 0}, {9, 9, 9}));
}

}  // namespace
}  // namespace veduta
