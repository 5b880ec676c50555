#include "scene/readers/citygml.h"

#include <algorithm>
#include <glm/vec4.hpp>
#include <optional>

#include "scene/assemble.h"
#include "scene/error.h"
#include "scene/readers/cityjson.h"
#include "temporary_models.h"

namespace veduta {
namespace {

InputFile in_memory(const std::string& content, const std::string& extension = ".gml") {
  return {"city" + extension, "city", extension, content + std::string(InputFile::padding, '\0')};
}

struct Read {
  ImportReport report;
  RawModel model;
};

Read read(const std::string& content) {
  Read result;
  result.model = read_citygml(in_memory(content), result.report);
  return result;
}

ImportResult assembled(const Read& read) {
  return assemble({read.model}, {}, read.report);
}

/// A CityGML 2.0 file.
std::string city(const std::string& members, const std::string& srs_name = "EPSG:25833") {
  return R"(<?xml version="1.0"?>
<c:CityModel xmlns:c="http://www.opengis.net/citygml/2.0" xmlns:b="http://www.opengis.net/citygml/building/2.0"
 xmlns:brid="http://www.opengis.net/citygml/bridge/2.0" xmlns:dem="http://www.opengis.net/citygml/relief/2.0"
 xmlns:veg="http://www.opengis.net/citygml/vegetation/2.0" xmlns:frn="http://www.opengis.net/citygml/cityfurniture/2.0"
 xmlns:gml="http://www.opengis.net/gml" xmlns:xlink="http://www.w3.org/1999/xlink" xmlns:ade="http://example.org/ade">
<gml:boundedBy><gml:Envelope srsName=")" +
         srs_name + R"("/></gml:boundedBy>
)" + members +
         "</c:CityModel>\n";
}
std::string member(const std::string& feature) {
  return "<c:cityObjectMember>" + feature + "</c:cityObjectMember>\n";
}
std::string building(const std::string& id, const std::string& content) {
  return member("<b:Building gml:id=\"" + id + "\">" + content + "</b:Building>");
}
std::string multi_surface(const std::string& lod, const std::string& polygons) {
  return "<b:lod" + lod + "MultiSurface><gml:MultiSurface>" + polygons + "</gml:MultiSurface></b:lod" + lod +
         "MultiSurface>";
}
std::string bounded(const std::string& type, const std::string& polygon) {
  return "<b:boundedBy><b:" + type + ">" + multi_surface("2", polygon) + "</b:" + type + "></b:boundedBy>";
}
std::string solid(const std::string& members, const std::string& lod = "2") {
  return "<b:lod" + lod + "Solid><gml:Solid><gml:exterior><gml:CompositeSurface>" + members +
         "</gml:CompositeSurface></gml:exterior></gml:Solid></b:lod" + lod + "Solid>";
}
std::string reference(const std::string& id) {
  return "<gml:surfaceMember xlink:href=\"#" + id + "\"/>";
}

/// A face of the 10 m cube of cube_vertices.
std::string face(const std::string& indices, const std::string& id = "") {
  std::string list;
  const std::string closed = indices + indices[0];
  for (const char c : closed) {
    const int i = c - '0';
    list += i == 1 || i == 2 || i == 5 || i == 6 ? "78258.66 " : "78248.66 ";
    list += i == 2 || i == 3 || i == 6 || i == 7 ? "457614.591 " : "457604.591 ";
    list += i >= 4 ? "12.463 " : "2.463 ";
  }
  return "<gml:surfaceMember><gml:Polygon" + (id.empty() ? "" : " gml:id=\"" + id + "\"") +
         "><gml:exterior><gml:LinearRing><gml:posList>" + list +
         "</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>";
}
const std::array<std::string, 6> faces{"0321", "4567", "0154", "1265", "2376", "3047"};
std::string cube() {
  std::string all;
  for (const std::string& indices : faces) all += face(indices);
  return all;
}

TEST(CityGml, TheSameCityInBothFormatsIsTheSameScene) {
  const char* const themes[] = {"GroundSurface", "RoofSurface",  "WallSurface",
                                "WallSurface",   "FloorSurface", "ClosureSurface"};
  std::string references, boundary;
  for (size_t i = 0; i < 6; ++i) {
    references += reference("p" + std::to_string(i));
    boundary += bounded(themes[i], face(faces[i], "p" + std::to_string(i)));
  }
  const std::string part = "<b:consistsOfBuildingPart><b:BuildingPart gml:id=\"a.1\">" +
                           solid(face("4567"), "2") + "</b:BuildingPart></b:consistsOfBuildingPart>";
  const Read gml = read(city(building("a", solid(references) + boundary + part), "EPSG:7415"));
  const std::string semantics =
      R"(,"semantics":{"surfaces":[{"type":"GroundSurface"},{"type":"RoofSurface"},{"type":"WallSurface"},)"
      R"({"type":"FloorSurface"},{"type":"ClosureSurface"}],"values":[[0,1,2,2,3,4]]})";
  const std::string json = cityjson(
      object("a", "Building", geometry("Solid", "[" + cube_faces + "]", "\"2\"", semantics)) + "," +
          object("a.1", "BuildingPart", geometry("MultiSurface", "[[4,5,6,7]]"), R"("parents":["a"],)"),
      cube_vertices);
  Read same;
  same.model = read_cityjson(in_memory(json, ".json"), same.report);
  const ImportResult a = assembled(gml), b = assembled(same);
  EXPECT_EQ(gml.model.format, "CityGML 2.0");
  EXPECT_EQ(a.scene.crs, "EPSG:7415");
  EXPECT_EQ(a.scene.crs, b.scene.crs);
  EXPECT_EQ(a.scene.origin, b.scene.origin);
  ASSERT_EQ(a.scene.triangles.size(), 10u);  // the part's roof is there already
  ASSERT_EQ(a.scene.triangles.size(), b.scene.triangles.size());
  EXPECT_EQ(a.scene.material, b.scene.material);
  for (size_t i = 0; i < a.scene.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k)
      EXPECT_LT(
          glm::length(a.scene.vertices[a.scene.triangles[i][k]] - b.scene.vertices[b.scene.triangles[i][k]]),
          1e-5f);
  ASSERT_EQ(a.scene.objects.size(), 1u);
  EXPECT_EQ(a.scene.objects[0].name, "a");
  EXPECT_EQ(a.scene.objects[0].kind, Kind::building);
  const std::string closure = "ClosureSurface, which stands for an opening";
  EXPECT_EQ(a.report.dropped.at(closure).count, 1u);
  EXPECT_EQ(b.report.dropped.at(closure).count, 1u);
  EXPECT_EQ(a.report.dropped.size(), b.report.dropped.size());
}

TEST(CityGml, CoordinatesKeepTheirDoubles) {
  const Read result = read(city(building("a", solid(face("0321")))));
  EXPECT_EQ(result.model.vertices.at(0), glm::dvec3(78248.66, 457604.591, 2.463));
  EXPECT_EQ(result.model.ring_vertex.size(), 4u);  // the closing point is not a corner
  EXPECT_EQ(result.model.polygons.at(0).line, 7u);
}

TEST(CityGml, EveryWayToWriteASurface) {
  const std::string ring =
      "<gml:LinearRing><gml:pos>0 0 0</gml:pos><gml:pos>4 0 0</gml:pos><gml:pos>4 4 0</gml:pos>"
      "<gml:pos>0 4 0</gml:pos><gml:pos>0 0 0</gml:pos></gml:LinearRing>";
  const std::string exterior = "<gml:exterior>" + ring + "</gml:exterior>";
  const std::string polygon = "<gml:Polygon>" + exterior + "</gml:Polygon>";
  const std::string table[] = {
      polygon,
      "<gml:Polygon><gml:exterior><gml:LinearRing><gml:coordinates>0,0,0 4,0,0 4,4,0 0,4,0 0,0,0"
      "</gml:coordinates></gml:LinearRing></gml:exterior></gml:Polygon>",
      "<gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>0 0 0 4 0 0 <!-- half --> 4.0e0 +4 -0 0 4 0"
      "</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon>",
      "<gml:Polygon><gml:exterior><gml:Ring><gml:curveMember><gml:LineString><gml:posList>0 0 0 4 0 0 4 4 0"
      "</gml:posList></gml:LineString></gml:curveMember><gml:curveMember><gml:LineString><gml:posList>4 4 0 "
      "0 4 0 0 0 0</gml:posList></gml:LineString></gml:curveMember></gml:Ring></gml:exterior></gml:Polygon>",
      "<gml:Surface><gml:patches><gml:PolygonPatch>" + exterior +
          "</gml:PolygonPatch></gml:patches></gml:Surface>",
      "<gml:OrientableSurface><gml:baseSurface>" + polygon + "</gml:baseSurface></gml:OrientableSurface>",
      "<gml:MultiSurface><gml:surfaceMembers>" + polygon + "</gml:surfaceMembers></gml:MultiSurface>",
      "<gml:MultiSolid><gml:solidMember><gml:Solid><gml:exterior><gml:CompositeSurface><gml:surfaceMember>" +
          polygon +
          "</gml:surfaceMember></gml:CompositeSurface></gml:exterior></gml:Solid></gml:solidMember></"
          "gml:MultiSolid>",
      "<gml:TriangulatedSurface><gml:trianglePatches><gml:Triangle><gml:exterior><gml:LinearRing><gml:"
      "posList>"
      "0 0 0 4 0 0 4 4 0 0 0 0</gml:posList></gml:LinearRing></gml:exterior></gml:Triangle><gml:Triangle>"
      "<gml:exterior><gml:LinearRing><gml:posList>0 0 0 4 4 0 0 4 0 0 0 0</gml:posList></gml:LinearRing>"
      "</gml:exterior></gml:Triangle></gml:trianglePatches></gml:TriangulatedSurface>",
      "<gml:Tin><gml:controlPoint><gml:posList>0 0 0 4 0 0 4 4 0 0 4 "
      "0</gml:posList></gml:controlPoint></gml:Tin>",
  };
  for (const std::string& surface : table) {
    const Read result = read(city(building("a", "<b:lod2Geometry>" + surface + "</b:lod2Geometry>")));
    const ImportResult scene = assembled(result);
    EXPECT_NEAR(area_m2(scene.scene), 16, 1e-9) << surface;
    EXPECT_TRUE(scene.report.dropped.empty()) << surface;
    EXPECT_EQ(scene.scene.material[0], Material::roof) << surface;  // all face up
  }
  const Read turned =
      read(city(building("a", "<b:lod2Geometry><gml:OrientableSurface orientation=\"-\"><gml:baseSurface>" +
                                  polygon + "</gml:baseSurface></gml:OrientableSurface></b:lod2Geometry>")));
  EXPECT_EQ(assembled(turned).scene.material[0], Material::ground);
}

TEST(CityGml, HolesStayOpenWhateverTheOrder) {
  const auto ring = [](const char* tag, const char* list) {
    return std::string("<gml:") + tag + "><gml:LinearRing><gml:posList>" + list +
           "</gml:posList></gml:LinearRing></gml:" + tag + ">";
  };
  const std::string outer = ring("exterior", "0 0 0 10 0 0 10 10 0 0 10 0 0 0 0"),
                    inner = ring("interior", "4 4 0 4 6 0 6 6 0 6 4 0 4 4 0");
  for (const std::string& rings : {outer + inner, inner + outer}) {
    const Read result =
        read(city(building("a", multi_surface("2", "<gml:surfaceMember><gml:Polygon>" + rings +
                                                       "</gml:Polygon></gml:surfaceMember>"))));
    EXPECT_NEAR(area_m2(assembled(result).scene), 96, 1e-9);
  }
  const Read without =
      read(city(building("a", multi_surface("2", face("4567") + "<gml:surfaceMember><gml:Polygon>" + inner +
                                                     "</gml:Polygon></gml:surfaceMember>"))));
  EXPECT_EQ(without.model.polygons.size(), 1u);
  EXPECT_EQ(without.model.ring_vertex.size(), 4u);
  EXPECT_EQ(without.report.dropped.at("polygon without an outline in three dimensions").count, 1u);
}

TEST(CityGml, SharedSurfacesCountOnceAndLostOnesAreReported) {
  const std::string boundary = bounded("WallSurface", face("0154", "w"));
  for (const std::string& content :
       {solid(reference("w")) + boundary, boundary + solid(reference("w")),
        solid(face("0154", "w")) + bounded("WallSurface", reference("w")),
        solid("<gml:surfaceMember><gml:OrientableSurface orientation=\"-\"><gml:baseSurface "
              "xlink:href=\"#w\"/></gml:OrientableSurface></gml:surfaceMember>") +
            boundary}) {
    const Read result = read(city(building("a", content)));
    ASSERT_EQ(result.model.polygons.size(), 1u) << content;
    EXPECT_EQ(result.model.polygons[0].material, Material::wall);
    EXPECT_TRUE(result.report.dropped.empty());
  }
  // Another object's wall is its own as well.
  const Read twice =
      read(city(building("a", solid(face("0154", "w"))) + building("b", solid(reference("w")))));
  EXPECT_EQ(twice.model.polygons.size(), 2u);
  const Read lost =
      read(city(building("a", solid(cube() + reference("nowhere")) +
                                  "<b:lod2MultiSurface xlink:href=\"http://x.org/y.gml#z\"/>")));
  EXPECT_EQ(lost.report.dropped.at("reference to a surface that is not in the file").count, 2u);
  EXPECT_EQ(lost.model.polygons.size(), 6u);
}

TEST(CityGml, ReferencesInCirclesAndBombsEnd) {
  std::string bomb;
  for (int i = 0; i < 60; ++i)
    bomb += "<gml:surfaceMember><gml:CompositeSurface gml:id=\"s" + std::to_string(i) + "\">" +
            reference("s" + std::to_string(i + 1)) + reference("s" + std::to_string(i + 1)) +
            reference("s0") + "</gml:CompositeSurface></gml:surfaceMember>";
  const Read result = read(city(building("a", solid(bomb + face("4567", "s60")))));
  EXPECT_EQ(result.model.polygons.size(), 1u);
}

TEST(CityGml, PartsLevelsAndOpenings) {
  const std::string content =
      "<b:lod1Solid><gml:Solid><gml:exterior><gml:CompositeSurface>" + face("0321") +
      "</gml:CompositeSurface></gml:exterior></gml:Solid></b:lod1Solid>"
      "<b:lod2TerrainIntersection><gml:MultiCurve/></b:lod2TerrainIntersection>"
      "<b:boundedBy><b:WallSurface>" +
      multi_surface("2", face("0321")) + multi_surface("3", face("0154")) + "<b:opening><b:Window>" +
      multi_surface("3", face("1265")) + "</b:Window></b:opening><b:opening><b:Door>" +
      multi_surface("3", face("2376")) + "</b:Door></b:opening></b:WallSurface></b:boundedBy>" +
      "<b:outerBuildingInstallation><b:BuildingInstallation gml:id=\"stair\"><b:lod2Geometry>"
      "<gml:MultiSurface>" +
      face("3047") +
      "</gml:MultiSurface></b:lod2Geometry></b:BuildingInstallation></b:outerBuildingInstallation>";
  const Read result = read(city(building("a", content)));
  ASSERT_EQ(result.model.objects.size(), 1u);
  const RawObject& object = result.model.objects[0];
  ASSERT_EQ(object.patches.size(), 2u);
  EXPECT_EQ(object.patches[1].part, "stair");
  ASSERT_EQ(result.model.polygons.size(), 4u);
  EXPECT_EQ(result.model.polygons[0].material, Material::wall);
  EXPECT_EQ(result.model.polygons[1].material, Material::window);
  EXPECT_EQ(result.model.polygons[2].material, Material::door);
  EXPECT_EQ(result.report.dropped.at("LoD 1 beside LoD 3").count, 1u);
  EXPECT_EQ(result.report.dropped.at("LoD 2 beside LoD 3").count, 1u);
  EXPECT_EQ(result.report.dropped.at("unsupported geometry MultiCurve").count, 1u);
  const Read footprint = read(city(building(
      "b", multi_surface("0", face("0321")) + "<b:consistsOfBuildingPart><b:BuildingPart gml:id=\"b.1\">" +
               solid(face("4567")) + "</b:BuildingPart></b:consistsOfBuildingPart>")));
  EXPECT_EQ(footprint.model.polygons.size(), 1u);
  EXPECT_EQ(footprint.report.dropped.at("LoD 0 beside LoD 2 of the parts").count, 1u);
}

TEST(CityGml, KindsNamesAndExtensions) {
  const std::string surface =
      "<c:lod2Geometry><gml:MultiSurface>" + face("4567") + "</gml:MultiSurface></c:lod2Geometry>";
  const std::string tin =
      "<dem:TINRelief><dem:lod>2</dem:lod><dem:tin><gml:TriangulatedSurface><gml:trianglePatches>"
      "<gml:Triangle><gml:exterior><gml:LinearRing><gml:posList>0 0 0 1 0 0 0 1 0 0 0 0"
      "</gml:posList></gml:LinearRing></gml:exterior></gml:Triangle></gml:trianglePatches>"
      "</gml:TriangulatedSurface></dem:tin></dem:TINRelief>";
  const auto typed = [&](const std::string& type) {
    return member("<c:" + type + ">" + surface + "</c:" + type + ">");
  };
  const Read result = read(city(
      member("<dem:ReliefFeature gml:id=\"hills\"><dem:reliefComponent>" + tin +
             "</dem:reliefComponent>"
             "<dem:reliefComponent><dem:RasterRelief/></dem:reliefComponent></dem:ReliefFeature>") +
      typed("Road") + typed("WaterBody") + typed("PlantCover") + typed("CityFurniture") + typed("LandUse") +
      member("<brid:Bridge><gml:name>Long\nBridge</gml:name>" + surface + "</brid:Bridge>") +
      member("<ade:Thing>" + surface + "</ade:Thing>") +
      member("<Building xmlns=\"http://example.org/other\">" + surface + "</Building>") +
      building("a", "<ade:more>" + surface + "</ade:more>" + surface)));
  const std::pair<std::string, Kind> expected[] = {
      {"hills", Kind::terrain},      {"", Kind::road},     {"", Kind::water},
      {"", Kind::vegetation},        {"", Kind::other},    {"", Kind::other},
      {"Long?Bridge", Kind::bridge}, {"a", Kind::building}};
  ASSERT_EQ(result.model.objects.size(), std::size(expected));
  for (size_t i = 0; i < std::size(expected); ++i) {
    EXPECT_EQ(result.model.objects[i].name, expected[i].first);
    EXPECT_EQ(result.model.objects[i].kind, expected[i].second) << i;
    EXPECT_EQ(result.model.objects[i].patches.size(), 1u) << i;
  }
  EXPECT_EQ(result.report.dropped.at("unsupported geometry RasterRelief").count, 1u);
  EXPECT_EQ(result.report.dropped.at("city object of an extension").count, 2u);
  EXPECT_EQ(result.report.dropped.at("geometry of an extension").count, 1u);
}

std::string tree(const std::string& id, const std::string& matrix, const std::string& point,
                 const std::string& shape) {
  return member(
      "<veg:SolitaryVegetationObject gml:id=\"" + id +
      "\"><veg:lod2ImplicitRepresentation><c:ImplicitGeometry><c:transformationMatrix>" + matrix +
      "</c:transformationMatrix><c:relativeGMLGeometry" + shape +
      "</c:relativeGMLGeometry><c:referencePoint><gml:Point><gml:pos>" + point +
      "</gml:pos></gml:Point></c:referencePoint></c:ImplicitGeometry></veg:lod2ImplicitRepresentation>"
      "</veg:SolitaryVegetationObject>");
}
const std::string identity = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1";
const std::string triangle =
    "><gml:MultiSurface gml:id=\"shape\"><gml:surfaceMember><gml:Polygon><gml:exterior><gml:LinearRing>"
    "<gml:posList>0 0 0 1 0 0 0 0 2 0 0 0</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon>"
    "</gml:surfaceMember></gml:MultiSurface>";
const std::string shared = " xlink:href=\"#shape\">";

glm::dvec3 placed(const RawModel& model, size_t object, uint64_t corner) {
  const RawObject& instance = model.objects.at(object);
  const uint64_t ring = model.rings_before(instance.patches.at(0).polygon_begin);
  return model.placements.at(instance.placement) *
         glm::dvec4(model.vertices[model.ring_vertex[model.corners_before(ring) + corner]], 1);
}

TEST(CityGml, ImplicitGeometriesAreInstances) {
  const Read result = read(city(tree("t1", identity, "392000 5819000 34", triangle) +
                                tree("t2", "0 -2 0 1 2 0 0 0 0 0 3 0 0 0 0 1", "392010 5819000 34", shared)));
  const RawModel& model = result.model;
  ASSERT_EQ(model.objects.size(), 2u);
  EXPECT_EQ(model.polygons.size(), 1u);
  EXPECT_EQ(model.placements.size(), 2u);
  EXPECT_EQ(model.objects[0].patches[0].polygon_begin, model.objects[1].patches[0].polygon_begin);
  EXPECT_EQ(model.objects[0].patches[0].polygon_end, model.objects[1].patches[0].polygon_end);
  EXPECT_EQ(placed(model, 0, 1), glm::dvec3(392001, 5819000, 34));
  EXPECT_EQ(placed(model, 1, 1), glm::dvec3(392011, 5819002, 34));
  EXPECT_EQ(placed(model, 1, 2), glm::dvec3(392011, 5819000, 40));
}

TEST(CityGml, InstancesTurnWithTheAxes) {
  // Gauss-Krueger with the northing first, as the authority has it: +1 along the first axis is north.
  const Read result = read(city(tree("t", "1 0 0 7 0 1 0 0 0 0 1 0 0 0 0 1", "5805000 3550000 34", triangle),
                                "urn:ogc:def:crs:EPSG::31467"));
  EXPECT_EQ(result.model.crs, "EPSG:31467");
  EXPECT_EQ(placed(result.model, 0, 0), glm::dvec3(3550000, 5805007, 34));
  EXPECT_EQ(placed(result.model, 0, 1), glm::dvec3(3550000, 5805008, 34));
}

TEST(CityGml, ImplicitGeometriesOfPartsArePlaced) {
  const std::string implicit =
      "<c:ImplicitGeometry><c:transformationMatrix>" + identity +
      "</c:transformationMatrix><c:relativeGMLGeometry" + triangle +
      "</c:relativeGMLGeometry><c:referencePoint><gml:Point><gml:pos>78250 457605 3</gml:pos></gml:Point>"
      "</c:referencePoint></c:ImplicitGeometry>";
  std::string again = implicit;
  again.replace(again.find(triangle), triangle.size(), shared);
  const auto installation = [](const std::string& content) {
    return "<b:outerBuildingInstallation><b:BuildingInstallation><b:lod2ImplicitRepresentation>" + content +
           "</b:lod2ImplicitRepresentation></b:BuildingInstallation></b:outerBuildingInstallation>";
  };
  const Read result = read(city(building("a", solid(cube()) + installation(implicit) + installation(again))));
  EXPECT_TRUE(result.model.placements.empty());
  ASSERT_EQ(result.model.objects.at(0).patches.size(), 3u);
  EXPECT_EQ(result.model.objects[0].patches[2].part, "BuildingInstallation");
  EXPECT_EQ(result.model.polygons.size(), 8u);
  EXPECT_EQ(result.model.vertices.back(), glm::dvec3(78250, 457605, 5));
}

TEST(CityGml, WhatCannotBePlacedIsReported) {
  const Read degrees = read(city(tree("t", identity, "52 13 34", triangle) + building("a", solid(cube())),
                                 "urn:ogc:def:crs:EPSG::4326"));
  EXPECT_EQ(degrees.report.dropped.at("ImplicitGeometry, which is in metres, in a CRS in degrees").count, 1u);
  const Read library = read(city(member(
      "<frn:CityFurniture><frn:lod2ImplicitRepresentation><c:ImplicitGeometry><c:libraryObject>http://x.org/"
      "lamp.wrl"
      "</c:libraryObject></c:ImplicitGeometry></frn:lod2ImplicitRepresentation></frn:CityFurniture>")));
  EXPECT_EQ(library.report.dropped.at("unsupported geometry ImplicitGeometry of a library").count, 1u);
}

TEST(CityGml, XPointsEastWhateverTheCrs) {
  const auto first = [](const std::string& srs_name, const std::string& list) {
    const std::string polygon =
        "<gml:surfaceMember><gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>" + list +
        "</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>";
    return read(city(building("a", multi_surface("2", polygon)), srs_name)).model.vertices.at(0);
  };
  const std::string lyon = "45.76 4.84 170 45.76 4.85 170 45.77 4.84 170 45.76 4.84 170";
  EXPECT_EQ(first("urn:ogc:def:crs:EPSG::4326", lyon), glm::dvec3(4.84, 45.76, 170));
  EXPECT_EQ(first("EPSG:4326", "4.84 45.76 170 4.85 45.76 170 4.84 45.77 170"), glm::dvec3(4.84, 45.76, 170));
  EXPECT_EQ(first("urn:adv:crs:DE_DHDN_3GK3*DE_DHHN92_NH",
                  "3550000 5805000 50 3550009 5805000 50 3550000 5805009 50"),
            glm::dvec3(3550000, 5805000, 50));
  EXPECT_EQ(first("somewhere", lyon), glm::dvec3(45.76, 4.84, 170));
}

TEST(CityGml, ACrsThatIsNotKnownOrNotTheOnlyOneIsReported) {
  const Read odd = read(city(building("a", solid(cube())), "my office"));
  EXPECT_EQ(odd.model.crs, "");
  EXPECT_EQ(odd.report.dropped.at("CRS 'my office', which is not known").count, 1u);
  std::string two = city(building("a", solid(cube())));
  two.replace(two.find("<gml:Polygon>"), 13, "<gml:Polygon srsName=\"EPSG:28992\">");
  const Read mixed = read(two);
  EXPECT_EQ(mixed.model.crs, "EPSG:25833");
  EXPECT_EQ(mixed.report.dropped.at("CRS EPSG:28992 beside EPSG:25833").count, 1u);
  const Read same = read(city(building("a", solid(cube())), "urn:ogc:def:crs:EPSG::25833"));
  EXPECT_TRUE(same.report.dropped.empty());
}

TEST(CityGml, FlatCoordinatesAreReported) {
  std::string text = city(building("a", solid(cube())));
  text.replace(text.find("<gml:posList>"), 13, "<gml:posList srsDimension=\"2\">");
  EXPECT_EQ(read(text).report.dropped.at("polygon without an outline in three dimensions").count, 1u);
}

std::string refusal(const std::string& content) {
  try {
    assembled(read(content));
  } catch (const Error& error) {
    const std::string what = error.what();
    EXPECT_EQ(error.status(), ExitStatus::bad_input) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    EXPECT_LT(what.size(), 600u) << what;
    return what;
  }
  return "nothing is wrong";
}

TEST(CityGml, BadInputIsRefusedWithItsPlace) {
  const std::string good =
      city(building("a", solid(cube())) + tree("t", identity, "78250 457605 3", triangle));
  ASSERT_EQ(refusal(good), "nothing is wrong");
  const auto with = [&](const std::string& old, const std::string& replacement) {
    std::string text = good;
    const size_t at = text.find(old);
    EXPECT_NE(at, std::string::npos) << old;
    return text.replace(at, old.size(), replacement);
  };
  std::string deep;
  for (int i = 0; i < 2'000'000; ++i) deep += "<g>";
  std::string namespaces = "<g ";
  for (int i = 0; i < 2000; ++i) namespaces += "xmlns:n" + std::to_string(i) + "=\"u\" ";
  const std::pair<std::string, std::string> table[] = {
      {with("78248.66", "nan"), "line 7: 'nan' is not a finite number"},
      {with("78248.66", "1e999"), "line 7: '1e999' is not a finite number"},
      {with("78248.66", "12x"), "line 7: '12x' is not a finite number"},
      {with("78248.66 ", ""), "line 7: 14 coordinates are no whole number of 3D points"},
      {with("1 0 0 0 0 1", "1 0 0 0 1"), "line 8: is not a matrix of 16 numbers"},
      {with("1 0 0 0 0 1", "inf 0 0 0 0 1"), "line 8: 'inf' is not a finite number"},
      {with("78250 457605 3<", "78250 457605<"), "line 8: has no referencePoint of 3 numbers"},
      {with("c=\"http://www.opengis.net/citygml/2.0\"", "c=\"http://www.opengis.net/citygml/3.0\""),
       "line 2: CityGML 3.0 is not read"},
      {with("c=\"http://www.opengis.net/citygml/2.0\"", "c=\"http://example.org\""),
       "line 2: the root is 'CityModel' in"},
      {with("<c:CityModel", "<x:CityModel"), "line 9: not well-formed XML"},
      {"<IndoorFeatures/>", "line 1: the root is 'IndoorFeatures'"},
      {"<?xml version=\"1.0\"?>\n<!-- nothing -->\n", "line "},
      {"<a", "line 1: not well-formed XML"},
      {"", "line 1: not well-formed XML"},
      {std::string(1000, '\0'), "line 1: not well-formed XML"},
      {std::string(100000, '<'), "line 1: not well-formed XML"},
      {with("<c:cityObjectMember>", "<c:cityObjectMember>" + deep), "line "},
      {with("<c:cityObjectMember>", deep.substr(0, 9000) + "<c:cityObjectMember>") + "", "line "},
      {with("<c:cityObjectMember>", namespaces + "/><c:cityObjectMember>"),
       "line 7: more than 1,000 namespaces"},
      {city(""), "whole file: holds no surface"},
      {city(building("a", "")), "whole file: holds no surface"},
  };
  for (const auto& [content, place] : table) {
    const std::string what = refusal(content);
    EXPECT_TRUE(what.starts_with("city.gml: " + place)) << what << "\nis not at " << place;
  }
  std::string closed = deep.substr(0, 9000);
  for (int i = 0; i < 3000; ++i) closed += "</g>";
  EXPECT_TRUE(refusal(with("<c:cityObjectMember>", closed + "<c:cityObjectMember>"))
                  .starts_with("city.gml: line 7: elements nest deeper"));
}

TEST(CityGml, EntitiesAndDtdsDoNothing) {
  std::string text = city(building("a", solid(cube())));
  const std::string bomb =
      "<!DOCTYPE x SYSTEM \"file:///etc/passwd\" [<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b \"&a;&a;&a;&a;\">"
      "<!ENTITY c SYSTEM \"file:///etc/passwd\">]>\n";
  text.insert(text.find("<c:CityModel"), bomb);
  EXPECT_EQ(read(text).model.polygons.size(), 6u);
  text.replace(text.find("78248.66"), 8, "&c;");
  EXPECT_TRUE(refusal(text).starts_with("city.gml: line 8: '&c;' is not a finite number"));
}

// Every way of cutting a file short, and 2,000 changed bytes: an error or a model, never a crash.
TEST(CityGml, CutAndChangedFilesNeverCrash) {
  const std::string good =
      city(building("a", solid(reference("w")) + bounded("WallSurface", face("0154", "w"))) +
           tree("t1", identity, "78250 457605 3", triangle) + tree("t2", identity, "78260 457605 3", shared));
  ASSERT_EQ(refusal(good), "nothing is wrong");
  for (size_t length = 0; length + 1 < good.size(); ++length)
    EXPECT_NE(refusal(good.substr(0, length)), "nothing is wrong") << length;
  uint32_t state = 1;
  size_t refused = 0;
  for (int round = 0; round < 2000; ++round) {
    std::string changed = good;
    state = state * 1664525u + 1013904223u;
    changed[(state >> 8) % changed.size()] = "0123456789<>/\"=:#& -e."[(state >> 4) % 22];
    refused += refusal(changed) != "nothing is wrong";
  }
  EXPECT_GT(refused, 100u);
  EXPECT_LT(refused, 2000u);
}

std::optional<Read> read_file(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) return std::nullopt;
  Read result;
  result.model = read_citygml(read_input(path), result.report);
  return result;
}

