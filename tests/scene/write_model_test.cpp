#include "scene/writers/write_model.h"

#include <sys/resource.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <csignal>
#include <map>
#include <sstream>

#include "scene/error.h"
#include "scene/writers/cityjson_names.h"
#include "scene/writers/dxf_writer.h"
#include "tests/scene/temporary_models.h"
#include "tests/scene/toy_city_model.h"

namespace veduta::city {
namespace {

std::string bytes_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

const Object& object_of(const Scene& scene, const std::string& name) {
  const auto found = std::find_if(scene.objects.begin(), scene.objects.end(),
                                  [&](const Object& object) { return object.name == name; });
  if (found == scene.objects.end()) throw std::runtime_error("no object " + name);
  return *found;
}

double area_of(const Scene& scene, const Object& object, Material material) {
  double area = 0;
  for (uint64_t i = object.triangle_begin; i < object.triangle_end; ++i)
    if (scene.material[i] == material) area += area_m2(scene, i, i + 1);
  return area;
}

/// A box of the toy city is 16 triangles: 6 quads of walls and window, 2 triangles of roof, a quad of ground.
class WriteModel : public TemporaryModels {
 protected:
  ImportResult round_trip(const std::string& name) const {
    write_model(toy_city_model(), directory_ / name);
    ImportOptions options;
    options.terrain_tile_m = 0;
    ImportResult result = import_scene({directory_ / name}, options);
    result.scene = written_out(result.scene);
    return result;
  }

  /// Bounds in the CRS: the import subtracts an origin.
  static void expect_box(const Scene& scene, const std::string& name, const glm::dvec3& lower,
                         const glm::dvec3& upper) {
    const Box box = bounds_of(scene, object_of(scene, name));
    for (int axis = 0; axis < 3; ++axis) {
      const double origin = scene.origin[static_cast<size_t>(axis)];
      EXPECT_NEAR(box.lower[axis] + origin, lower[axis], 0.00006) << name << " axis " << axis;
      EXPECT_NEAR(box.upper[axis] + origin, upper[axis], 0.00006) << name << " axis " << axis;
    }
  }

  /// Each building where it was put, each face facing outwards and of its material.
  static void expect_toy_city(const Scene& scene) {
    expect_consistent(scene);
    EXPECT_EQ(scene.objects.size(), 5u);
    const glm::dvec3 c = toy_place;
    expect_box(scene, "first", c + glm::dvec3(-5, -3, 0), c + glm::dvec3(5, 3, 9));
    expect_box(scene, "own", c + glm::dvec3(16, -4, 0.0004), c + glm::dvec3(24, 4, 4.0005));
    expect_box(scene, "second", c + glm::dvec3(-3, 15, 0), c + glm::dvec3(3, 25, 9));
    for (const char* const name : {"first", "second"}) {
      const Object& object = object_of(scene, name);
      EXPECT_EQ(object.kind, Kind::building);
      EXPECT_EQ(object.triangle_end - object.triangle_begin, 16u);
      EXPECT_NEAR(area_m2(scene, object.triangle_begin, object.triangle_end), 2 * 60 + 9 * 32, 0.001);
      EXPECT_NEAR(area_of(scene, object, Material::roof), 60, 0.001);
      EXPECT_NEAR(area_of(scene, object, Material::ground), 60, 0.001);
    }
    EXPECT_EQ(object_of(scene, "terrain_0").kind, Kind::terrain);
    EXPECT_EQ(object_of(scene, "road_0").kind, Kind::road);
    const Object& road = object_of(scene, "road_0");
    EXPECT_NEAR(area_m2(scene, road.triangle_begin, road.triangle_end), 400, 0.01);
    const Object& terrain = object_of(scene, "terrain_0");
    EXPECT_NEAR(area_of(scene, terrain, Material::terrain), 2000 - 16, 0.01);
    expect_outward(scene);
  }

