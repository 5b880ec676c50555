// Plans: toy files with exact rings, one plan in three formats, Lyon's in four files, and files that are
// none.
#include "scene/footprints.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "scene/plans/footprint_fields.h"
#include "scene/plans/footprint_polygons.h"
#include "scene/plans/nested_rings.h"
#include "temporary_models.h"

namespace veduta {
namespace {

using Rings = std::vector<std::vector<glm::dvec2>>;

InputFile in_memory(const std::string& name, const std::string& content) {
  const std::filesystem::path path(name);
  return {name, path.stem().string(), path.extension().string(),
          content + std::string(InputFile::padding, '\0')};
}

// Siblings of a file on disk.
FindFile beside(const std::filesystem::path& path) {
  return [folder = path.parent_path()](const std::string& relative) -> std::optional<InputFile> {
    if (!std::filesystem::exists(folder / relative)) return std::nullopt;
    return read_input(folder / relative);
  };
}

struct Read {
  Footprints plan;
  ImportReport report;

  uint64_t dropped(const std::string& reason) const {
    const auto found = report.dropped.find(reason);
    return found == report.dropped.end() ? 0 : found->second.count;
  }
};

Read read(const InputFile& file, const ImportOptions& options = {}) {
  Read result;
  const FindFile nothing = [](const std::string&) { return std::optional<InputFile>(); };
  result.plan = read_footprints(file, nothing, options, result.report);
  return result;
}
Read read(const std::string& name, const std::string& content, const ImportOptions& options = {}) {
  return read(in_memory(name, content), options);
}
Read read(const std::filesystem::path& path) {
  Read result;
  result.plan = read_footprints(read_input(path), beside(path), {}, result.report);
  return result;
}

std::string feature(const std::string& properties, const std::string& geometry) {
  return R"({"type":"Feature","properties":{)" + properties + R"(},"geometry":)" + geometry + "}";
}
std::string polygon(const std::string& rings) {
  return R"({"type":"Polygon","coordinates":[)" + rings + "]}";
}
std::string geojson(const std::string& features, const std::string& crs = "urn:ogc:def:crs:EPSG::3946") {
  const std::string member =
      crs.empty() ? "" : R"("crs":{"type":"name","properties":{"name":")" + crs + "\"}},";
  return R"({"type":"FeatureCollection",)" + member + "\"features\":[" + features + "]}";
}
const std::string square = polygon("[[0,0],[4,0],[4,3],[0,3],[0,0]]");

std::string refusal(const InputFile& file, const ImportOptions& options = {}) {
  try {
    read(file, options);
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::bad_input);
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    EXPECT_LT(std::string(error.what()).size(), 600u);
    return error.what();
  }
  return "read";
}

// What Footprint promises of its rings.
void expect_consistent(const Footprints& plan) {
  for (const Footprint& footprint : plan.footprints) {
    ASSERT_FALSE(footprint.rings.empty()) << footprint.place;
    for (size_t i = 0; i < footprint.rings.size(); ++i) {
      const FlatRing& ring = footprint.rings[i];
      ASSERT_GE(ring.size(), 3u) << footprint.place;
      EXPECT_EQ(signed_area(ring) > 0, i == 0) << footprint.place;
      for (size_t k = 0; k < ring.size(); ++k)
        EXPECT_NE(ring[k], ring[(k + 1) % ring.size()]) << footprint.place;
    }
  }
}

// Equal but for the start point and `tolerance`.
bool same_ring(const FlatRing& a, const FlatRing& b, double tolerance) {
  if (a.size() != b.size()) return false;
  for (size_t start = 0; start < b.size(); ++start) {
    size_t k = 0;
    while (k < a.size() && glm::distance(a[k], b[(start + k) % b.size()]) <= tolerance) ++k;
    if (k == a.size()) return true;
  }
  return false;
}