TEST(CityGml, TheExampleHasWhatItSays) {
  const std::optional<Read> example =
      read_file(std::filesystem::path(VEDUTA_TEST_DATA) / "formats/citygml.gml");
  ASSERT_TRUE(example.has_value());
  const ImportResult result = assembled(*example);
  EXPECT_EQ(result.report.objects_by_kind.at("building"), 6u);
  EXPECT_EQ(result.report.objects_by_kind.at("terrain"), 1u);
  EXPECT_EQ(result.report.parts, 3u);
  EXPECT_EQ(result.scene.crs, "EPSG:25833");
  EXPECT_EQ(example->model.placements.size(), 2u);
  EXPECT_EQ(result.report.dropped.size(), 1u);
  EXPECT_EQ(result.report.dropped.at("LoD 1 beside LoD 2").count, 1u);
}

// Counted in the XML by another program: buildings, polygons, and faces that a building has twice.
TEST(CityGml, Berlin) {
  const std::filesystem::path folder = std::filesystem::path(VEDUTA_SHARED_DATA) / "berlin_citygml";
  const std::optional<Read> tile = read_file(folder / "3890_5819.gml");
  if (!tile) GTEST_SKIP() << folder << " is not there";
  const ImportResult result = assembled(*tile);
  EXPECT_EQ(tile->model.format, "CityGML 1.0");
  EXPECT_EQ(result.scene.crs, "EPSG:25833");
  EXPECT_EQ(result.scene.objects.size(), 40u);
  EXPECT_EQ(tile->model.polygons.size(), 1803u);
  // 6,313 triangles in all; 402 faces of BLDG_1140001 are there twice and make 1,316, one more is within a
  // polygon.
  EXPECT_EQ(result.report.dropped.at("duplicate triangle").count, 1317u);
  EXPECT_NE(result.report.dropped.at("duplicate triangle").first_place.find("BLDG_1140001"),
            std::string::npos);
  EXPECT_EQ(result.scene.triangles.size(), 6313u - 1317u);
  const std::optional<Read> sample = read_file(folder / "berlin_open_data_sample_data.citygml");
  ASSERT_TRUE(sample.has_value());
  EXPECT_EQ(sample->model.objects.size(), 61u);
  EXPECT_EQ(sample->model.polygons.size(), 1125u);
}

