#include "worker/horizon.h"

#include <gtest/gtest.h>

#include "tests/worker/convex_bodies.h"

namespace veduta {
namespace {

using test::Faces;
using test::Random;

constexpr int columns = 512;

/// right / forward in a column, 0 and 1 on its edges.
double ratio(int column, double across) {
  return 2 * (column + across) / columns - 1;
}

/// The slope of a column.
float slope(const Horizon& horizon, int column) {
  const auto right = static_cast<float>(10 * ratio(column, 0.5));
  return horizon.hidden_below({{right, 0, 10}, {right, 0, 10}}, 10);
}

/// The faces of a body in face coordinates that face the eye, which is the origin.
void add(Horizon& horizon, const Faces& faces, float depth_limit_m = 1000) {
  for (const auto& face : faces) {
    const glm::dvec3 a(face[0]), b(face[1]), c(face[2]);
    if (glm::dot(glm::cross(b - a, c - a), a) >= 0) continue;
    for (size_t n = 0; n < face.size(); ++n)
      horizon.add_edge(face[n], face[(n + 1) % face.size()], depth_limit_m);
  }
  horizon.end_body();
}

/// A body whose middle is `right` beside and `forward` before the eye.
Faces body_at(Random& random, float right, float forward) {
  Faces faces =
      test::random_body(random, glm::vec3(random.real(0.5, 5), random.real(0.5, 5), random.real(0.5, 8)));
  for (auto& face : faces) {
    for (glm::vec3& p : face) p = glm::vec3(right, 0, forward) + glm::vec3(p.y, p.z, p.x);
  }
  return faces;
}

/// Does the ray (right, up, 1) from the eye pass through the inside of the body?
bool meets(const Faces& faces, double right, double up) {
  double enter = 1e-3, leave = 1e9;
  for (const auto& face : faces) {
    const glm::dvec3 a(face[0]), b(face[1]), c(face[2]);
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double towards = glm::dot(normal, {right, up, 1}), at = glm::dot(normal, a);
    if (towards < 0) enter = std::max(enter, at / towards);
    if (towards > 0) leave = std::min(leave, at / towards);
    if (towards == 0 && at <= 0) return false;
  }
  return enter < leave;
}

/// The range of up / forward that a body before the eye covers at right / forward; empty beside it.
std::pair<double, double> covered(const Faces& faces, double right) {
  std::pair<double, double> range{1e30, -1e30};
  for (const auto& face : faces) {
    for (size_t n = 0; n < face.size(); ++n) {
      const glm::dvec3 a(face[n]), b(face[(n + 1) % face.size()]);
      const double left_of_a = right * a.z - a.x, left_of_b = right * b.z - b.x;
      if (left_of_a * left_of_b > 0 || left_of_a == left_of_b) continue;
      const glm::dvec3 p = a + (b - a) * (left_of_a / (left_of_a - left_of_b));
      range.first = std::min(range.first, p.y / p.z), range.second = std::max(range.second, p.y / p.z);
    }
  }
  return range;
}

TEST(Horizon, RaisesColumnsAsHighAsAConvexBodyFillsThem) {
  Random random(1);
  int raised = 0;
  for (int round = 0; round < 300; ++round) {
    const auto forward = static_cast<float>(random.real(12, 60));
    const Faces faces = body_at(random, static_cast<float>(random.real(-1, 1)) * forward, forward);
    Horizon horizon;
    add(horizon, faces);
    for (int c = 0; c < columns; ++c) {
      const double got = slope(horizon, c);
      const auto [bottom0, top0] = covered(faces, ratio(c, 0));
      const auto [bottom1, top1] = covered(faces, ratio(c, 1));
      if (got < -1e29) {
        EXPECT_TRUE(bottom0 > top0 - 1e-4 || bottom1 > top1 - 1e-4 || std::max(bottom0, bottom1) > -1e-4)
            << "round " << round << ", column " << c << " is filled from edge to edge";
        continue;
      }
      ++raised;
      ASSERT_NEAR(got, std::min(top0, top1), 1e-4) << "round " << round << ", column " << c;
      for (const double across : {0.2, 0.5, 0.8})
        ASSERT_LT(got, covered(faces, ratio(c, across)).second + 1e-4);
    }
  }
  EXPECT_GT(raised, 3000);
}

TEST(Horizon, WhatEndsBeforeTheEyesHeightOrFloatsHidesNothing) {
  Faces low{{{-2, 1, 10}, {-2, 5, 10}, {2, 5, 10}, {2, 1, 10}}};
  Horizon horizon;
  add(horizon, low);
  EXPECT_LT(slope(horizon, columns / 2), -1e29) << "from 1 m above the eye on";
  for (glm::vec3& corner : low[0]) corner.y -= 2;
  add(horizon, low);
  EXPECT_NEAR(slope(horizon, columns / 2), 0.3, 1e-4);
  EXPECT_LT(slope(horizon, columns / 8), -1e29) << "beside it";
  add(horizon, {{{-2, -1, 5}, {-2, 0.5f, 5}, {2, 0.5f, 5}, {2, -1, 5}}});
  EXPECT_NEAR(slope(horizon, columns / 2), 0.3, 1e-4) << "a lower one leaves it as it is";
}

TEST(Horizon, CountsWhatIsDrawnAlone) {
  // A wall from left to right that goes away from the eye.
  const Faces wall{{{-8, -1, 10}, {-8, 4, 10}, {16, 4, 40}, {16, -1, 40}}};
  Horizon all, near;
  add(all, wall);
  add(near, wall, 20);  // up to right = 0
  EXPECT_NEAR(slope(all, columns * 3 / 8), slope(near, columns * 3 / 8), 1e-4);
  EXPECT_GT(slope(near, columns * 3 / 8), 0);
  EXPECT_GT(slope(all, columns * 5 / 8), 0);
  EXPECT_LT(slope(near, columns * 5 / 8), -1e29);
}

TEST(Horizon, BodiesAroundTheEyeAndBehindItAreNoTrouble) {
  Random random(2);
  for (int round = 0; round < 200; ++round) {
    const Faces faces =
        body_at(random, static_cast<float>(random.real(-3, 3)), static_cast<float>(random.real(-40, 4)));
    Horizon horizon;
    add(horizon, faces);
    for (int c = 0; c < columns; ++c) {
      const double top = slope(horizon, c);
      ASSERT_FALSE(std::isnan(top));
      if (top < -1e29) continue;
      ASSERT_TRUE(meets(faces, ratio(c, 0.5), top - 1e-3 * (1 + std::abs(top))));
    }
  }
}

}  // namespace
}  // namespace veduta