void expect_same_rings(const Footprints& a, const Footprints& b, double tolerance) {
  ASSERT_EQ(a.footprints.size(), b.footprints.size());
  for (size_t i = 0; i < a.footprints.size() && !testing::Test::HasFailure(); ++i) {
    const Rings &left = a.footprints[i].rings, &right = b.footprints[i].rings;
    ASSERT_EQ(left.size(), right.size()) << b.footprints[i].place;
    EXPECT_TRUE(same_ring(left[0], right[0], tolerance)) << b.footprints[i].place;
    for (size_t hole = 1; hole < left.size(); ++hole)
      EXPECT_TRUE(std::any_of(right.begin() + 1, right.end(),
                              [&](const FlatRing& other) { return same_ring(left[hole], other, tolerance); }))
          << b.footprints[i].place << " hole " << hole;
  }
}

TEST(Footprints, GeoJson) {
  const Read r =
      read("a.geojson", geojson(feature(R"("ID":"north","HAUTEUR":9.5,"NB_ETAGES":3,"Z_MIN_SOL":200.25)",
                                        polygon("[[0,0,209],[0,8,209],[9,8,209],[9,0,209],[0,0,209]],"
                                                "[[2,2,209],[2,4,209],[4,4,209],[2,2,209]]")) +
                                "," + feature("", square)));
  EXPECT_EQ(r.plan.format, "GeoJSON");
  EXPECT_EQ(r.plan.crs, "EPSG:3946");
  ASSERT_EQ(r.plan.footprints.size(), 2u);
  const Footprint& north = r.plan.footprints[0];
  EXPECT_EQ(north.name, "north");
  EXPECT_EQ(north.place, "a.geojson: features/0");
  EXPECT_EQ(north.rings, (Rings{{{9, 0}, {9, 8}, {0, 8}, {0, 0}}, {{2, 2}, {2, 4}, {4, 4}}}));
  EXPECT_EQ(north.ground, 200.25);
  EXPECT_EQ(north.height_m, 9.5);
  EXPECT_EQ(north.floors, 3);
  EXPECT_EQ(r.plan.footprints[1].name, "footprint_2");
  EXPECT_FALSE(r.plan.footprints[1].ground || r.plan.footprints[1].height_m || r.plan.footprints[1].floors);
  EXPECT_TRUE(r.report.dropped.empty());
}

TEST(Footprints, DoublesAreNotRounded) {
  const Read r = read(
      "a.geojson",
      geojson(feature("", polygon("[[1841205.541376449167728,5176065.184761937707663],[1841209,5176060],["
                                  "1841209,5176066],[1841205.541376449167728,5176065.184761937707663]]"))));
  EXPECT_EQ(r.plan.footprints[0].rings[0][0], glm::dvec2(1841205.541376449167728, 5176065.184761937707663));
}

TEST(Footprints, AMultipolygonIsAFootprintForEachPart) {
  const Read r = read(
      "a.geojson",
      geojson(feature(
          R"("id":"x","height":5)",
          R"({"type":"MultiPolygon","coordinates":[[[[0,0],[1,0],[0,1],[0,0]]],[[[5,5],[6,5],[5,6],[5,5]]]]})")));
  ASSERT_EQ(r.plan.footprints.size(), 2u);
  EXPECT_EQ(r.plan.footprints[0].name, "x_1");
  EXPECT_EQ(r.plan.footprints[1].name, "x_2");
  EXPECT_EQ(r.plan.footprints[1].height_m, 5);
}

// Heights of coordinates: the ground where no attribute says so, and the roof above a ground that is known.
TEST(Footprints, HeightsOfCoordinates) {
  const std::string ring = polygon("[[0,0,20],[4,0,20],[4,3,21],[0,0,20]]");
  const Footprint ground = read("a.geojson", geojson(feature(R"("height":5)", ring))).plan.footprints[0];
  EXPECT_EQ(ground.ground, 20);
  EXPECT_EQ(ground.height_m, 5);
  const Footprint roof = read("a.geojson", geojson(feature(R"("ground_h":12.5)", ring))).plan.footprints[0];
  EXPECT_EQ(roof.ground, 12.5);
  EXPECT_EQ(roof.height_m, 8.5);
}

