// scene/scene_frame.h and scene/instances.h: up axis, unit and CRS of models, and their sizes.
#include "scene/scene_frame.h"

#include "scene/error.h"
#include "scene/instances.h"
#include "temporary_models.h"

namespace veduta {
namespace {

// One triangle, in the file's coordinates.
RawModel model_at(const glm::dvec3& corner, const std::string& crs = "", double size = 10) {
  RawModel model;
  model.file = "m.obj";
  model.crs = crs;
  model.vertices = {corner, corner + glm::dvec3(size, 0, 0), corner + glm::dvec3(0, size, size)};
  model.ring_vertex = {0, 1, 2};
  model.ring_end = {3};
  model.polygons = {{1, 1, Material::unknown}};
  model.objects.push_back({"a", Kind::building, "m.obj", {{"", "m.obj", 0, 1}}, RawObject::unplaced});
  return model;
}

RawModel framed(RawModel model, const ImportOptions& options = {}) {
  std::vector<RawModel> models{std::move(model)};
  bring_to_frame(models, options);
  return std::move(models[0]);
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double error = 1e-9) {
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(a[axis], b[axis], error) << "axis " << axis;
}

TEST(SceneFrame, TurnsAndScalesAsTheModelOrTheOptionsSay) {
  RawModel model = model_at({1, 2, 3});
  expect_near(framed(model).vertices[0], {1, 2, 3});
  model.up = UpAxis::y;
  model.unit_m = 0.001;
  const RawModel turned = framed(model);
  expect_near(turned.vertices[0], {0.001, -0.003, 0.002});
  EXPECT_EQ(turned.up, UpAxis::z);
  EXPECT_EQ(turned.unit_m, 1);
  expect_near(framed(model, {.up = UpAxis::z, .unit_m = 2}).vertices[0], {2, 4, 6});
}

TEST(SceneFrame, InstancesKeepTheirMeshAndTheirPlacementsAreTurned) {
  RawModel model = model_at({1, 2, 3});
  model.up = UpAxis::y;
  model.unit_m = 2;
  // A second object, an instance of a polygon that shares vertex 0 with the first.
  model.ring_vertex.insert(model.ring_vertex.end(), {0, 1, 2});
  model.ring_end.push_back(6);
  model.polygons.push_back({2, 2, Material::unknown});
  model.placements = {glm::dmat4x3({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {100, 10, 7}),
                      glm::dmat4x3({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {200, 0, 0})};
  for (uint32_t i = 0; i < 2; ++i) model.objects.push_back({"b", Kind::building, "", {{"", "m", 1, 2}}, i});
  const auto place = [](const RawModel& m, size_t object) {
    const uint32_t vertex = corners_of(m, m.objects[object].patches[0])[0];
    return m.placements[m.objects[object].placement] * glm::dvec4(m.vertices[vertex], 1);
  };
  RawModel turned = framed(model);
  expect_near(turned.vertices[0], {2, -6, 4});
  ASSERT_EQ(turned.placements.size(), 2u);
  expect_near(place(turned, 1), {2 * 101, -2 * 10, 2 * 12});
  expect_near(place(turned, 2), {2 * 201, -2 * 3, 2 * 2});
  flatten_instances(turned);
  EXPECT_TRUE(turned.placements.empty());
  EXPECT_EQ(turned.polygons.size(), 3u);
  for (size_t i = 0; i < 3; ++i) EXPECT_EQ(turned.objects[i].placement, RawObject::unplaced);
  const auto first = [&](size_t object) {
    return turned.vertices[corners_of(turned, turned.objects[object].patches[0])[0]];
  };
  expect_near(first(0), {2, -6, 4});
  expect_near(first(1), {202, -20, 24});
  expect_near(first(2), {402, -6, 4});
}

// gdaltransform -s_srs OGC:CRS84 -t_srs EPSG:28992 says 79536.059 457489.582 of 4.2858 52.1005, and
// of 14.3 48.3 in EPSG:32633 448086.750 5349881.633.
TEST(SceneFrame, ModelsAreProjectedToTheSceneCrs) {
  std::vector<RawModel> models{model_at({78248.66, 457604.591, 2}, "EPSG:7415"), model_at({0, 0, 0}),
                               model_at({4.2858, 52.1005, 2}, "EPSG:4326", 1e-4)};
  bring_to_frame(models, {});
  for (const RawModel& model : models) EXPECT_EQ(model.crs, "EPSG:7415");
  expect_near(models[0].vertices[0], {78248.66, 457604.591, 2});
  expect_near(models[1].vertices[0], {0, 0, 0});
  expect_near(models[2].vertices[0], {79536.059, 457489.582, 2}, 0.01);
  EXPECT_NEAR(models[2].vertices[2].y - models[2].vertices[0].y, 11.1, 0.2) << "1e-4 degrees of latitude";
  EXPECT_EQ(models[2].vertices[0].z, 2) << "heights stay";
  std::vector<RawModel> same{model_at({78248, 457604, 2}, "EPSG:7415"),
                             model_at({78248, 457604, 2}, "EPSG:28992")};
  bring_to_frame(same, {});
  EXPECT_EQ(same[1].vertices[0], glm::dvec3(78248, 457604, 2));
  EXPECT_EQ(same[1].crs, "EPSG:7415");
}

TEST(SceneFrame, DegreesBecomeTheUtmZoneOfTheirMiddle) {
  const RawModel stated = framed(model_at({14.3, 48.3, 250}, "EPSG:4326", 1e-4));
  EXPECT_EQ(stated.crs, "EPSG:32633");
  expect_near(stated.vertices[0], {448086.750, 5349881.633, 250}, 0.01);
  const RawModel told = framed(model_at({14.3, 48.3, 250}, "", 1e-4), {.crs = "EPSG:4326"});
  EXPECT_EQ(told.crs, "EPSG:32633");
  expect_near(told.vertices[0], stated.vertices[0]);
  RawModel scaled = model_at({14.3, 48.3, 250}, "EPSG:4326", 1e-4);
  scaled.unit_m = 0.5;
  expect_near(framed(scaled).vertices[0], {stated.vertices[0].x, stated.vertices[0].y, 125});
}

// gdaltransform -s_srs EPSG:2263 -t_srs EPSG:32618 says 583167.684 4507656.211 of 980000 200000.
TEST(SceneFrame, FeetBecomeMetresInTheUtmZone) {
  const RawModel model = framed(model_at({980000, 200000, 100}, "EPSG:2263", 100));
  EXPECT_EQ(model.crs, "EPSG:32618");
  expect_near(model.vertices[0], {583167.684, 4507656.211, 100 * 1200.0 / 3937}, 0.01);
  expect_near(model.vertices[1] - model.vertices[0], {30.48, 0, 0}, 0.5);
  const RawModel metres = framed(model_at({980000, 200000, 100}, "EPSG:2263", 100), {.unit_m = 1});
  EXPECT_EQ(metres.vertices[0].z, 100) << "heights in metres, as the user says";
  expect_near(metres.vertices[0], {model.vertices[0].x, model.vertices[0].y, 100});
}

TEST(SceneFrame, CrsThatNobodyKnowsAreRefused) {
  EXPECT_THROW(framed(model_at({0, 0, 0}, "EPSG:1")), Error);
  EXPECT_THROW(framed(model_at({0, 0, 0}), {.crs = "the moon"}), Error);
  EXPECT_THROW(framed(model_at({14.3, 1000, 0}, "EPSG:4326"), {}), Error);
}

TEST(SceneFrame, ACityOfAnotherUnitIsRefused) {
  const auto refusal = [](std::vector<RawModel> models) {
    try {
      require_size_of_city(models);
      return std::string();
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::bad_input);
      return std::string(error.what());
    }
  };
  const auto holds = [](const std::string& text, const char* what) {
    return text.find(what) != std::string::npos;
  };
  EXPECT_EQ(refusal({model_at({0, 0, 0}, "", 0.001)}), "") << "one object may be small";
  EXPECT_EQ(refusal({model_at({0, 0, 0}, "", 1)}), "");
  EXPECT_EQ(refusal({model_at({0, 0, 0}), model_at({900'000, 0, 0})}), "");
  EXPECT_TRUE(holds(refusal({model_at({0, 0, 0}), model_at({1'100'000, 0, 0})}), "scene.unit (0.001"));
  EXPECT_TRUE(holds(refusal({model_at({0, 0, 0}, "", 30'000)}), "scene.unit (0.001")) << "30 km high";
  EXPECT_TRUE(
      holds(refusal({model_at({0, 0, 0}, "", 0.01), model_at({0.5, 0, 0}, "", 0.01)}), "scene.unit (1000"));
  EXPECT_TRUE(holds(refusal({model_at({14.3, 48.3, 0}, "", 0.01), model_at({14.31, 48.3, 30}, "", 0.01)}),
                    "scene.crs (EPSG:4326)"));
}

class SceneFrameImport : public TemporaryModels {};

TEST_F(SceneFrameImport, AStatedUnitIsBelieved) {
  const std::string town =
      "v 0 0 0\nv .1 0 0\nv 0 .1 .1\no a\nf 1 2 3\nv .5 0 0\nv .6 0 0\nv .5 .1 .1\no b\nf 4 5 6\n";
  EXPECT_THROW(import("small.obj", town), Error);
  const Scene kilometres = import("small.obj", town, {.unit_m = 1000}).scene;
  EXPECT_NEAR(static_cast<double>(kilometres.bounds().upper.x - kilometres.bounds().lower.x), 600, 1e-3);
  EXPECT_NO_THROW(import("small.obj", town, {.unit_m = 1}));
  const Scene turned = import("y.obj", "v 0 0 0\nv 10 0 0\nv 0 10 0\nf 1 2 3\n", {.up = UpAxis::y}).scene;
  EXPECT_NEAR(static_cast<double>(turned.bounds().upper.z), 10, 1e-6);
}

}  // namespace
}  // namespace veduta
