// Faces that meet share their edges, in toys and in every building.
#include "scene/city/close_edges.h"

#include <filesystem>
#include <glm/geometric.hpp>
#include <set>

#include "city_files.h"
#include "edge_balance.h"
#include "scene/city/derive.h"

namespace veduta::city {
namespace {

using Corners = std::array<uint32_t, 4>;

std::vector<Corners> corners_of(const Mesh& mesh) {
  std::vector<Corners> corners;
  for (const Face& face : mesh.faces) corners.push_back(face.corner);
  return corners;
}

Mesh closed(Mesh mesh) {
  EdgeCloser().close(mesh);
  return mesh;
}

glm::dvec3 area_of(const Mesh& mesh) {
  glm::dvec3 area(0);
  for (const Face& face : mesh.faces) {
    const auto& at = mesh.vertices;
    area +=
        0.5 * glm::cross(at[face.corner[2]] - at[face.corner[0]], at[face.corner[3]] - at[face.corner[1]]);
  }
  return area;
}

double least_area(const Mesh& mesh) {
  double least = 1e300;
  for (const Face& face : mesh.faces) {
    const auto& at = mesh.vertices;
    least = std::min(least, 0.5 * glm::length(glm::cross(at[face.corner[2]] - at[face.corner[0]],
                                                         at[face.corner[3]] - at[face.corner[1]])));
  }
  return least;
}

// A wall of 4 m beside two of 2 m: the corner of the two lies on its vertical edge.
TEST(CloseEdges, AVerticalEdge) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {3, 0, 0}, {3, 0, 4}, {0, 0, 4}, {6, 0, 0}, {6, 0, 2}, {3, 0, 2}, {6, 0, 4}};
  mesh.faces = {{{0, 1, 2, 3}, 7}, {{1, 4, 5, 6}, 1}, {{6, 5, 7, 2}, 2}};
  const Mesh after = closed(mesh);
  EXPECT_EQ(corners_of(after),
            (std::vector<Corners>{{1, 6, 0, 0}, {6, 2, 3, 0}, {1, 4, 5, 6}, {6, 5, 7, 2}}));
  EXPECT_EQ(after.vertices, mesh.vertices);
  EXPECT_EQ(after.faces[1].layer, 7);
  EXPECT_EQ(area_of(after), area_of(mesh));
}

TEST(CloseEdges, AHorizontalEdgeAndATriangle) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {4, 0, 0}, {2, 0, 5}, {0, 0, -1}, {1, 0, -1}, {1, 0, 0}, {4, 0, -1}};
  mesh.faces = {{{0, 1, 2, 2}, 0}, {{3, 4, 5, 0}, 0}, {{4, 6, 1, 5}, 0}};
  EXPECT_EQ(corners_of(closed(mesh)),
            (std::vector<Corners>{{0, 5, 2, 2}, {5, 1, 2, 2}, {3, 4, 5, 0}, {4, 6, 1, 5}}));
}

// Off the axes, where the middle of an edge is on it only as far as doubles go.
TEST(CloseEdges, ASlantedEdge) {
  const glm::dvec3 a(0.1, 0.2, 0.3), b(7.7, -3.1, 2.9), third = a + (b - a) / 3.0;
  Mesh mesh;
  mesh.vertices = {a, b, a + glm::dvec3(1, 5, 1), third, {2, -6, -3}};
  mesh.faces = {{{0, 1, 2, 2}, 0}, {{3, 0, 4, 4}, 0}, {{1, 3, 4, 4}, 0}};
  EXPECT_EQ(corners_of(closed(mesh)),
            (std::vector<Corners>{{0, 3, 2, 2}, {3, 1, 2, 2}, {3, 0, 4, 4}, {1, 3, 4, 4}}));
}

// Points across from one another make quads: no more triangles than one for each point.
TEST(CloseEdges, PointsOnTwoSides) {
  Mesh mesh;
  for (const double z : {0, 1, 2, 3})
    for (const double x : {0, 1, 2}) mesh.vertices.emplace_back(x, 0, z);
  mesh.faces = {
      {{0, 1, 4, 3}, 0}, {{1, 2, 5, 4}, 0}, {{3, 5, 8, 6}, 0}, {{6, 7, 10, 9}, 0}, {{7, 8, 11, 10}, 0}};
  EXPECT_EQ(corners_of(closed(mesh)),
            (std::vector<Corners>{
                {0, 1, 4, 3}, {1, 2, 5, 4}, {3, 4, 7, 6}, {4, 5, 8, 7}, {6, 7, 10, 9}, {7, 8, 11, 10}}));
}