TEST(Footprints, UsualNamesOfAttributes) {
  const auto with = [](const std::string& properties, const ImportOptions& options = {}) {
    return read("a.geojson", geojson(feature(properties, square)), options).plan.footprints[0];
  };
  for (const char* name :
       {"height", "HEIGHT", "HAUTEUR", "measuredHeight", "Building_H", "building:height", "Height_m"})
    EXPECT_EQ(with("\"" + std::string(name) + "\":7.25").height_m, 7.25) << name;
  EXPECT_EQ(with(R"("height":"7.25 m")").height_m, 7.25);
  for (const char* text : {"\"tall\"", "null", "-3", "0", "\"7 ft\"", "\"\"", "\"nan\"", "1e400"})
    EXPECT_FALSE(with(R"("height":)" + std::string(text)).height_m) << text;
  EXPECT_EQ(with(R"("roof_h":20.5,"ground_h":8)").height_m, 12.5);
  for (const char* name : {"NB_ETAGES", "numberOfFloors", "building:levels", "storeysAboveGround", "floors"})
    EXPECT_EQ(with("\"" + std::string(name) + "\":4").floors, 4) << name;
  EXPECT_EQ(with(R"("numberOfFloors":{"value":2,"source":"x"})").floors, 2);
  for (const char* text : {"-1", "1e9", "\"many\"", "null"})
    EXPECT_FALSE(with(R"("floors":)" + std::string(text)).floors) << text;
  ImportOptions options;
  options.height_field = "h";
  options.floors_field = "n";
  const Footprint named = with(R"("h":3.5,"n":2,"height":9,"floors":9)", options);
  EXPECT_EQ(named.height_m, 3.5);
  EXPECT_EQ(named.floors, 2);
  EXPECT_EQ(refusal(in_memory("a.geojson", geojson(feature(R"("H":3,"n":1)", square))), options),
            "a.geojson: attributes: there is no 'h' among H, n; give one of these");
}

TEST(Footprints, FloorsOfLayers) {
  EXPECT_EQ(floors_of_layer("BATI_ETAGES_7"), 7);
  EXPECT_EQ(floors_of_layer("bati_Floors_12"), 12);
  EXPECT_EQ(floors_of_layer("BINA_KAT_3"), 3);
  for (const char* layer :
       {"BATI_ETAGES_NA", "BATI_ETAGES_", "BATI_7", "7", "", "BATI_ETAGES_1234", "ETAGES_7x"})
    EXPECT_FALSE(floors_of_layer(layer)) << layer;
}

// A bow tie is two triangles, a spike goes, and what has no area is dropped.
TEST(Footprints, CrossingRingsAreMended) {
  const Read r =
      read("a.geojson",
           geojson(feature(R"("id":"tie")", polygon("[[0,0],[4,4],[4,0],[0,4],[0,0]]")) + "," +
                   feature(R"("id":"spike")", polygon("[[0,0],[9,0],[4,0],[4,4],[0,4],[0,0]]")) + "," +
                   feature(R"("id":"line")", polygon("[[0,0],[9,0],[4,0],[0,0]]")) + "," +
                   feature(R"("id":"repeats")", polygon("[[0,0],[0,0],[4,0],[4,0],[4,4],[0,0],[0,0]]"))));
  ASSERT_EQ(r.plan.footprints.size(), 4u);
  EXPECT_EQ(signed_area(r.plan.footprints[0].rings[0]), 4);
  EXPECT_EQ(signed_area(r.plan.footprints[1].rings[0]), 4);
  EXPECT_EQ(r.plan.footprints[1].name, "tie_2");
  EXPECT_EQ(signed_area(r.plan.footprints[2].rings[0]), 16);
  EXPECT_EQ(r.plan.footprints[3].rings, (Rings{{{0, 0}, {4, 0}, {4, 4}}}));
  EXPECT_EQ(r.dropped("crossing or touching rings of a footprint, mended"), 3u);
  EXPECT_EQ(r.dropped("footprint without area"), 1u);
  expect_consistent(r.plan);
}