  /// The volume under the faces, by the divergence theorem: negative or smaller when any face is turned.
  static void expect_outward(const Scene& scene) {
    const std::map<std::string, double> volume{{"first", 540}, {"second", 540}, {"own", 64 * 4.0001}};
    for (const auto& [name, expected] : volume) {
      const Object& object = object_of(scene, name);
      const glm::dvec3 near(bounds_of(scene, object).lower);
      double six_volumes = 0;
      for (uint64_t i = object.triangle_begin; i < object.triangle_end; ++i) {
        const glm::uvec3 t = scene.triangles[i];
        const glm::dvec3 a = glm::dvec3(scene.vertices[t.x]) - near,
                         b = glm::dvec3(scene.vertices[t.y]) - near,
                         d = glm::dvec3(scene.vertices[t.z]) - near;
        six_volumes += glm::dot(a, glm::cross(b, d));
      }
      EXPECT_NEAR(six_volumes / 6, expected, 0.01) << name;
    }
  }
};

TEST_F(WriteModel, CityJsonComesBackAsItWas) {
  const ImportResult result = round_trip("toy.city.json");
  EXPECT_EQ(result.report.format, "CityJSON 2.0");
  EXPECT_EQ(result.scene.crs, "EPSG:3946");
  EXPECT_TRUE(result.report.dropped.empty());
  expect_toy_city(result.scene);
}

TEST_F(WriteModel, ObjComesBackAsItWas) {
  const ImportResult result = round_trip("toy.obj");
  EXPECT_TRUE(result.report.dropped.empty());
  expect_toy_city(result.scene);
  ASSERT_EQ(result.scene.parts.size(), 3u * 4 + 2);
  EXPECT_EQ(result.scene.parts[1].name, "window");
  EXPECT_EQ(result.scene.parts[1].triangle_end - result.scene.parts[1].triangle_begin, 2u);
}

TEST_F(WriteModel, CityJsonHoldsASharedMeshOnce) {
  write_model(toy_city_model(), directory_ / "toy.json");
  const std::string text = bytes_of(directory_ / "toy.json");
  EXPECT_NE(text.find("\"geometry-templates\""), std::string::npos);
  EXPECT_NE(text.find("\"transformationMatrix\":[0,-1,0,0,1,0,0,0,0,0,1,0,0,0,0,1]"), std::string::npos);
  EXPECT_NE(text.find("{\"storeysAboveGround\":1,\"style\":\"a \\\"quoted\\\" style\"}"), std::string::npos);
  CityModel model = toy_city_model();
  model.sites.pop_back();
  write_model(model, directory_ / "single.json");
  EXPECT_EQ(bytes_of(directory_ / "single.json").find("geometry-templates"), std::string::npos);
}

TEST_F(WriteModel, AMirroredBuildingIsNotInsideOut) {
  for (const bool shared : {true, false})
    for (const char* const name : {"mirrored.city.json", "mirrored.obj"}) {
      CityModel model = toy_city_model();
      model.sites[2].placement[0] = {-1, 0, 0};
      model.sites[2].placement[1] = {0, 1, 0};
      if (!shared) {
        model.sites[2].building = 2;
        model.meshes.push_back(model.meshes[0]);
        model.floors.push_back(3);
        model.styles.push_back("brick");
      }
      // Instances are the importer's: it learns to turn mirrored ones with the instances themselves.
      if (shared && std::string(name) == "mirrored.city.json") continue;
      write_model(model, directory_ / name);
      expect_outward(import_scene({directory_ / name}).scene);
    }
}

TEST_F(WriteModel, TheNumberOfThreadsDoesNotShow) {
  CityModel model = toy_city_model();
  for (int i = 0; i < 200; ++i)
    model.sites.push_back({"more_" + std::to_string(i), static_cast<uint32_t>(i % 2),
                           turned(toy_place + glm::dvec3(40 * i, 100, i / 7.0))});
  for (const char* const name : {"t.city.json", "t.obj", "t.dxf"}) {
    std::string first;
    for (const size_t threads : {1u, 2u, 7u}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      write_model(model, directory_ / name);
      const std::string bytes = bytes_of(directory_ / name);
      if (first.empty()) first = bytes;
      EXPECT_EQ(bytes, first) << name << " with " << threads << " threads";
    }
  }
}

TEST_F(WriteModel, DxfHoldsBlocksInsertsAndGround) {
  write_model(toy_city_model(), directory_ / "toy.dxf");
  std::istringstream text(bytes_of(directory_ / "toy.dxf"));
  std::map<std::string, int> entities, faces_of_layer;
  std::string code, value, entity, section_or_block;
  std::vector<std::string> blocks, turns;
  while (std::getline(text, code) && std::getline(text, value)) {
    if (code == "0") ++entities[entity = value];
    if (code == "8" && entity == "3DFACE") ++faces_of_layer[value];
    if (code == "2" && entity == "BLOCK") blocks.push_back(value);
    if (code == "50" && entity == "INSERT") turns.push_back(value);
  }
  EXPECT_EQ(value, "EOF");
  EXPECT_EQ(blocks, (std::vector<std::string>{"first", "own"}));
  EXPECT_EQ(entities["INSERT"], 3);
  EXPECT_EQ(entities["3DFACE"], 2 * 9 + 8 + 2);
  EXPECT_EQ(faces_of_layer,
            (std::map<std::string, int>{
                {"wall", 10}, {"window", 2}, {"roof", 4}, {"ground", 2}, {"terrain", 8}, {"road", 2}}));
  EXPECT_EQ(turns, std::vector<std::string>{"90"});
  EXPECT_NE(text.str().find("$INSUNITS\n70\n6\n"), std::string::npos);
  EXPECT_NE(text.str().find("\n10\n1844012.25\n20\n5174253.5\n30\n163.125\n"), std::string::npos);
}

TEST_F(WriteModel, DxfNamesAreMadeFitAndStayApart) {
  CityModel model = toy_city_model();
  model.meshes.push_back(model.meshes[1]);
  model.floors.push_back(1);
  model.styles.push_back("brick");
  model.sites[0].name = "rue de l'\xc3\x89glise";
  model.sites[2] = {"RUE DE L-" + std::string(40, 'x'), 1, turned(toy_place)};
  model.sites[1] = {"rue de l'\xc3\x89glise", 2, moved(toy_place)};
  write_model(model, directory_ / "names.dxf");
  const std::string text = bytes_of(directory_ / "names.dxf");
  EXPECT_NE(text.find("2\nrue_de_l___glise\n"), std::string::npos);
  EXPECT_NE(text.find("2\nrue_de_l___glise_2\n"), std::string::npos);
  EXPECT_NE(text.find("2\nRUE_DE_L-" + std::string(22, 'x') + "\n"), std::string::npos);
}

TEST(InsertOf, ExpressesTurnsScalesAndMirrors) {
  const auto turn = insert_of({{0, 2, 0}, {-3, 0, 0}, {0, 0, 4}, {7, 8, 9}});
  ASSERT_TRUE(turn);
  EXPECT_DOUBLE_EQ(turn->degrees, 90);
  EXPECT_EQ(turn->scale, glm::dvec3(2, 3, 4));
  EXPECT_EQ(turn->at, glm::dvec3(7, 8, 9));
  const auto mirror = insert_of({{1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, 0}});
  ASSERT_TRUE(mirror);
  EXPECT_EQ(mirror->scale, glm::dvec3(1, -1, 1));
  EXPECT_FALSE(insert_of({{1, 0, 0}, {0.1, 1, 0}, {0, 0, 1}, {0, 0, 0}})) << "sheared";
  EXPECT_FALSE(insert_of({{1, 0, 0}, {0, 0, 1}, {0, -1, 0}, {0, 0, 0}})) << "turned about x";
  EXPECT_FALSE(insert_of({{1, 0, 0.1}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}})) << "tilted";
}

TEST_F(WriteModel, DxfLaysOutWhatAnInsertCannotExpress) {
  CityModel model = toy_city_model();
  model.sites[2].placement[1] = {-1, 0.5, 0};  // sheared
  write_model(model, directory_ / "sheared.dxf");
  const std::string text = bytes_of(directory_ / "sheared.dxf");
  EXPECT_NE(text.find("2\nsecond\n"), std::string::npos);
  // The corner (-5, -3, 0) of the box, in the city: x = 3 - 0, y = 20 - 5 - 1.5.
  EXPECT_NE(text.find("\n1844015.25\n20\n5174247\n"), std::string::npos);
}

TEST(TextBuffer, WritesMetresToTheQuantum) {
  const std::vector<std::pair<double, std::string>> cases{{0, "0"},
                                                          {-0.0, "0"},
                                                          {0.00004, "0"},
                                                          {-0.00004, "0"},
                                                          {0.0001, "0.0001"},
                                                          {-0.0001, "-0.0001"},
                                                          {12.5, "12.5"},
                                                          {0.99996, "1"},
                                                          {-3.05, "-3.05"},
                                                          {5174233.4567, "5174233.4567"},
                                                          {1e9, "1000000000"},
                                                          {100.0100, "100.01"}};
  for (const auto& [value, expected] : cases) {
    TextBuffer text;
    text.add_metres(value);
    EXPECT_EQ(text.view(), expected);
  }
}

TEST(ReferenceSystem, IsTheUrlThatCityJsonAsksFor) {
  EXPECT_EQ(reference_system("EPSG:3946"), "https://www.opengis.net/def/crs/EPSG/0/3946");
  EXPECT_EQ(reference_system("urn:ogc:def:crs:EPSG::7415"), "https://www.opengis.net/def/crs/EPSG/0/7415");
  EXPECT_EQ(reference_system("https://www.opengis.net/def/crs/EPSG/0/7415"),
            "https://www.opengis.net/def/crs/EPSG/0/7415");
  EXPECT_EQ(reference_system("EPSG:"), "EPSG:");
}

void expect_error(const CityModel& model, const std::filesystem::path& file, ExitStatus status,
                  const std::string& says) {
  try {
    write_model(model, file);
    ADD_FAILURE() << file << " was written";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), status) << error.what();
    EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
  }
}

TEST_F(WriteModel, RefusesWhatItCannotWrite) {
  expect_error(toy_city_model(), directory_ / "toy.ply", ExitStatus::usage, "cannot tell the format");
  expect_error(toy_city_model(), directory_ / "no/toy.obj", ExitStatus::input_output, "No such file");
  expect_error({}, directory_ / "empty.obj", ExitStatus::bad_input, "neither a building nor ground");
  CityModel flat = toy_city_model();
  flat.ground[1].rings[0] = {{0, 0, 0}, {1, 1, 0}, {2, 2, 0}};
  expect_error(flat, directory_ / "flat.obj", ExitStatus::bad_input, "ground polygon 1");
  EXPECT_TRUE(std::filesystem::is_empty(directory_)) << "half a file was left";
}

TEST_F(WriteModel, AFullDiskLeavesTheOldFile) {
  const std::filesystem::path file = write("toy.obj", "old");
  // A limit on the size of files stands for a full disk: write(2) fails just so.
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small{1000, before.rlim_max};
  std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  expect_error(toy_city_model(), file, ExitStatus::input_output, "toy.obj.tmp");
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  EXPECT_EQ(bytes_of(file), "old");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(directory_), {}), 1);
}

}  // namespace
}  // namespace veduta::city