TEST(CityGml, SolidsNamedByTheirError) {
  const std::filesystem::path folder = std::filesystem::path(VEDUTA_SHARED_DATA) / "hard_val3dity/data";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not there";
  struct Expected {
    const char* file;
    size_t polygons, triangles;
  };
  // Every polygon once, though solids and boundary surfaces share them in the first two.
  const Expected table[] = {{"gml/DenHaag_1BwBP.gml", 39, 76},
                            {"gml/dh_1.gml", 52, 102},
                            {"gml/csol1.gml", 12, 24},
                            {"gml/msol1.gml", 12, 24},
                            {"gml/msol2.gml", 18, 36},
                            {"gml/msol3.gml", 11, 22},
                            {"gml/csol6.gml", 11, 22},
                            {"obj/nonmanifold.gml", 12, 12},
                            {"test_geometry_generic/302_2.gml", 6, 12}};
  for (const Expected& expected : table) {
    const std::optional<Read> found = read_file(folder / expected.file);
    ASSERT_TRUE(found.has_value()) << expected.file;
    EXPECT_EQ(found->model.polygons.size(), expected.polygons) << expected.file;
    EXPECT_EQ(assembled(*found).scene.triangles.size(), expected.triangles) << expected.file;
  }
  EXPECT_THROW(read_file(folder / "gml/FZK-Haus_full.gml"), Error);  // IndoorGML
  EXPECT_THROW(read_file(folder / "test_file_format/invalid_indoorgml_1.gml"), Error);
}

}  // namespace
}  // namespace veduta