TEST(Footprints, GeometriesWithoutAreaAreCounted) {
  const Read r = read(
      "a.geojson",
      geojson(
          feature("", square) + "," + feature("", R"({"type":"Point","coordinates":[1,2]})") + "," +
          feature("", "null") + "," +
          feature(
              "",
              R"({"type":"GeometryCollection","geometries":[{"type":"LineString","coordinates":[[0,0],[1,1]]},)" +
                  square + "]}")));
  EXPECT_EQ(r.plan.footprints.size(), 2u);
  EXPECT_EQ(r.dropped("geometry without area in a plan (Point)"), 1u);
  EXPECT_EQ(r.dropped("geometry without area in a plan (Line String)"), 1u);
  EXPECT_EQ(r.dropped("feature without a geometry"), 1u);
}

TEST(Footprints, GeoJsonWithoutACrsIsInDegreesIfItCanBe) {
  EXPECT_EQ(read("a.geojson", geojson(feature("", square), "")).plan.crs, "EPSG:4326");
  EXPECT_EQ(read("a.geojson", geojson(feature("", polygon("[[1e6,5e6],[1e6,6e6],[2e6,5e6],[1e6,5e6]]")), ""))
                .plan.crs,
            "");
  EXPECT_EQ(read("a.geojson", geojson(feature("", square), "EPSG:28992")).plan.crs, "EPSG:28992");
}

std::string groups(const std::string& words) {
  std::string text = words + " ";
  std::replace(text.begin(), text.end(), ' ', '\n');
  return text;
}
std::string line(const std::string& layer, double x0, double y0, double x1, double y1) {
  const std::string a = std::to_string(x0), b = std::to_string(y0), c = std::to_string(x1),
                    d = std::to_string(y1);
  return " 0 LWPOLYLINE 8 " + layer + " 90 4 70 1 10 " + a + " 20 " + b + " 10 " + c + " 20 " + b + " 10 " +
         c + " 20 " + d + " 10 " + a + " 20 " + d;
}
std::string dxf(const std::string& entities, const std::string& unit = "0") {
  return groups("0 SECTION 2 HEADER 9 $ACADVER 1 AC1015 9 $INSUNITS 70 " + unit +
                " 0 ENDSEC 0 SECTION 2 ENTITIES" + entities + " 0 ENDSEC 0 EOF");
}

// A block of 20 m with a courtyard of 10 m, in which stands a house; then a neighbour, on a layer without
// floors.
TEST(Footprints, DxfLinesAreNestedByLayer) {
  const Read r = read("a.dxf", dxf(line("B_FLOORS_4", 0, 0, 20, 20) + line("B_FLOORS_4", 5, 5, 15, 15) +
                                   line("B_FLOORS_4", 7, 7, 9, 9) + line("B_FLOORS_2", 10, 10, 12, 12) +
                                   line("B", 20, 0, 30, 10)));
  EXPECT_EQ(r.plan.format, "DXF");
  EXPECT_EQ(r.plan.crs, "");
  ASSERT_EQ(r.plan.footprints.size(), 4u);
  EXPECT_EQ(r.plan.footprints[0].rings,
            (Rings{{{0, 0}, {20, 0}, {20, 20}, {0, 20}}, {{5, 15}, {15, 15}, {15, 5}, {5, 5}}}));
  EXPECT_EQ(r.plan.footprints[0].floors, 4);
  EXPECT_EQ(r.plan.footprints[1].rings, (Rings{{{7, 7}, {9, 7}, {9, 9}, {7, 9}}}));
  EXPECT_EQ(r.plan.footprints[2].floors, 2);
  EXPECT_FALSE(r.plan.footprints[3].floors);
  EXPECT_FALSE(r.plan.footprints[0].ground);
  EXPECT_TRUE(r.report.dropped.empty());
}

