// Zoomed views: how large the box is in the picture, and what fattening it promises.
#include "worker/zoom_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/worker/mesh.h"
#include "worker/cube_face.h"

namespace veduta {
namespace {

using test::Random;

/// Box with edges from 0 (now and then) to 30 m, somewhere around the eye.
Box random_box(Random& random) {
  const glm::vec3 lower = random.point({{-300, -300, -40}, {300, 300, 60}});
  const auto edge = [&] {
    return random.chance(0.2) ? 0.0f : static_cast<float>(std::pow(10, random.real(-2, 1.5)));
  };
  return {lower, lower + glm::vec3(edge(), edge(), edge())};
}

glm::dvec3 in_view(const ZoomView& view, const glm::dvec3& p) {
  return glm::dmat3(view.view_from_world) * (p - glm::dvec3(view.eye));
}

/// Where it is in the picture, in pixels.
glm::dvec2 place(const ZoomView& view, const glm::dvec3& p) {
  const glm::dvec3 v = in_view(view, p);
  return (glm::dvec2(v) / v.z - glm::dvec2(view.lower)) / glm::dvec2(view.upper - view.lower) *
         glm::dvec2(view.width, view.height);
}

TEST(ZoomView, TheBoxIsAsLargeAsThePictureCanHold) {
  Random random(1);
  int zoomed = 0, small = 0;
  for (int n = 0; n < 3000; ++n) {
    const Box box = random_box(random);
    const glm::vec3 eye = random.point({{-5, -5, 1}, {5, 5, 2}});
    const std::optional<ZoomView> view = zoom_onto(box, eye);
    if (!view) continue;
    ++zoomed;
    glm::dvec2 least(1e30), most(-1e30);
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec2 p =
          place(*view, {corner & 1 ? box.upper.x : box.lower.x, corner & 2 ? box.upper.y : box.lower.y,
                        corner & 4 ? box.upper.z : box.lower.z});
      least = glm::min(least, p), most = glm::max(most, p);
    }
    const glm::dvec2 extent = most - least;
    ASSERT_GE(std::min(least.x, least.y), 1.5);
    ASSERT_LE(most.x, view->width - 1.5);
    ASSERT_LE(most.y, view->height - 1.5);
    ASSERT_LE(view->width, 1024);
    ASSERT_LE(view->height, 768);
    const bool finest = view->pixel_m(1) < 1.1e-6f;  // of what is next to a point
    ASSERT_TRUE(extent.x > 1015 || extent.y > 760 || finest) << extent.x << " " << extent.y;
    small += finest;
  }
  EXPECT_GT(zoomed, 2800);
  EXPECT_LT(small, zoomed / 4);
}

TEST(ZoomView, ThePictureIsNotMirrored) {
  for (const glm::dvec3& forward : {glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0),
                                    glm::dvec3(0, -1, 0), glm::dvec3(0, 0, 1)}) {
    const glm::dvec3 up = forward.z == 0 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0),
                     right = glm::cross(forward, up);
    const glm::vec3 middle(10.0 * forward);
    std::vector<ZoomView> views{*zoom_onto({middle - 1.0f, middle + 1.0f}, glm::vec3(0))};
    for (int face = 0; face < face_count; ++face) {
      if (section(face, glm::vec3(0)).depths_m({middle, middle}).x > 9)
        views.push_back(section(face, glm::vec3(0)));
    }
    ASSERT_EQ(views.size(), 2u);
    for (const ZoomView& view : views) {
      const glm::dvec2 a = place(view, 10.0 * forward), b = place(view, 10.0 * forward + 0.5 * right),
                       c = place(view, 10.0 * forward + 0.5 * up);
      EXPECT_GT((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x), 0);
    }
  }
}

