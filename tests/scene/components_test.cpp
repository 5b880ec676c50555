// scene/components.h: files without objects taken apart.
#include "scene/components.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace veduta {
namespace {

// A model of one object, of polygons given by their corners.
RawModel model_of(const std::vector<std::vector<glm::dvec3>>& polygons, Kind kind = Kind::building) {
  RawModel model;
  model.has_objects = false;
  for (const auto& corners : polygons) {
    for (const glm::dvec3& corner : corners) {
      model.ring_vertex.push_back(static_cast<uint32_t>(model.vertices.size()));
      model.vertices.push_back(corner);
    }
    model.ring_end.push_back(model.ring_vertex.size());
    model.polygons.push_back(
        {model.ring_end.size(), static_cast<uint32_t>(model.polygons.size() + 1), Material::unknown});
  }
  model.objects.push_back(
      {"soup", kind, "soup.stl", {{"", "soup.stl", 0, polygons.size()}}, RawObject::unplaced});
  return model;
}

std::vector<glm::dvec3> triangle(double x, double z = 0) {
  return {{x, 0, z}, {x + 1, 0, z}, {x, 1, z}};
}

TEST(Components, PolygonsThatShareAPlaceAreOneObject) {
  // Two pairs, interleaved; the second of each touches the first in one point.
  RawModel model = model_of({triangle(0), triangle(10), triangle(1), triangle(11), triangle(20)});
  take_apart(model);
  ASSERT_EQ(model.objects.size(), 3u);
  const std::vector<std::vector<uint32_t>> lines = {{1, 3}, {2, 4}, {5}};
  for (size_t i = 0; i < 3; ++i) {
    const RawObject& object = model.objects[i];
    EXPECT_EQ(object.name, "soup/" + std::to_string(i + 1));
    ASSERT_EQ(object.patches.size(), 1u);
    std::vector<uint32_t> found;
    for (uint64_t p = object.patches[0].polygon_begin; p < object.patches[0].polygon_end; ++p)
      found.push_back(model.polygons[p].line);
    EXPECT_EQ(found, lines[i]) << "in the file's order";
  }
  EXPECT_EQ(model.vertices[model.ring_vertex[model.corners_before(model.rings_before(2))]].x, 10);
}

TEST(Components, ZeroAndMinusZeroAreOnePlace) {
  RawModel model = model_of({{{-1, 0, 0}, {0, 0, 0}, {-1, 1, 0}}, {{-0.0, 0, -0.0}, {1, 0, 0}, {1, 1, 0}}});
  take_apart(model);
  ASSERT_EQ(model.objects.size(), 1u);
  EXPECT_EQ(model.objects[0].name, "soup");
}

TEST(Components, TheGroundBelowIsTerrain) {
  const auto square = [](double size, double z) {
    return std::vector<glm::dvec3>{{0, 0, z}, {size, 0, z}, {size, size, z + 1}, {0, size, z + 1}};
  };
  const auto kinds = [](RawModel model) {
    take_apart(model);
    std::vector<Kind> found;
    for (const RawObject& object : model.objects) found.push_back(object.kind);
    return found;
  };
  using Kinds = std::vector<Kind>;
  EXPECT_EQ(kinds(model_of({square(60, 0), triangle(100, 5)})), (Kinds{Kind::terrain, Kind::building}));
  EXPECT_EQ(kinds(model_of({square(40, 0), triangle(100, 5)})), (Kinds{Kind::building, Kind::building}))
      << "small";
  EXPECT_EQ(kinds(model_of({square(60, 10), triangle(100, 5)})), (Kinds{Kind::building, Kind::building}))
      << "something is below it: a roof";
  std::vector<glm::dvec3> down = square(60, 0);
  std::reverse(down.begin(), down.end());
  EXPECT_EQ(kinds(model_of({down, triangle(100, 5)})), (Kinds{Kind::building, Kind::building}));
  const std::vector<glm::dvec3> wall = {{60, 0, 0}, {60, 60, 0}, {60, 60, 9}, {60, 0, 9}};
  EXPECT_EQ(kinds(model_of({square(60, 0), wall, triangle(100, 5)})),
            (Kinds{Kind::building, Kind::building}));
}

TEST(Components, WhatStaysWhole) {
  RawModel terrain = model_of({triangle(0), triangle(10)}, Kind::terrain);
  take_apart(terrain);
  EXPECT_EQ(terrain.objects.size(), 1u);
  std::vector<std::vector<glm::dvec3>> loose;
  for (int i = 0; i < 1001; ++i) loose.push_back(triangle(10 * i));
  RawModel soup = model_of(loose);
  take_apart(soup);
  EXPECT_EQ(soup.objects.size(), 1u) << "triangles that touch nothing are no buildings";
  loose.pop_back();
  RawModel few = model_of(loose);
  take_apart(few);
  EXPECT_EQ(few.objects.size(), 1000u);
  RawModel empty = model_of({});
  take_apart(empty);
  EXPECT_EQ(empty.objects.size(), 1u);
}

}  // namespace
}  // namespace veduta