TEST(Footprints, NestedRings) {
  const auto box = [](double x0, double y0, double x1, double y1) {
    return FlatRing{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
  };
  using Polygons = std::vector<std::vector<size_t>>;
  const auto nested = [](const std::vector<FlatRing>& rings) { return nest_rings(rings, "a.dxf: layer b"); };
  EXPECT_EQ(nested({}), Polygons{});
  // The order in the file does not matter.
  EXPECT_EQ(nested({box(2, 2, 3, 3), box(0, 0, 9, 9), box(1, 1, 8, 8)}), (Polygons{{0}, {1, 2}}));
  // A house that fills the courtyard: of equal rings the hole is the first one after its outline. Equal
  // outlines are two buildings.
  EXPECT_EQ(nested({box(0, 0, 9, 9), box(1, 1, 8, 8), box(1, 1, 8, 8)}), (Polygons{{0, 1}, {2}}));
  EXPECT_EQ(nested({box(0, 0, 9, 9), box(0, 0, 9, 9)}), (Polygons{{0}, {1}}));
  EXPECT_EQ(nested({box(1, 1, 8, 8), box(0, 0, 9, 9), box(1, 1, 8, 8)}), (Polygons{{0}, {1, 2}}));
  // Overlapping in part, touching, and sticking out by rounding.
  EXPECT_EQ(nested({box(0, 0, 9, 9), box(5, 5, 12, 12)}), (Polygons{{0}, {1}}));
  EXPECT_EQ(nested({box(0, 0, 9, 9), box(9, 0, 12, 9)}), (Polygons{{0}, {1}}));
  EXPECT_EQ(nested({box(0, 0, 9, 9), box(1, 1, 8, 8), box(1 - 1e-9, 2, 8 + 1e-9, 4)}),
            (Polygons{{0, 1}, {2}}));
  // A ring that crosses itself neither holds nor is held, nor stops the others.
  EXPECT_EQ(nested({{{0, 0}, {0, 0}, {0, 0}}, box(0, 0, 9, 9), box(1, 1, 2, 2)}), (Polygons{{0}, {1, 2}}));
  // Contour lines: each in each other.
  std::vector<FlatRing> contours;
  for (int i = 0; i < 600; ++i) contours.push_back(box(-10 - i, -10 - i, 10 + i, 10 + i));
  try {
    nested(contours);
    ADD_FAILURE() << "600 rings in one another were compared";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::bad_input);
    EXPECT_TRUE(std::string(error.what()).starts_with("a.dxf: layer b: its closed lines")) << error.what();
  }
}

TEST(Footprints, DxfHatchesAndWhatIsNoOutline) {
  const std::string hatch =
      " 0 HATCH 5 H1 8 B_KAT_3 100 AcDbHatch 10 0 20 0 30 209.7 210 0 220 0 230 1 2 SOLID 70 1 71 0 91 2"
      " 92 2 72 0 73 1 93 4 10 0 20 0 10 9 20 0 10 9 20 9 10 0 20 9 97 0"
      " 92 2 72 0 73 1 93 3 10 2 20 2 10 4 20 2 10 4 20 4 97 0 75 0 76 1 98 0";
  const Read r = read(
      "a.dxf", dxf(hatch + " 0 LINE 8 A 10 0 20 0 11 1 21 1 0 LWPOLYLINE 8 A 90 2 70 0 10 0 20 0 10 1 20 1" +
                   line("road", 0, 0, 5, 5)));
  ASSERT_EQ(r.plan.footprints.size(), 1u);
  EXPECT_EQ(r.plan.footprints[0].floors, 3);
  EXPECT_EQ(r.plan.footprints[0].place, "a.dxf: entity H1");
  ASSERT_EQ(r.plan.footprints[0].rings.size(), 2u);
  EXPECT_EQ(signed_area(r.plan.footprints[0].rings[0]), 81);
  EXPECT_EQ(signed_area(r.plan.footprints[0].rings[1]), -2);
  EXPECT_EQ(r.dropped("open line in a plan"), 2u);
  EXPECT_EQ(r.dropped("drawn on a layer that is not of buildings"), 1u);
  const Read both = read("a.dxf", dxf(hatch + line("B_KAT_3", 20, 20, 25, 25)));
  EXPECT_EQ(both.plan.footprints.size(), 1u);
  EXPECT_EQ(both.dropped("hatch on a layer that has outlines"), 1u);
}

