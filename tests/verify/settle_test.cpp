#include "verify/settle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "scene/random.h"

namespace veduta {
namespace {

// Triangles as given, each its own object's worth; all are candidates.
struct Soup {
  Scene scene;
  std::vector<uint8_t> drawn;
  void add(bool is_drawn, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const auto base = static_cast<uint32_t>(scene.vertices.size());
    scene.vertices.insert(scene.vertices.end(), {a, b, c});
    scene.triangles.emplace_back(base, base + 1, base + 2);
    drawn.push_back(is_drawn);
  }
  // Across the x axis at this x, triangle (0,-1)..(0,1) by (1,0) in y and z, around the axis.
  void add_across(bool is_drawn, float x) { add(is_drawn, {x, -1, -1}, {x, 1, -1}, {x, 0, 1}); }
  std::optional<uint32_t> first(const glm::vec3& eye, const glm::vec3& direction) const {
    std::vector<uint32_t> all(scene.triangles.size());
    std::iota(all.begin(), all.end(), 0);
    return undrawn_met_first(scene, eye, direction, all, drawn);
  }
};

constexpr glm::vec3 along_x{1, 0, 0};

TEST(Settle, NamesTheUndrawnTriangleInFront) {
  Soup soup;
  soup.add_across(true, 5), soup.add_across(false, 4), soup.add_across(false, 3);
  EXPECT_EQ(soup.first({}, along_x), 2u);
}

TEST(Settle, DrawnTriangleInFrontClears) {
  Soup soup;
  soup.add_across(false, 5), soup.add_across(true, 4);
  EXPECT_EQ(soup.first({}, along_x), std::nullopt);
}

TEST(Settle, OneUnitInTheLastPlaceDecides) {
  Soup soup;
  soup.add_across(true, 5), soup.add_across(false, std::nextafter(5.0f, 0.0f));
  EXPECT_EQ(soup.first({}, along_x), 1u);
  soup.drawn = {0, 1};
  EXPECT_EQ(soup.first({}, along_x), std::nullopt);
}

// The same tilted plane cut into different triangles: in floating point their distances differ in the last
// places, and either could come first.
TEST(Settle, CoplanarTrianglesAreMetAtOneDistance) {
  Soup soup;
  const glm::vec3 a{7, -11, -5}, u{-1, 30, 3}, v{5, 2, 29};
  soup.add(false, a, a + u, a + v);
  soup.add(true, a - u - v, a + 3.0f * u - v, a - u + 3.0f * v);
  Random random(3);
  int met = 0;
  for (int i = 0; i < 2000; ++i) {
    const float s = random.unit(), t = random.unit() * (1 - s);
    const glm::vec3 eye{-random.unit(), random.unit(), random.unit()};
    const glm::vec3 direction = a + s * u + t * v - eye;
    EXPECT_EQ(soup.first(eye, direction), std::nullopt);
    soup.drawn = {0, 0};
    met += soup.first(eye, direction).has_value();
    soup.drawn = {0, 1};
  }
  EXPECT_EQ(met, 2000);
}

TEST(Settle, EdgesAndCornersBelongToTheTriangle) {
  Soup soup;
  soup.add(true, {5, 0, 0}, {5, 1, 0}, {5, 0, 1}), soup.add_across(false, 6);
  EXPECT_EQ(soup.first({0, 0, 0}, along_x), std::nullopt) << "through a corner of the drawn one";
  EXPECT_EQ(soup.first({0, 0.25f, 0}, along_x), std::nullopt) << "through an edge";
  EXPECT_EQ(soup.first({0, 0.25f, -1e-30f}, along_x), 1u)
      << "past the edge by less than any double beside 0.25 shows";
}

// A ray into the seam of two drawn triangles never slips through.
TEST(Settle, NoRaySlipsThroughASharedEdge) {
  Soup soup;
  const glm::vec3 p{5.1f, -1.3f, -0.7f}, q{6.3f, 1.1f, 0.9f};
  soup.add(true, p, q, {5, 3, -2}), soup.add(true, q, p, {6, -2, 3}),
      soup.add(false, {9, -90, -90}, {9, 90, -90}, {9, 0, 90});
  Random random(4);
  for (int i = 0; i < 2000; ++i) {
    const glm::vec3 target = p + random.unit() * (q - p);
    EXPECT_EQ(soup.first({}, target), std::nullopt);
  }
}

TEST(Settle, WhatIsBehindTheEyeAtTheEyeOrEdgeOnIsNotMet) {
  Soup soup;
  soup.add_across(false, -1), soup.add_across(false, 0), soup.add(false, {1, -1, 0}, {2, 1, 0}, {3, -1, 0});
  EXPECT_EQ(soup.first({}, along_x), std::nullopt);
}

TEST(Settle, NothingMetIsNothing) {
  Soup soup;
  soup.add_across(false, 3);
  EXPECT_EQ(soup.first({}, {0, 1, 0}), std::nullopt);
  EXPECT_EQ(undrawn_met_first(soup.scene, {}, along_x, {}, soup.drawn), std::nullopt);
}

}  // namespace
}  // namespace veduta