TEST(ZoomView, NoneForABoxAroundOrBesideTheEye) {
  EXPECT_FALSE(zoom_onto({{-1, -1, -1}, {1, 1, 1}}, {0, 0, 0}));
  EXPECT_FALSE(zoom_onto({{-1, -1, -1}, {1, 1, 1}}, {0.3f, 0, 0}));
  EXPECT_FALSE(zoom_onto({{0.1f, -50, -1}, {2, 50, 1}}, {0, 0, 0})) << "a long wall beside the eye";
  EXPECT_FALSE(zoom_onto({{0, 0, 0}, {0, 0, 0}}, {0, 0, 0}));
  EXPECT_TRUE(zoom_onto({{5, -20, -1}, {12, 20, 9}}, {0, 0, 0})) << "a row of houses across the street";
  EXPECT_TRUE(zoom_onto({{-1, -1, 20}, {1, 1, 21}}, {0, 0, 0})) << "straight above";
  EXPECT_TRUE(zoom_onto({{3, 4, 5}, {3, 4, 5}}, {0, 0, 0})) << "a point";
}

/// Planar depths between which the ray through the middle of a pixel is in a box; false where it misses.
bool crosses(const ZoomView& view, const glm::dvec2& pixel, const Box& box, double& first_m) {
  const glm::dvec2 tangents = glm::dvec2(view.lower) + pixel / glm::dvec2(view.width, view.height) *
                                                           glm::dvec2(view.upper - view.lower);
  const glm::dvec3 direction =
      glm::transpose(glm::dmat3(view.view_from_world)) * glm::dvec3(tangents, 1.0);  // of planar depth 1
  double last_m = 1e30;
  first_m = 0;
  for (int axis = 0; axis < 3; ++axis) {
    double a = (box.lower[axis] - double{view.eye[axis]}) / direction[axis],
           b = (box.upper[axis] - double{view.eye[axis]}) / direction[axis];
    if (a > b) std::swap(a, b);
    first_m = std::max(first_m, a), last_m = std::min(last_m, b);
  }
  return first_m <= last_m;
}

/// Every point of the box falls into a pixel whose middle the fattened box takes, no farther away.
void expect_taken(const ZoomView& view, const Box& box, Random& random) {
  const Box fat = view.fattened(box);
  for (int n = 0; n < 20; ++n) {
    const glm::dvec3 p = random.point(box);
    if (in_view(view, p).z < ZoomView::near_m) continue;
    const glm::dvec2 pixel = glm::floor(place(view, p)) + 0.5;
    double depth_m = 0;
    ASSERT_TRUE(crosses(view, pixel, fat, depth_m));
    ASSERT_LE(depth_m, in_view(view, p).z);
  }
}

TEST(ZoomView, AFattenedBoxTakesEveryPixelThatTheBoxTouches) {
  Random random(2);
  for (int n = 0; n < 2000; ++n) {
    const Box box = random_box(random);
    const glm::vec3 eye = random.point({{-5, -5, 1}, {5, 5, 2}});
    if (const std::optional<ZoomView> view = zoom_onto(box, eye)) {
      expect_taken(*view, box, random);
      // A slice of it.
      const glm::vec3 a = random.point(box), b = random.point(box);
      expect_taken(*view, {glm::min(a, b), glm::max(a, b)}, random);
    }
    expect_taken(section(random.integer(0, face_count - 1), eye), box, random);
    if (HasFatalFailure()) return;
  }
}

TEST(ZoomView, FrustumsLeaveNothingOut) {
  Random random(3);
  int reached = 0, missed = 0;
  for (int n = 0; n < 5000; ++n) {
    const glm::vec3 eye = random.point({{-5, -5, 1}, {5, 5, 2}});
    const Box occludee = random_box(random), occluder = random_box(random);
    const std::optional<ZoomView> view =
        random.chance(0.5) ? zoom_onto(occludee, eye) : section(random.integer(0, 4), eye);
    if (!view) continue;
    const auto limit_m = static_cast<float>(random.real(5, 300));
    const bool said = ZoomFrustum(*view, limit_m).reached_by(occluder);
    (said ? reached : missed) += 1;
    for (int k = 0; k < 20 && !said; ++k) {
      const glm::dvec3 p = random.point(occluder);
      const glm::dvec2 pixel = place(*view, p);
      const double depth_m = in_view(*view, p).z;
      ASSERT_FALSE(depth_m > ZoomView::near_m && depth_m < limit_m && pixel.x > 0 && pixel.y > 0 &&
                   pixel.x < view->width && pixel.y < view->height);
    }
  }
  EXPECT_GT(reached, 100);
  EXPECT_GT(missed, 2000);
}

}  // namespace
}  // namespace veduta