TEST(Footprints, DxfUnits) {
  const std::string reason = "$INSUNITS that makes buildings smaller than 1 m2, taken as metres";
  EXPECT_EQ(read("a.dxf", dxf(line("B", 0, 0, 9000, 8000), "4")).plan.unit_m, 0.001);
  EXPECT_EQ(read("a.dxf", dxf(line("B", 0, 0, 900, 800), "1")).plan.unit_m, 0.0254);
  const Read template_of_inches = read("a.dxf", dxf(line("B", 0, 0, 9, 8), "1"));
  EXPECT_EQ(template_of_inches.plan.unit_m, 1);
  EXPECT_EQ(template_of_inches.dropped(reason), 1u);
  ImportOptions options;
  options.unit_m = 0.0254;
  EXPECT_EQ(read("a.dxf", dxf(line("B", 0, 0, 9, 8), "1"), options).plan.unit_m, 0.0254);
}

TEST(Footprints, CityJson) {
  const std::string content =
      cityjson(object("a", "Building", geometry("Solid", "[" + cube_faces + "]")) + "," +
                   object("b", "Building", geometry("MultiSurface", "[[0,1,2,3]]", "\"0\""),
                          R"("attributes":{"measuredHeight":6.5,"storeysAboveGround":2},)"),
               cube_vertices);
  const Read r = read("a.json", content);
  EXPECT_EQ(r.plan.format, "CityJSON 2.0");
  EXPECT_EQ(r.plan.crs, "EPSG:7415");
  ASSERT_EQ(r.plan.footprints.size(), 2u);
  for (const Footprint& footprint : r.plan.footprints) {
    ASSERT_EQ(footprint.rings.size(), 1u);
    EXPECT_NEAR(signed_area(footprint.rings[0]), 100, 1e-6);
    EXPECT_NEAR(footprint.ground.value(), 2.463, 1e-9);
  }
  EXPECT_EQ(r.plan.footprints[0].name, "a");
  EXPECT_NEAR(r.plan.footprints[0].height_m.value(), 10, 1e-9);
  EXPECT_FALSE(r.plan.footprints[0].floors);
  EXPECT_EQ(r.plan.footprints[1].height_m, 6.5);
  EXPECT_EQ(r.plan.footprints[1].floors, 2);
}

const std::filesystem::path examples = std::filesystem::path(VEDUTA_TEST_DATA) / "formats";

TEST(Footprints, OnePlanInThreeFormats) {
  const Read json = read(examples / "plan.geojson"), shape = read(examples / "plan.shp"),
             drawing = read(examples / "plan.dxf");
  EXPECT_EQ(shape.plan.format, "ESRI Shapefile");
  ASSERT_EQ(json.plan.footprints.size(), 8u);
  EXPECT_EQ(json.plan.crs, "EPSG:3946");
  EXPECT_EQ(shape.plan.crs, "EPSG:3946");
  expect_same_rings(json.plan, shape.plan, 0);
  expect_same_rings(json.plan, drawing.plan, 0);
  for (size_t i = 0; i < 8; ++i) {
    const Footprint &a = json.plan.footprints[i], &b = shape.plan.footprints[i],
                    &c = drawing.plan.footprints[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.floors, b.floors);
    EXPECT_EQ(a.floors, c.floors);
    EXPECT_EQ(a.height_m, b.height_m);
    EXPECT_EQ(b.ground, 170);
  }
}

