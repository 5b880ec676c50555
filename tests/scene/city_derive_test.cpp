// Derived buildings: closed, the right way round, the same every time.
#include "scene/city/derive.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <cmath>
#include <map>
#include <set>

#include "city_files.h"
#include "closed_mesh.h"
#include "edge_balance.h"

namespace veduta::city {
namespace {

using Rings = std::vector<std::vector<glm::dvec2>>;

const std::map<std::string, Rings> outlines = {
    {"rectangle", {{{-10, -6}, {10, -6}, {10, 6}, {-10, 6}}}},
    {"square", {{{-6, -6}, {6, -6}, {6, 6}, {-6, 6}}}},
    {"turned", {{{0, -8}, {9, 1}, {2, 8}, {-7, -1}}}},
    {"triangle", {{{0, 0}, {18, 0}, {5, 14}}}},
    {"L", {{{0, 0}, {22, 0}, {22, 10}, {9, 10}, {9, 24}, {0, 24}}}},
    {"T", {{{0, 0}, {24, 0}, {24, 8}, {16, 8}, {16, 20}, {7, 20}, {7, 8}, {0, 8}}}},
    {"U", {{{0, 0}, {30, 0}, {30, 25}, {20, 25}, {20, 10}, {10, 10}, {10, 25}, {0, 25}}}},
    {"courtyard", {{{0, 0}, {40, 0}, {40, 30}, {0, 30}}, {{12, 10}, {12, 20}, {28, 20}, {28, 10}}}},
    {"irregular", {{{0, 0}, {13, -2}, {20, 5}, {17, 14}, {8, 11}, {-1, 16}, {-4, 6}}}},
    {"short edges", {{{0, 0}, {18, 0}, {18.3, 0.2}, {20, 2}, {20, 15}, {12, 15.001}, {11.99, 15}, {0, 15}}}},
    {"thin", {{{0, 0}, {20, 0}, {20, 0.4}, {0, 0.4}}}},
    {"straight on", {{{0, 0}, {6, 0}, {12, 0}, {12, 8}, {6, 8}, {0, 8}}}},
};

BuildingPlan plan(const Rings& rings, int floors = 4, uint64_t seed = 1) {
  BuildingPlan plan;
  plan.rings = rings;
  plan.floors = floors;
  plan.seed = seed;
  return plan;
}

class CityDerive : public CityFiles {
 protected:
  const std::string windows_ = figure_terminals + R"(
    <Floor><F><Random minWidth="2"><Face/></Random></F></Floor>
    <Face><W><Fixed><xProportions x1="1" x2="1m" x3="1"/><yProportions y1="1m" y2="1m" y3="1"/><Elements>
      <Wall/><Wall/><Wall/><Wall/><Window/><Wall/><Wall/><Wall/><Wall/></Elements></Fixed></W></Face>)";
};

double area_m2(const Mesh& mesh) {
  double area = 0;
  for (const Face& face : mesh.faces) {
    const glm::dvec3 &a = mesh.vertices[face.corner[0]], &b = mesh.vertices[face.corner[1]],
                     &c = mesh.vertices[face.corner[2]], &d = mesh.vertices[face.corner[3]];
    area += 0.5 * glm::length(glm::cross(c - a, d - b));
  }
  return area;
}

TEST_F(CityDerive, BoxOfPlainWalls) {
  const RuleSet rules = load("<Floor><F><Wall/></F></Floor>");
  const Mesh mesh = derive_building(plan(outlines.at("rectangle"), 2), rules);
  EXPECT_EQ(mesh.vertices.size(), 12u);
  EXPECT_EQ(mesh.triangle_count(), 2u * (4 * 2 + 2));
  EXPECT_DOUBLE_EQ(area_m2(mesh), 2 * 20 * 12 + 6 * 64);
  std::set<std::pair<double, double>> corners;
  for (const glm::dvec3& p : mesh.vertices) {
    corners.emplace(p.x, p.y);
    EXPECT_TRUE(p.z == 0 || p.z == 3 || p.z == 6);
  }
  EXPECT_EQ(corners, (std::set<std::pair<double, double>>{{-10, -6}, {10, -6}, {10, 6}, {-10, 6}}));
}

// Every outline under every roof is closed, with courses, eaves, parapets and windows.
TEST_F(CityDerive, BuildingsAreClosed) {
  for (const std::string roof :
       {"<Roof/>", "<Roof parapet=\"1\"/>", "<Roof type=\"gabled\" overhang=\"0.5\"/>",
        "<Roof type=\"gabled\"/>", "<Roof type=\"hipped\" overhang=\"0.5\"/>",
        "<Roof type=\"mansard\" height=\"2\" overhang=\"0.3\"/>"}) {
    const RuleSet rules =
        load(roof + "<Course depth=\"0.2\"/><Course floor=\"ground\" place=\"bottom\"/>" + windows_);
    for (const auto& [name, rings] : outlines)
      for (const bool with_neighbours : {false, true}) {
        BuildingPlan building = plan(rings);
        if (with_neighbours) building.blind_m = {{0, 20, 0, 7}};
        const Mesh mesh = derive_building(building, rules);
        const Crossings crossings = cross(mesh, 400);
        EXPECT_GT(crossings.lines, 100);
        EXPECT_EQ(crossings.open, 0) << name << roof << crossings.first;
        EXPECT_EQ(crossings.inside_out, 0) << name << roof << crossings.first;
        const EdgeBalance balance = edge_balance(mesh);
        EXPECT_EQ(balance.open, 0) << name << roof << balance.first;
        for (const Face& face : mesh.faces) {
          const glm::dvec3 &a = mesh.vertices[face.corner[0]], &b = mesh.vertices[face.corner[1]],
                           &c = mesh.vertices[face.corner[2]], &d = mesh.vertices[face.corner[3]];
          EXPECT_GT(glm::length(glm::cross(c - a, d - b)), 0) << name << roof;
        }
      }
  }
}

TEST_F(CityDerive, SameSeedSameMesh) {
  const RuleSet rules = load(windows_);
  const auto mesh = [&](uint64_t seed) { return derive_building(plan(outlines.at("L"), 4, seed), rules); };
  const Mesh a = mesh(1), b = mesh(1), c = mesh(2);
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_NE(a.vertices, c.vertices);
}

// Party walls are one piece as far up as the neighbour covers whole floors.
TEST_F(CityDerive, BlindWallsArePlain) {
  const RuleSet rules = load(windows_);
  BuildingPlan building = plan(outlines.at("rectangle"), 3);
  building.blind_m = {{9, 6.5, 0, 9}};
  const Mesh mesh = derive_building(building, rules);
  const auto glass = static_cast<uint16_t>(std::find(rules.layers.begin(), rules.layers.end(), "glass") -
                                           rules.layers.begin());
  bool on_free = false, above = false;
  for (const Face& face : mesh.faces) {
    if (face.layer != glass) continue;
    const glm::dvec3 p = mesh.vertices[face.corner[0]];
    EXPECT_FALSE(p.y == -6 || p.x == -10);
    EXPECT_TRUE(p.x < 10 || p.z > 6) << p.z;  // 6.5 m cover two floors
    above |= p.x == 10;
    on_free |= p.y == 6;
  }
  EXPECT_TRUE(on_free && above);
}

TEST_F(CityDerive, FloorsAreAlikeUnlessTheyVary) {
  const auto rows = [&](const std::string& vary) {
    const RuleSet rules = load("<Building vary=\"" + vary + "\"/>" + windows_);
    const Mesh mesh = derive_building(plan(outlines.at("rectangle"), 3), rules);
    std::map<double, std::set<double>> places;  // of vertices on one wall, by height above their floor
    for (const glm::dvec3& p : mesh.vertices)
      if (p.y == -6 && std::fmod(p.z, 3) == 1) places[p.z].insert(p.x);
    EXPECT_EQ(places.size(), 3u);
    return places;
  };
  auto alike = rows("facade");
  EXPECT_EQ(alike[4], alike[7]);
  auto different = rows("floor");
  EXPECT_NE(different[4], different[7]);
}

// A recess that would come out of the next wall becomes plain wall.
TEST_F(CityDerive, RecessesKeepClearOfCorners) {
  write("deep.obj", "g glass\nv 0 0 -1\nv 1 0 -1\nv 1 1 -1\nv 0 1 -1\nf 1 2 3 4\n");
  const RuleSet rules = load(R"(<Terminals><Deep file="deep.obj"/></Terminals>
    <Floor><F><Repeat minWidth="0.8"><Deep/></Repeat></F></Floor>)");
  for (const auto& [name, rings] : outlines) {
    if (name == "thin" || name == "short edges") continue;
    const Mesh mesh = derive_building(plan(rings, 1), rules);
    const Crossings crossings = cross(mesh, 400);
    EXPECT_EQ(crossings.open + crossings.inside_out, 0) << name << crossings.first;
    EXPECT_GT(mesh.faces.size(), 100u);
  }
}

TEST_F(CityDerive, StatedHeight) {
  const RuleSet rules = load("<Building groundHeight=\"4\"/><Floor><F><Wall/></F></Floor>");
  BuildingPlan building = plan(outlines.at("square"), 3);
  building.height_m = 20;
  std::set<double> heights;
  for (const glm::dvec3& p : derive_building(building, rules).vertices) heights.insert(p.z);
  EXPECT_EQ(heights, (std::set<double>{0, 8, 14, 20}));
}

TEST_F(CityDerive, BadPlans) {
  const RuleSet rules = load("<Floor><F><Wall/></F></Floor>");
  EXPECT_THROW(derive_building(plan({}), rules), Error);
  EXPECT_THROW(derive_building(plan({{{0, 0}, {1, 0}, {1, 0}}}), rules), Error);
  EXPECT_THROW(derive_building(plan({{{0, 0}, {1, 0}, {0, std::nan("")}}}), rules), Error);
  EXPECT_THROW(derive_building(plan(outlines.at("square"), 0), rules), Error);
  EXPECT_THROW(derive_building(plan(outlines.at("square"), 2'000'000'000), rules), Error);
}

// Layers of all styles are united, and threads change nothing.
TEST_F(CityDerive, CityOfSeveralStyles) {
  std::vector<RuleSet> styles{load(windows_), load(R"(<Terminals><Wall layer="wall_brick"/></Terminals>
      <Floor><F><Wall/></F></Floor>)")};
  CityPlan city;
  for (uint32_t i = 0; i < 60; ++i) {
    city.buildings.push_back(plan(outlines.at(i % 3 == 0 ? "L" : "square"), 1 + static_cast<int>(i) % 5, i));
    city.buildings.back().style = i % 2;
    city.sites.push_back({std::to_string(i), i, glm::dmat4x3(1)});
  }
  city.sites.push_back({"again", 1, glm::dmat4x3(1)});
  const CityModel model = build_city(city, styles);
  ASSERT_EQ(model.meshes.size(), 60u);
  EXPECT_EQ(model.floors[4], 5);
  const auto layer = [&](const std::string& name) {
    return static_cast<uint16_t>(std::find(model.layers.begin(), model.layers.end(), name) -
                                 model.layers.begin());
  };
  EXPECT_EQ(std::count(model.layers.begin(), model.layers.end(), "roof"), 1);
  EXPECT_EQ(model.meshes[1].faces[0].layer, layer("wall_brick"));
  EXPECT_EQ(model.meshes[0].faces[0].layer, layer("wall"));
  uint64_t triangles = model.meshes[1].triangle_count();
  for (const Mesh& mesh : model.meshes) triangles += mesh.triangle_count();
  EXPECT_EQ(model.triangle_count(), triangles);

  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const CityModel again = build_city(city, styles);
  for (size_t i = 0; i < 60; ++i) {
    EXPECT_EQ(model.meshes[i].vertices, again.meshes[i].vertices);
    EXPECT_TRUE(
        std::equal(model.meshes[i].faces.begin(), model.meshes[i].faces.end(), again.meshes[i].faces.begin(),
                   again.meshes[i].faces.end(),
                   [](const Face& a, const Face& b) { return a.corner == b.corner && a.layer == b.layer; }));
  }
}

// The styles that come with the program: closed, of a bearable size, with windows and a door.
TEST_F(CityDerive, StylesOfTheHouse) {
  const std::filesystem::path folder = std::filesystem::path(VEDUTA_TEST_DATA) / "../../configs/city/rules";
  int styles = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const RuleSet rules = load_rules(entry.path());
    ++styles;
    for (const char* outline : {"rectangle", "courtyard", "irregular", "short edges"}) {
      const Mesh mesh = derive_building(plan(outlines.at(outline), 5), rules);
      const Crossings crossings = cross(mesh, 300);
      EXPECT_EQ(crossings.open, 0) << rules.name << outline << crossings.first;
      EXPECT_EQ(crossings.inside_out, 0) << rules.name << outline << crossings.first;
      std::set<std::string> layers;
      for (const Face& face : mesh.faces) layers.insert(rules.layers[face.layer]);
      EXPECT_TRUE(layers.contains("glass") && layers.contains("door")) << rules.name;
      EXPECT_LT(mesh.triangle_count(), 40000u);
    }
  }
  EXPECT_GE(styles, 7);
}

TEST_F(CityDerive, RuleThatOnlyShrinksForEver) {
  const RuleSet rules =
      load(R"(<Floor><F><Fixed><xProportions x1="1000" x2="1"/><yProportions y1="1000" y2="1"/>
      <Elements><Floor/><Floor/><Floor/><Floor/></Elements></Fixed></F></Floor>)");
  try {
    derive_building(plan(outlines.at("rectangle")), rules);
    ADD_FAILURE() << "ended";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::bad_input);
    EXPECT_NE(std::string(error.what()).find("rule 'F' of shape 'Floor': never ends"), std::string::npos)
        << error.what();
  }
}

// Refused before there is memory for its columns: 20 thousand million of them.
TEST_F(CityDerive, RuleThatSplitsAWallOfAnyLength) {
  for (const char* const split : {"Random", "Repeat"}) {
    const RuleSet rules =
        load(fmt::format("<Floor><F><{0} minWidth=\"0.05\"><Wall/></{0}></F></Floor>", split));
    try {
      derive_building(plan({{{0, 0}, {1e9, 0}, {1e9, 10}, {0, 10}}}), rules);
      ADD_FAILURE() << "built";
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::bad_input);
      EXPECT_NE(std::string(error.what()).find("rule 'F' of shape 'Floor': never ends, or splits too finely"),
                std::string::npos)
          << error.what();
    }
  }
}

}  // namespace
}  // namespace veduta::city
