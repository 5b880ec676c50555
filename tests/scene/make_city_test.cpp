#include "scene/city/make_city.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "scene/error.h"
#include "scene/writers/write_model.h"
#include "tests/scene/temporary_models.h"

namespace veduta::city {
namespace {

const std::filesystem::path city_configs = VEDUTA_TEST_DATA "/../../configs/city";

std::string bytes_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

class MakeCity : public TemporaryModels {
 protected:
  CitySettings parse(const std::string& text) const {
    return parse_city_settings(text, "city.toml", city_configs);
  }
  void expect_refused(const std::string& text, const std::string& says) const {
    try {
      make_city(parse(text));
      ADD_FAILURE() << "accepted: " << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::bad_input) << error.what();
      EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  }
  const std::string rules = "[[rules]]\nfile = \"rules/plain.xml\"\n";
};

TEST_F(MakeCity, TheSameConfigurationGivesTheSameBytesWithAnyNumberOfThreads) {
  const CitySettings settings = load_city_settings(city_configs / "thesis_small.toml");
  std::string first;
  for (const size_t threads : {1u, 2u, 7u}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    write_model(make_city(settings).model, directory_ / "small.obj");
    const std::string bytes = bytes_of(directory_ / "small.obj");
    if (first.empty()) first = bytes;
    EXPECT_TRUE(bytes == first) << threads << " threads";
  }
  CitySettings other = settings;
  other.seed = settings.seed + 1;
  write_model(make_city(other).model, directory_ / "other.obj");
  EXPECT_FALSE(bytes_of(directory_ / "other.obj") == first) << "another seed";
}

TEST_F(MakeCity, ProgressGrowsToTheNumberOfBuildings) {
  std::vector<uint64_t> reported;
  make_city(load_city_settings(city_configs / "thesis_small.toml"), [&](uint64_t done, uint64_t total) {
    EXPECT_EQ(total, 96u);
    reported.push_back(done);
  });
  ASSERT_FALSE(reported.empty());
  EXPECT_TRUE(std::is_sorted(reported.begin(), reported.end()));
  EXPECT_LE(reported.back(), 96u);
}

TEST_F(MakeCity, ThesisCitiesHaveTheirBuildings) {
  const std::map<std::string, size_t> buildings{{"thesis_small", 96}, {"thesis_medium", 1024}};
  for (const auto& [name, count] : buildings) {
    const MadeCity city = make_city(load_city_settings(city_configs / (name + ".toml")));
    EXPECT_EQ(city.model.sites.size(), count);
    std::map<std::string, int> styles;
    for (const std::string& style : city.model.styles) ++styles[style];
    EXPECT_EQ(styles.size(), 6u) << name;
    const double each = static_cast<double>(city.model.triangle_count()) / static_cast<double>(count);
    EXPECT_GT(each, 5000) << name;
    EXPECT_LT(each, 8000) << name;
  }
  const CitySettings full = load_city_settings(city_configs / "thesis_full.toml");
  EXPECT_EQ(full.streets.blocks[0] * full.streets.blocks[1] * full.streets.buildings_per_block, 6144);
}

// What the three formats say of one city: CityJSON has instances, OBJ is flat, DXF has blocks.
TEST_F(MakeCity, EveryFormatReadsBackAsTheSameCity) {
  const MadeCity city = make_city(load_city_settings(VEDUTA_TEST_DATA "/formats/generated.toml"));
  const size_t count = city.model.sites.size();
  for (const char* const name : {"generated.city.json", "generated.obj", "generated.dxf"}) {
    write_model(city.model, directory_ / name);
    const ImportResult read = import_scene({directory_ / name});
    EXPECT_EQ(read.report.objects_by_kind.at("building"), count) << name;
    uint64_t triangles = 0;
    for (const Object& object : read.scene.objects)
      if (object.kind == Kind::building) triangles += object.triangle_end - object.triangle_begin;
    EXPECT_EQ(triangles, city.model.triangle_count()) << name;
    for (const auto& [reason, dropped] : read.report.dropped) ADD_FAILURE() << name << ": " << reason;
    const Scene flat = written_out(read.scene);
    std::map<Material, double> area;
    for (uint64_t i = 0; i < flat.triangles.size(); ++i) area[flat.material[i]] += area_m2(flat, i, i + 1);
    EXPECT_GT(area[Material::wall], 100) << name;
    EXPECT_GT(area[Material::window], 10) << name;
    EXPECT_GT(area[Material::door], 1) << name;
    EXPECT_GT(area[Material::roof], 10) << name;
    EXPECT_GT(area[Material::road], 100) << name;
    EXPECT_GT(area[Material::terrain], 100) << name;
    EXPECT_EQ(read.scene.bounds().upper.x - read.scene.bounds().lower.x,
              import_scene({directory_ / "generated.city.json"}).scene.bounds().upper.x -
                  import_scene({directory_ / "generated.city.json"}).scene.bounds().lower.x)
        << name;
  }
}

TEST_F(MakeCity, TheExamplesAreWhatTheirConfigurationGives) {
  const MadeCity city = make_city(load_city_settings(VEDUTA_TEST_DATA "/formats/generated.toml"));
  for (const char* const name : {"generated.city.json", "generated.obj", "generated.dxf"}) {
    write_model(city.model, directory_ / name);
    EXPECT_TRUE(bytes_of(directory_ / name) == bytes_of(std::string(VEDUTA_TEST_DATA "/formats/") + name))
        << name << ": make it again with veduta city tests/data/formats/generated.toml";
  }
}

TEST_F(MakeCity, ASelfCrossingFootprintIsMendedAndSaid) {
  write("plan.geojson",
        R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:3946"}},"features":[
  {"type":"Feature","properties":{"floors":3},"geometry":{"type":"Polygon","coordinates":
    [[[1842000,5175000],[1842010,5175010],[1842010,5175000],[1842000,5175010],[1842000,5175000]]]}}]})");
  const MadeCity city =
      make_city(parse("[plan]\nfile = \"" + (directory_ / "plan.geojson").string() + "\"\n" + rules));
  EXPECT_EQ(city.model.sites.size(), 2u) << "a bow tie is two triangles";
  EXPECT_FALSE(city.report.dropped.empty());
}