class LyonPlan : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(folder_)) GTEST_SKIP() << folder_ << " is missing";
  }
  const std::filesystem::path folder_ = std::filesystem::path(VEDUTA_SHARED_DATA) / "lyon_plan";
};

// GeoJSON holds heights, ground and floors. GDAL wrote the DXFs with 15 digits: the floors in the layers of
// the LWPOLYLINEs, the roof's height as elevation of the others; holes as lines of their own except in
// hatches.
TEST_F(LyonPlan, IsTheSameInFourFiles) {
  const Read json = read(folder_ / "buildings_lyon1.geojson");
  const auto count = [](const Footprints& plan, auto&& has) {
    return std::count_if(plan.footprints.begin(), plan.footprints.end(), has);
  };
  const auto has_floors = [](const Footprint& f) { return f.floors.has_value(); };
  ASSERT_EQ(json.plan.footprints.size(), 2576u);
  EXPECT_TRUE(json.report.dropped.empty());
  EXPECT_EQ(count(json.plan, has_floors), 1767);
  EXPECT_EQ(count(json.plan, [](const Footprint& f) { return f.height_m && f.ground; }), 2576);
  expect_consistent(json.plan);
  for (const char* name : {"lyon1_floors_lwpolyline.dxf", "lyon1_hatch.dxf", "lyon1_roof_polyline3d.dxf"}) {
    const Read drawing = read(folder_ / name);
    expect_same_rings(json.plan, drawing.plan, 1e-7);
    EXPECT_EQ(drawing.plan.unit_m, 1) << name;
    EXPECT_EQ(drawing.report.dropped.size(), 1u) << name;  // its inches
    EXPECT_EQ(count(drawing.plan, [](const Footprint& f) { return f.height_m || f.ground; }), 0) << name;
  }
  const Read floors = read(folder_ / "lyon1_floors_lwpolyline.dxf");
  ASSERT_EQ(floors.plan.footprints.size(), 2576u);
  for (size_t i = 0; i < 2576; ++i)
    EXPECT_EQ(json.plan.footprints[i].floors, floors.plan.footprints[i].floors) << i;
}