// An edge that its faces share stays whole, whatever touches it.
TEST(CloseEdges, SharedEdgesStay) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0},  {4, 0, 0},  {4, 4, 0},  {0, 4, 0}, {2, 0, 0},
                   {4, 0, -4}, {0, 0, -4}, {1, -1, 0}, {3, -1, 0}};
  mesh.faces = {{{0, 1, 2, 3}, 0}, {{1, 0, 6, 5}, 0}, {{4, 7, 8, 8}, 0}, {{4, 8, 7, 7}, 0}};
  EXPECT_EQ(corners_of(closed(mesh)), corners_of(mesh));
}

// Two vertices a rounding apart are one, and a face between them goes.
TEST(CloseEdges, VerticesARoundingApart) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}, {1, 0, 1 + 1e-12}, {2, 0, 1}, {2, 0, 0}};
  mesh.faces = {{{0, 1, 2, 3}, 0}, {{1, 6, 5, 4}, 0}, {{2, 5, 4, 4}, 0}};
  const Mesh after = closed(mesh);
  EXPECT_EQ(after.vertices.size(), 6u);
  EXPECT_EQ(corners_of(after), (std::vector<Corners>{{0, 1, 2, 3}, {1, 5, 4, 2}}));
}

// A sliver whose third corner is on the opposite side, between faces that leave no room for it.
TEST(CloseEdges, AFaceWithoutArea) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {4, 0, 0}, {2, 0, 1e-9}, {2, 0, 3}, {2, 0, -3}};
  mesh.faces = {
      {{0, 1, 2, 2}, 0}, {{0, 2, 3, 3}, 0}, {{2, 1, 3, 3}, 0}, {{2, 0, 4, 4}, 0}, {{1, 2, 4, 4}, 0}};
  EXPECT_EQ(corners_of(closed(mesh)),
            (std::vector<Corners>{{0, 2, 3, 3}, {2, 1, 3, 3}, {2, 0, 4, 4}, {1, 2, 4, 4}}));
}

using Rings = std::vector<std::vector<glm::dvec2>>;

struct Case {
  const char* name;
  Rings rings;
  std::vector<std::vector<double>> blind_m;
};

const std::vector<Case> cases = {
    {"rectangle", {{{-10, -7}, {10, -7}, {10, 7}, {-10, 7}}}, {}},
    {"turned", {{{0, -8}, {19.3, 4.7}, {11, 17}, {-8.2, 4.4}}}, {}},
    {"L with a courtyard",
     {{{0, 0}, {44, 0}, {44, 30}, {26, 30}, {26, 44}, {0, 44}}, {{12, 11}, {12, 20}, {24, 21}, {25, 10}}},
     {}},
    {"slanted", {{{0, 0}, {13, -2.3}, {20.1, 5}, {17, 14.7}, {8, 11}, {-1, 16.4}, {-4, 6}}}, {}},
    {"party walls", {{{0.5, 0.25}, {20, 3}, {18.5, 16}, {-1, 14}}}, {{0, 9.5, 0, 30}}},
    {"straight on", {{{0, 0}, {6.5, 1}, {13, 2}, {11, 15}, {4.5, 14}, {-2, 13}}}, {{0, 7}}},
    {"short edges",
     {{{0, 0}, {18, 0}, {18.3, 0.2}, {20, 2}, {20, 15}, {12, 15.001}, {11.99, 15}, {0, 15}}},
     {}},
};

class CloseEdgesOfStyles : public CityFiles {};

// Every style that comes with the program on every outline: closed edge by edge, each face with area, and no
// vertex too many.
TEST_F(CloseEdgesOfStyles, BuildingsAreClosedEdgeByEdge) {
  const std::filesystem::path folder = std::filesystem::path(VEDUTA_TEST_DATA) / "../../configs/city/rules";
  int styles = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const RuleSet rules = load_rules(entry.path());
    ++styles;
    for (const Case& outline : cases)
      for (const int floors : {2, 5}) {
        BuildingPlan plan;
        plan.rings = outline.rings;
        plan.blind_m = outline.blind_m;
        plan.floors = floors;
        plan.seed = 3;
        const Mesh mesh = derive_building(plan, rules);
        const EdgeBalance balance = edge_balance(mesh);
        EXPECT_EQ(balance.open, 0) << rules.name << ", " << outline.name << ": " << balance.first;
        EXPECT_GT(least_area(mesh), 1e-9) << rules.name << ", " << outline.name;
        EXPECT_LT(glm::length(area_of(mesh)), 1e-6) << rules.name << ", " << outline.name;
        std::set<uint32_t> used;
        for (const Face& face : mesh.faces) used.insert(face.corner.begin(), face.corner.end());
        EXPECT_EQ(used.size(), mesh.vertices.size()) << rules.name << ", " << outline.name;
        const Mesh again = closed(mesh);
        EXPECT_EQ(corners_of(again), corners_of(mesh)) << "a second pass finds nothing to do";
      }
  }
  EXPECT_GE(styles, 7);
}

}  // namespace
}  // namespace veduta::city
