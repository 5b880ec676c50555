#include "worker/swept_prism.h"

#include <gtest/gtest.h>

#include "tests/worker/mesh.h"

namespace veduta {
namespace {

using test::Random;
using Triangle = std::array<glm::dvec3, 3>;

const Triangle base{glm::dvec3(0, 0, 0), {4, 0, 0}, {0, 4, 0}};

Triangle moved(const Triangle& t, const glm::dvec3& by) {
  return {t[0] + by, t[1] + by, t[2] + by};
}

TEST(SweptPrism, TouchingIsNotIntersecting) {
  const SweptPrism up(base, moved(base, {0, 0, 2}));
  EXPECT_FALSE(intersect(up, SweptPrism(moved(base, {0, 0, 2}), moved(base, {0, 0, 3}))))
      << "a face in common";
  EXPECT_FALSE(intersect(up, SweptPrism(moved(base, {4, 0, 0}), moved(base, {4, 0, 2}))))
      << "an edge in common";
  EXPECT_FALSE(intersect(up, SweptPrism(moved(base, {2.1, 2.1, 0}), moved(base, {2.1, 2.1, 2}))))
      << "only the bounding boxes";
  EXPECT_TRUE(intersect(up, SweptPrism(moved(base, {1.9, 1.9, 1}), moved(base, {1.9, 1.9, 3}))));
  EXPECT_TRUE(intersect(up, up));
}

TEST(SweptPrism, CrossedEdgesArePartedAlongThem) {
  const Triangle needle{glm::dvec3(-1, 1, 0), {5, 1, 0}, {2, 1, 0.01}};
  for (const double height : {2.2, 1.9}) {
    const Triangle high = moved({glm::dvec3(1, -1, 0), {1, 5, 0}, {1, 2, 0.01}}, {0, 0, height});
    EXPECT_EQ(
        intersect(SweptPrism(needle, moved(needle, {0, 0.1, 2})), SweptPrism(high, moved(high, {0.1, 0, 1}))),
        height < 2);
  }
}

/// Against points: hulls that share a point far inside both intersect, and what is said not to intersect
/// shares none.
TEST(SweptPrism, AgreesWithPointsInBoth) {
  Random random(4);
  const Box room{{0, 0, 0}, {4, 4, 4}};
  int intersecting = 0, apart = 0;
  for (int round = 0; round < 400; ++round) {
    const auto prism = [&](const glm::dvec3& at) {
      Triangle before, after;
      for (int n = 0; n < 3; ++n)
        before[n] = at + glm::dvec3(random.point(room)), after[n] = at + glm::dvec3(random.point(room));
      return SweptPrism(before, after);
    };
    const auto inside = [&](const SweptPrism& p) {  // a random point of the hull
      glm::dvec3 point(0);
      double total = 0;
      for (const glm::dvec3& c : p.corner) {
        const double weight = random.real(0, 1);
        point += weight * c, total += weight;
      }
      return point / total;
    };
    const SweptPrism a = prism({0, 0, 0}), b = prism({random.real(0, 4), 0, 0});
    const bool answer = intersect(a, b);
    EXPECT_EQ(answer, intersect(b, a));
    // A prism moved so that a point of its inside is at a point of the other's.
    const glm::dvec3 by = inside(a) - inside(b);
    SweptPrism over = b;
    for (glm::dvec3& c : over.corner) c += by;
    over.lower += by, over.upper += by;
    EXPECT_TRUE(intersect(a, over));
    (answer ? intersecting : apart) += 1;
  }
  EXPECT_GT(intersecting, 40);
  EXPECT_GT(apart, 40);
}

}  // namespace
}  // namespace veduta
