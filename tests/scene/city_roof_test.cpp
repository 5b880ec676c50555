// Moved outlines, skeletons, gables and roofs, by hand-computed numbers.
#include "scene/city/roof.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "scene/city/gables.h"

namespace veduta::city {
namespace {

const Ring rectangle{{0, 0}, {20, 0}, {20, 12}, {0, 12}};
const Ring square{{0, 0}, {12, 0}, {12, 12}, {0, 12}};
const Ring l_shape{{0, 0}, {20, 0}, {20, 8}, {8, 8}, {8, 20}, {0, 20}};

TEST(CityRoof, OutwardsAndInwards) {
  const auto out = offset_ring(rectangle, {1, 1, 1, 1});
  EXPECT_EQ(out[0].before, glm::dvec2(-1, -1));
  EXPECT_EQ(out[0].before, out[0].after);
  EXPECT_EQ(offset_ring(rectangle, {-1, -1, -1, -1})[2].after, glm::dvec2(19, 11));
  EXPECT_TRUE(still_outlines({rectangle}, {out}));
  EXPECT_FALSE(still_outlines({rectangle}, {offset_ring(rectangle, std::vector<double>(4, -6.5))}));
}

// An edge that does not move ends where the moved one comes to its line.
TEST(CityRoof, OneEdgeMoves) {
  const auto corners = offset_ring(rectangle, {2, 0, 0, 0});
  EXPECT_EQ(corners[0].after, glm::dvec2(0, -2));
  EXPECT_EQ(corners[1].before, glm::dvec2(20, -2));
  EXPECT_EQ(corners[2].before, glm::dvec2(20, 12));
}

TEST(CityRoof, StraightOnWithAStep) {
  const Ring ring{{0, 0}, {5, 0}, {10, 0}, {10, 5}, {0, 5}};
  const auto corners = offset_ring(ring, {1, 0, 0, 0, 0});
  EXPECT_EQ(corners[1].before, glm::dvec2(5, -1));
  EXPECT_EQ(corners[1].after, glm::dvec2(5, 0));
  EXPECT_FALSE(still_outlines({ring}, {corners}));
}

TEST(CityRoof, SharpCornersAreCut) {
  const auto corners = offset_ring({{0, 0}, {20, 0}, {0, 2}}, {1, 1, 1});
  EXPECT_NE(corners[1].before, corners[1].after);
  EXPECT_NEAR(glm::length(corners[1].before - glm::dvec2(20, 0)), 1, 1e-12);
}

TEST(CityRoof, SkeletonOfARectangle) {
  const auto faces = straight_skeleton({rectangle});
  ASSERT_EQ(faces.size(), 4u);
  for (const SkeletonFace& face : faces) {
    EXPECT_EQ(face.points.size(), face.edge % 2 == 0 ? 4u : 3u);
    EXPECT_EQ(glm::dvec2(face.points[0]), rectangle[face.edge]);
    EXPECT_EQ(glm::dvec2(face.points[1]), rectangle[(face.edge + 1) % 4]);
    for (size_t i = 2; i < face.points.size(); ++i) {
      EXPECT_NEAR(face.points[i].z, 6, 1e-12);
      EXPECT_NEAR(face.points[i].y, 6, 1e-12);
    }
  }
}

TEST(CityRoof, SkeletonOfWhatIsNone) {
  EXPECT_TRUE(straight_skeleton({{{0, 0}, {10, 10}, {10, 0}, {0, 10}}}).empty());  // a bow tie
}

TEST(CityRoof, GablesOfARectangle) {
  auto faces = straight_skeleton({rectangle});
  const auto raised = raise_gables(faces, {rectangle}, {});
  EXPECT_EQ(raised[0], (std::vector<bool>{false, true, false, true}));
  for (const SkeletonFace& face : faces) {
    if (face.points.size() > 3) continue;
    const glm::dvec3 top(face.edge == 1 ? 20 : 0, 6, 6);
    EXPECT_NEAR(glm::length(face.points[2] - top), 0, 1e-12);
  }
}

TEST(CityRoof, GablesOfAnL) {
  auto faces = straight_skeleton({l_shape});
  const auto raised = raise_gables(faces, {l_shape}, {});
  EXPECT_EQ(raised[0], (std::vector<bool>{false, true, false, false, true, false}));
  auto others = straight_skeleton({l_shape});
  const auto one = raise_gables(others, {l_shape}, {{false, true, false, false, false, false}});
  EXPECT_EQ(std::count(one[0].begin(), one[0].end(), true), 1);
}

// The roofs' height, and where their ridge runs.
class Roofs : public testing::Test {
 protected:
  Mesh mesh(const Ring& ring, const std::vector<bool>& blind) {
    Mesh mesh;
    builder_.begin(mesh, layers_);
    rules_.roof.layer = 1;
    add_roof(builder_, rules_, {ring}, {blind}, 10);
    return mesh;
  }
  static double highest(const Mesh& mesh) {
    double z = 0;
    for (const glm::dvec3& p : mesh.vertices) z = std::max(z, p.z);
    return z;
  }
  static bool has(const Mesh& mesh, const glm::dvec3& wanted) {
    return std::any_of(mesh.vertices.begin(), mesh.vertices.end(),
                       [&](const glm::dvec3& p) { return glm::length(p - wanted) < 1e-9; });
  }
  const std::vector<bool> free_ = std::vector<bool>(4, false);
  RuleSet rules_;
  MeshBuilder builder_;
  const std::vector<uint16_t> layers_{0, 1};
};

TEST_F(Roofs, Gabled) {
  rules_.roof.type = Roof::Type::gabled;
  rules_.roof.pitch_deg = 45;
  const Mesh gabled = mesh(rectangle, free_);
  EXPECT_TRUE(has(gabled, {0, 6, 16}) && has(gabled, {20, 6, 16}));
  EXPECT_EQ(gabled.triangle_count(), 6u);
  // Neighbours at the long sides: the ridge runs between them.
  const Mesh turned = mesh(rectangle, {true, false, true, false});
  EXPECT_TRUE(has(turned, {10, 0, 20}) && has(turned, {10, 12, 20}));
  EXPECT_TRUE(has(mesh(square, free_), {6, 0, 16}) || has(mesh(square, free_), {0, 6, 16}));
}

TEST_F(Roofs, Hipped) {
  rules_.roof.type = Roof::Type::hipped;
  rules_.roof.pitch_deg = 45;
  EXPECT_TRUE(has(mesh(rectangle, free_), {6, 6, 16}) && has(mesh(rectangle, free_), {14, 6, 16}));
  rules_.roof.overhang_m = 1;
  const Mesh wide = mesh(rectangle, free_);
  EXPECT_TRUE(has(wide, {-1, -1, 10}) && has(wide, {6, 6, 17}));
}

TEST_F(Roofs, Mansard) {
  rules_.roof.type = Roof::Type::mansard;
  rules_.roof.pitch_deg = 45;
  rules_.roof.height_m = 2;
  rules_.roof.upper_pitch_deg = 0;
  const Mesh mansard = mesh(rectangle, free_);
  EXPECT_DOUBLE_EQ(highest(mansard), 12);
  EXPECT_TRUE(has(mansard, {2, 2, 12}) && has(mansard, {18, 10, 12}));
}

TEST_F(Roofs, FlatWithParapet) {
  rules_.roof.parapet_m = 1;
  rules_.roof.thickness_m = 0.5;
  const Mesh parapet = mesh(rectangle, free_);
  EXPECT_TRUE(has(parapet, {0.5, 0.5, 10}) && has(parapet, {0.5, 0.5, 11}) && has(parapet, {0, 0, 11}));
  rules_.roof.thickness_m = 6;  // wider than the building: none
  EXPECT_EQ(highest(mesh(rectangle, free_)), 10);
}

}  // namespace
}  // namespace veduta::city