TEST(FootprintsBadInput, OneLineEach) {
  const std::string good = geojson(feature("", square));
  const std::pair<InputFile, std::string> table[] = {
      {in_memory("a.geojson", good.substr(0, good.size() - 5)), "whole file: GDAL says"},
      {in_memory("a.geojson", "{"), "whole file: GDAL"},
      {in_memory("a.geojson", "[]"), "line 1: this is no GeoJSON"},
      {in_memory("a.geojson", "{}"), "whole file: GDAL"},
      {in_memory("a.geojson", "{\"type\":\"FeatureCollection\",\"features\":" + std::string(100000, '[')),
       "whole file: GDAL"},
      {in_memory("a.geojson", geojson("")), "whole file: holds no closed outline"},
      {in_memory("a.geojson", geojson(feature("", polygon("")))), "whole file: holds no closed outline"},
      {in_memory("a.geojson", geojson(feature("", polygon("[[0,0],[1e999,0],[1,1],[0,0]]")))),
       "features/0: a coordinate is not"},
      {in_memory("a.geojson", geojson(feature("", polygon("[[0,0,1],[3,0,1e999],[1,1,1],[0,0,1]]")))),
       "features/0: a coordinate is not"},
      {in_memory("a.json", cityjson("", "[]")), "whole file: holds no closed outline"},
      {in_memory("a.shp", "nothing of the kind"), "byte 0: this is no Shapefile"},
      {in_memory("a.shp", std::string("\0\0\x27\x0a", 4)), "a.shx: is missing beside the .shp"},
      {in_memory("a.dxf", "nothing of the kind"), "line 1: 'nothing of the kind' does not begin"},
      {in_memory("a.dxf", "AutoCAD Binary DXF\r\n"), "line 1: is binary DXF"},
      {in_memory("a.dxf", dxf(line("B", 0, 0, 9, 9)).substr(0, 200)), "line "},
      {in_memory("a.dxf", dxf(line("B", 0, 0, 9, 9), "77")), "HEADER: $INSUNITS"},
      {in_memory("a.dxf", dxf(" 0 LINE 8 A 10 0 20 0 11 1 21 1")), "whole file: holds no closed outline"},
      {in_memory("a.dxf", dxf(" 0 INSERT 2 B 70 32767 71 32767")), "INSERT: asks for 32767 rows"},
  };
  testing::internal::CaptureStderr();
  for (const auto& [file, place] : table) {
    const std::string what = refusal(file);
    EXPECT_TRUE(what.starts_with(file.name + ": " + place)) << what << "\nis not at " << place;
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

// GDAL does not open a drawing with a block in itself.
TEST(FootprintsBadInput, BlocksInThemselves) {
  const std::string content = groups(
      "0 SECTION 2 BLOCKS 0 BLOCK 2 A 70 0 10 0 20 0 30 0 0 INSERT 2 A 10 1 20 0 0 ENDBLK 0 ENDSEC 0 SECTION "
      "2 ENTITIES 0 INSERT 2 A 10 0 20 0" +
      line("B", 0, 0, 9, 9) + " 0 ENDSEC 0 EOF");
  EXPECT_TRUE(refusal(in_memory("a.dxf", content)).starts_with("a.dxf: whole file: GDAL finds nothing"));
}

class FootprintFiles : public TemporaryModels {
 protected:
  // A changed file, with its siblings as they are.
  void try_it(const std::string& name, const std::string& changed_name, const std::string& content) {
    std::vector<const char*> siblings{".shp", ".shx", ".dbf"};
    if (changed_name == "plan.prj") siblings.push_back(".prj");  // PROJ looks long for a CRS
    for (const char* sibling : siblings) {
      std::filesystem::copy_file(examples / (std::string("plan") + sibling),
                                 directory_ / (std::string("plan") + sibling),
                                 std::filesystem::copy_options::overwrite_existing);
    }
    const std::filesystem::path path = directory_ / name;
    write(changed_name, content);
    try {
      ImportReport report;
      expect_consistent(read_footprints(read_input(path), beside(path), {}, report));
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::bad_input) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  }
};

// Cut and changed bytes of every file of the example: an error or a plan, never a crash, and nothing on
// stderr.
TEST_F(FootprintFiles, CutAndChangedFilesNeverCrash) {
  const std::pair<const char*, const char*> table[] = {
      {"plan.geojson", "plan.geojson"}, {"plan.dxf", "plan.dxf"}, {"plan.shp", "plan.shp"},
      {"plan.shp", "plan.shx"},         {"plan.shp", "plan.dbf"}, {"plan.shp", "plan.prj"}};
  testing::internal::CaptureStderr();
  for (const auto& [name, changed_name] : table) {
    const std::string good(read_input(examples / changed_name).content());
    const size_t rounds = std::string(changed_name) == "plan.prj" ? 6 : 300;
    for (size_t length = 1; length < good.size(); length += 1 + 6 * good.size() / rounds)
      try_it(name, changed_name, good.substr(0, length));
    uint32_t state = 1;
    for (size_t round = 0; round < rounds; ++round) {
      std::string changed = good;
      state = state * 1664525u + 1013904223u;
      changed[(state >> 8) % changed.size()] = static_cast<char>(state >> 24);
      try_it(name, changed_name, changed);
    }
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace veduta
