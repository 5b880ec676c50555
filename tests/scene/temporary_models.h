// Model files that a test writes, in a directory of its own that goes away with it.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <string>

#include "scene/import.h"

namespace veduta {

/// The scene with the triangles of its instances written out, as a PVS file holds them.
inline Scene written_out(Scene scene) {
  for (const Instance& instance : scene.instances) {
    const auto first = static_cast<uint32_t>(scene.vertices.size());
    for (const glm::vec3& vertex : placed_vertices(scene, instance)) scene.vertices.push_back(vertex);
    for (const glm::uvec3& triangle : placed_triangles(scene, instance))
      scene.triangles.push_back(triangle + first);
    const std::vector<Material>& material = scene.meshes[instance.mesh].material;
    scene.material.insert(scene.material.end(), material.begin(), material.end());
  }
  scene.instances.clear();
  scene.meshes.clear();
  return scene;
}

/// \param object of the scene, not a copy
inline Box bounds_of(const Scene& scene, const Object& object) {
  return scene.bounds(static_cast<size_t>(&object - scene.objects.data()));
}

class TemporaryModels : public testing::Test {
 protected:
  TemporaryModels() {
    std::string pattern = (std::filesystem::temp_directory_path() / "veduta-scene-XXXXXX").string();
    directory_ = mkdtemp(pattern.data());
  }
  ~TemporaryModels() override {
    std::error_code ignored;
    std::filesystem::remove_all(directory_, ignored);
  }

  std::filesystem::path write(const std::string& name, const std::string& content) const {
    std::ofstream(directory_ / name, std::ios::binary) << content;
    return directory_ / name;
  }
  ImportResult import(const std::string& name, const std::string& content,
                      const ImportOptions& options = {}) const {
    return import_scene({write(name, content)}, options);
  }

  std::filesystem::path directory_;
};

/// A CityJSON document in millimetres at a place in the Dutch national grid.
inline std::string cityjson(const std::string& objects, const std::string& vertices,
                            const std::string& version = "2.0", const std::string& more = "") {
  return R"({"type":"CityJSON","version":")" + version +
         R"(","metadata":{"referenceSystem":"https://www.opengis.net/def/crs/EPSG/0/7415"},)" +
         R"("transform":{"scale":[0.001,0.001,0.001],"translate":[78248.66,457604.591,2.463]},)" + more +
         R"("CityObjects":{)" + objects + R"(},"vertices":)" + vertices + "}";
}

/// The corners of a 10 m cube, for cityjson(): 0-3 below, 4-7 above, counter-clockwise.
inline const std::string cube_vertices =
    "[[0,0,0],[10000,0,0],[10000,10000,0],[0,10000,0],[0,0,10000],[10000,0,10000],[10000,10000,10000],[0,"
    "10000,10000]]";
/// Its faces: ground, roof, four walls.
inline const std::string cube_faces =
    "[[0,3,2,1]],[[4,5,6,7]],[[0,1,5,4]],[[1,2,6,5]],[[2,3,7,6]],[[3,0,4,7]]";

inline std::string object(const std::string& id, const std::string& type, const std::string& geometry,
                          const std::string& more = "") {
  return "\"" + id + R"(":{"type":")" + type + "\"," + more + R"("geometry":[)" + geometry + "]}";
}
inline std::string geometry(const std::string& type, const std::string& boundaries,
                            const std::string& lod = "\"2\"", const std::string& more = "") {
  return R"({"type":")" + type + R"(","lod":)" + lod + R"(,"boundaries":[)" + boundaries + "]" + more + "}";
}

inline double area_m2(const Scene& scene, uint64_t begin, uint64_t end) {
  double area = 0;
  for (uint64_t i = begin; i < end; ++i) {
    const glm::dvec3 a(scene.vertices[scene.triangles[i].x]), b(scene.vertices[scene.triangles[i].y]),
        c(scene.vertices[scene.triangles[i].z]);
    area += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  return area;
}
inline double area_m2(const Scene& scene) {
  return area_m2(scene, 0, scene.triangles.size());
}

/// What Scene promises of its arrays.
inline void expect_consistent(const Scene& scene) {
  ASSERT_EQ(scene.material.size(), scene.triangles.size());
  ASSERT_FALSE(scene.objects.empty());
  uint64_t next = 0;
  for (const Object& object : scene.objects) {
    EXPECT_EQ(object.triangle_begin, next);
    EXPECT_GT(object.triangle_end, object.triangle_begin);
    next = object.triangle_end;
  }
  EXPECT_EQ(next, scene.triangles.size());
  for (const Part& part : scene.parts) {
    ASSERT_LT(part.object, scene.objects.size());
    EXPECT_GE(part.triangle_begin, scene.objects[part.object].triangle_begin);
    EXPECT_LT(part.triangle_begin, part.triangle_end);
    EXPECT_LE(part.triangle_end, scene.objects[part.object].triangle_end);
  }
  for (const glm::uvec3& t : scene.triangles) {
    ASSERT_LT(std::max({t.x, t.y, t.z}), scene.vertices.size());
    const glm::dvec3 a(scene.vertices[t.x]), b(scene.vertices[t.y]), c(scene.vertices[t.z]);
    EXPECT_GT(glm::length(glm::cross(b - a, c - a)), 0.0);
  }
}

}  // namespace veduta
