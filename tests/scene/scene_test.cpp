// Instances: one mesh in memory, every triangle where it stands.
#include "scene/scene.h"

#include <algorithm>

#include "tests/scene/temporary_models.h"

namespace veduta {
namespace {

using Corners = std::array<glm::vec3, 3>;

std::vector<Corners> triangles_of(const Scene& scene, size_t object) {
  std::vector<Corners> all;
  visit_triangles(scene, object, [&](uint64_t t, const Corners& corners) {
    EXPECT_EQ(t, scene.objects[object].triangle_begin + all.size());
    all.push_back(corners);
  });
  return all;
}

// A house of two walls and a roof, as a template around (100000, 5, 0), and objects that place it.
std::string city(const std::vector<std::string>& matrices, const std::string& more = "") {
  std::string objects;
  for (size_t i = 0; i < matrices.size(); ++i)
    objects +=
        (i ? "," : "") + ("\"house" + std::to_string(i)) +
        R"(":{"type":"Building","geometry":[{"type":"GeometryInstance","template":0,"boundaries":[0],)" +
        R"("transformationMatrix":[)" + matrices[i] + "]}]}";
  return R"({"type":"CityJSON","version":"2.0","transform":{"scale":[0.5,0.5,0.5],"translate":[2000000,5000000,30]},)"
         R"("geometry-templates":{"templates":[{"type":"MultiSurface","lod":"2","boundaries":)"
         R"([[[0,1,2,3]],[[3,2,4,5]],[[0,3,5]]]}],"vertices-templates":)"
         R"([[100000,0,0],[100004,0,0],[100004,0,3],[100000,0,3],[100004,5,4.5],[100000,5,4.5]]},)"
         R"("CityObjects":{)" +
         objects + more + R"(},"vertices":[[0,0,0],[40,0,0],[40,40,0],[0,40,0]]})";
}

const std::string here = "1,0,0,-100000, 0,1,0,0, 0,0,1,0, 0,0,0,1";
const std::string turned = "0,-1,0,20, 1,0,0,-100000, 0,0,1,0.25, 0,0,0,1";
const std::string mirrored = "-1,0,0,100030, 0,1,0,0, 0,0,1,0, 0,0,0,1";

class Instances : public TemporaryModels {};

TEST_F(Instances, ShareOneMeshAndStandWhereTheyArePlaced) {
  const Scene scene = import("c.json", city({here, turned, mirrored})).scene;
  ASSERT_EQ(scene.objects.size(), 3u);
  EXPECT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.triangles.size(), 0u);
  EXPECT_EQ(scene.triangle_count(), 15u);
  EXPECT_EQ(scene.objects[2].name, "house2");
  const glm::dvec3 origin(scene.origin[0], scene.origin[1], scene.origin[2]);
  const auto box = [&](size_t o) {
    const Box b = scene.bounds(o);
    return std::pair(glm::dvec3(b.lower) + origin, glm::dvec3(b.upper) + origin);
  };
  EXPECT_EQ(box(0).first, glm::dvec3(2000000, 5000000, 30));
  EXPECT_EQ(box(0).second, glm::dvec3(2000004, 5000005, 34.5));
  EXPECT_EQ(box(1).first, glm::dvec3(2000015, 5000000, 30.25));
  EXPECT_EQ(box(1).second, glm::dvec3(2000020, 5000004, 34.75));
  EXPECT_EQ(box(2).first, glm::dvec3(2000026, 5000000, 30));
  // The first wall looks towards -y; the mirrored one too, not into the house.
  for (const size_t o : {size_t{0}, size_t{2}}) {
    const Corners wall = triangles_of(scene, o).front();
    EXPECT_LT(glm::cross(wall[1] - wall[0], wall[2] - wall[0]).y, 0) << o;
  }
}

TEST_F(Instances, AloneItHasTrianglesOfItsOwnInTheSamePlaces) {
  const Scene many = import("many.json", city({here, here, turned})).scene;
  const Scene one = import("one.json", city({here})).scene;
  EXPECT_TRUE(one.instances.empty());
  EXPECT_EQ(one.triangles.size(), 5u);
  const glm::vec3 apart(one.origin[0] - many.origin[0], one.origin[1] - many.origin[1],
                        one.origin[2] - many.origin[2]);
  const std::vector<Corners> a = triangles_of(many, 0), b = triangles_of(one, 0);
  ASSERT_EQ(a.size(), b.size());
  for (size_t t = 0; t < a.size(); ++t)
    for (int corner = 0; corner < 3; ++corner) EXPECT_EQ(a[t][corner], b[t][corner] + apart);
  EXPECT_EQ(many.meshes[0].material, one.material);
}

TEST_F(Instances, ComeAfterObjectsWithTrianglesOfTheirOwn) {
  const std::string ground =
      R"(,"ground":{"type":"TINRelief","geometry":[{"type":"MultiSurface","lod":"1","boundaries":[[[0,1,2]],[[0,2,3]]]}]})";
  const Scene scene = import("c.json", city({here, turned}, ground), {.terrain_tile_m = 0}).scene;
  ASSERT_EQ(scene.objects.size(), 3u);
  EXPECT_EQ(scene.objects[0].kind, Kind::terrain);
  EXPECT_EQ(scene.instance_of(0), nullptr);
  ASSERT_NE(scene.instance_of(1), nullptr);
  EXPECT_EQ(scene.objects[1].triangle_begin, scene.triangles.size());
  EXPECT_EQ(scene.objects[2].triangle_end, scene.triangle_count());
  EXPECT_EQ(triangles_of(scene, 0).size() + 10, scene.triangle_count());
}

TEST_F(Instances, PlacedAtInfinityIsRefused) {
  EXPECT_THROW(import("c.json", city({here, "1e300,0,0,0, 0,1e300,0,0, 0,0,1,0, 0,0,0,1"})),
               std::runtime_error);
  EXPECT_THROW(import("c.json", city({here, "1e308,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1"})), std::runtime_error);
}

TEST_F(Instances, RoofAndWallFollowThePlacement) {
  // Turned on its side, the roof of the template is a wall.
  const std::string tipped = "1,0,0,-100000, 0,0,-1,0, 0,1,0,0, 0,0,0,1";
  const Scene scene = import("c.json", city({tipped, tipped})).scene;
  EXPECT_EQ(scene.meshes.at(0).material.front(), Material::ground);  // the first wall, now below
}

}  // namespace
}  // namespace veduta