TEST_F(MakeCity, RefusesPlansAndRulesThatCannotBeUsed) {
  write("plan.geojson", "{\"type\":\"FeatureCollection\",\"features\":[");
  write("rules.xml", "<Rules name=\"x\"><Building");
  expect_refused("[plan]\nfile = \"" + (directory_ / "plan.geojson").string() + "\"\n" + rules,
                 "plan.geojson");
  expect_refused("[streets]\n[[rules]]\nfile = \"" + (directory_ / "rules.xml").string() + "\"\n",
                 "rules.xml: line 1");
}

/// The four files of one plan, under one configuration.
class LyonPlan : public testing::Test {
 protected:
  static MadeCity city(const std::string& file, std::array<bool, 3> use) {
    // Flat roofs: a quarter of the time.
    CitySettings settings = parse_city_settings(
        "[plan]\nfile = \"" + folder + file +
            "\"\ncrs = \"EPSG:3946\"  # a DXF states none\n"
            "[[rules]]\nfile = \"rules/plain.xml\"\n[[rules]]\nfile = \"rules/modern_bands.xml\"\n",
        "lyon.toml", city_configs);
    settings.footprints.use_floors = use[0];
    settings.footprints.use_heights = use[1];
    settings.footprints.use_ground = use[2];
    return make_city(settings);
  }

  static void expect_same(const MadeCity& a, const MadeCity& b) {
    ASSERT_EQ(a.model.sites.size(), b.model.sites.size());
    EXPECT_EQ(a.model.crs, b.model.crs);
    size_t different = 0;
    for (size_t i = 0; i < a.model.sites.size(); ++i) {
      const Mesh &mine = a.model.meshes[i], &other = b.model.meshes[i];
      const bool same =
          a.model.sites[i].placement == b.model.sites[i].placement &&
          a.model.styles[i] == b.model.styles[i] && a.model.floors[i] == b.model.floors[i] &&
          mine.vertices == other.vertices && mine.faces.size() == other.faces.size() &&
          std::equal(mine.faces.begin(), mine.faces.end(), other.faces.begin(),
                     [](const Face& x, const Face& y) { return x.corner == y.corner && x.layer == y.layer; });
      different += same ? 0 : 1;
    }
    EXPECT_EQ(different, 0u) << "of " << a.model.sites.size() << " buildings";
  }

  static bool there() { return std::filesystem::exists(folder); }
  static inline const std::string folder = VEDUTA_SHARED_DATA "/lyon_plan/";
};

TEST_F(LyonPlan, GivesTheSameCityFromEachOfItsFourFiles) {
  if (!there()) GTEST_SKIP() << folder << " is not there";
  const MadeCity geojson = city("buildings_lyon1.geojson", {false, false, false});
  EXPECT_EQ(geojson.model.sites.size(), 2571u) << "2,576 polygons, five of them under 1 m2";
  for (const char* const file :
       {"lyon1_floors_lwpolyline.dxf", "lyon1_hatch.dxf", "lyon1_roof_polyline3d.dxf"}) {
    SCOPED_TRACE(file);
    expect_same(geojson, city(file, {false, false, false}));
  }
}

TEST_F(LyonPlan, FloorsComeFromTheLayersOfTheDxf) {
  if (!there()) GTEST_SKIP() << folder << " is not there";
  const MadeCity geojson = city("buildings_lyon1.geojson", {true, false, false});
  EXPECT_GT(geojson.counts.floors_stated, 1700u);
  expect_same(geojson, city("lyon1_floors_lwpolyline.dxf", {true, false, false}));
}

}  // namespace
}  // namespace veduta::city
