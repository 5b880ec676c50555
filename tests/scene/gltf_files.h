// glTF documents, GLBs and tiles that a test puts together, and what it asks of the models that are read.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scene/error.h"
#include "scene/model_files.h"
#include "scene/raw_model.h"

namespace veduta {

using nlohmann::json;

template <typename Value>
std::string packed(const std::vector<Value>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)};
}

inline InputFile input(std::string name, const std::string& bytes) {
  const std::filesystem::path path(name);
  return {std::move(name), path.stem().string(), path.extension().string(),
          bytes + std::string(InputFile::padding, '\0')};
}

/// A binary buffer under construction, with the accessors into it.
struct Gltf {
  json document = json::parse(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {}}]}],
    "buffers": [{}], "bufferViews": [], "accessors": []})");
  std::string bytes;

  template <typename Value>
  size_t accessor(int component_type, const std::string& type, size_t count,
                  const std::vector<Value>& values) {
    const size_t view = buffer_view(values);
    document["accessors"].push_back(
        {{"bufferView", view}, {"componentType", component_type}, {"type", type}, {"count", count}});
    return document["accessors"].size() - 1;
  }
  template <typename Value>
  size_t buffer_view(const std::vector<Value>& values) {
    bytes.resize((bytes.size() + 3) / 4 * 4);
    document["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", values.size() * sizeof(Value)}});
    bytes += packed(values);
    return document["bufferViews"].size() - 1;
  }
  json& primitive(size_t mesh = 0) { return document["meshes"][mesh]["primitives"][0]; }

  std::string glb() {
    bytes.resize((bytes.size() + 3) / 4 * 4);
    if (!document["buffers"][0].contains("byteLength")) document["buffers"][0]["byteLength"] = bytes.size();
    std::string text = document.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const auto size = [](size_t value) { return static_cast<uint32_t>(value); };
    return "glTF" +
           packed<uint32_t>({2, size(28 + text.size() + bytes.size()), size(text.size()), 0x4E4F534A}) +
           text + packed<uint32_t>({size(bytes.size()), 0x004E4942}) + bytes;
  }
};

/// The triangle (0,0,0) (1,0,0) (0,1,0) with 16-bit indices.
inline Gltf triangle() {
  Gltf gltf;
  gltf.primitive()["attributes"]["POSITION"] =
      gltf.accessor<float>(5126, "VEC3", 3, {0, 0, 0, 1, 0, 0, 0, 1, 0});
  gltf.primitive()["indices"] = gltf.accessor<uint16_t>(5123, "SCALAR", 3, {0, 1, 2});
  return gltf;
}

/// A b3dm of a GLB, with tables as they are to be written.
inline std::string b3dm(const std::string& glb, const std::string& features, const std::string& batches) {
  const auto size = [](const std::string& text) { return static_cast<uint32_t>(text.size()); };
  return "b3dm" +
         packed<uint32_t>(
             {1, 28 + size(features) + size(batches) + size(glb), size(features), 0, size(batches), 0}) +
         features + batches + glb;
}

inline std::vector<glm::dvec3> corners(const RawModel& model, uint64_t polygon) {
  std::vector<glm::dvec3> points;
  const uint64_t ring = model.rings_before(polygon);
  for (uint64_t i = model.corners_before(ring); i < model.ring_end[ring]; ++i)
    points.push_back(model.vertices[model.ring_vertex[i]]);
  return points;
}

/// Between an object's surfaces and the plane through `base`, m3: positive where the faces point outwards, of
/// an instance that is mirrored the faces of its mesh.
inline double volume_m3(const RawModel& model, const RawObject& object, const glm::dvec3& base) {
  double volume = 0;
  for (const RawPatch& patch : object.patches)
    for (uint64_t polygon = patch.polygon_begin; polygon < patch.polygon_end; ++polygon) {
      std::vector<glm::dvec3> p = corners(model, polygon);
      for (glm::dvec3& point : p)
        point = (object.placement == RawObject::unplaced
                     ? point
                     : model.placements[object.placement] * glm::dvec4(point, 1)) -
                base;
      volume += glm::dot(p[0], glm::cross(p[1], p[2])) / 6;
    }
  const bool mirrored = object.placement != RawObject::unplaced &&
                        glm::determinant(glm::dmat3(model.placements[object.placement])) < 0;
  return mirrored ? -volume : volume;
}

inline const RawObject& object_named(const RawModel& model, const std::string& name) {
  for (const RawObject& object : model.objects)
    if (object.name == name) return object;
  throw std::out_of_range("no object " + name);
}

/// What RawModel promises, for triangles.
inline void expect_sound(const RawModel& model) {
  ASSERT_EQ(model.ring_end.size(), model.polygons.size());
  ASSERT_EQ(model.ring_vertex.size(), 3 * model.ring_end.size());
  for (size_t i = 0; i < model.ring_end.size(); ++i) {
    ASSERT_EQ(model.ring_end[i], 3 * (i + 1));
    ASSERT_EQ(model.polygons[i].ring_end, i + 1);
  }
  for (const uint32_t vertex : model.ring_vertex) ASSERT_LT(vertex, model.vertices.size());
  for (const glm::dvec3& v : model.vertices)
    ASSERT_TRUE(std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z));
  std::vector<int> owners(model.polygons.size());
  for (const RawObject& object : model.objects) {
    ASSERT_FALSE(object.patches.empty());
    if (object.placement != RawObject::unplaced) {
      ASSERT_LT(object.placement, model.placements.size());
    }
    for (const RawPatch& patch : object.patches) {
      ASSERT_LT(patch.polygon_begin, patch.polygon_end);
      ASSERT_LE(patch.polygon_end, model.polygons.size());
      for (uint64_t i = patch.polygon_begin; i < patch.polygon_end; ++i)
        owners[i] += object.placement == RawObject::unplaced ? 1000 : 1;
    }
  }
  for (const int owner : owners) ASSERT_TRUE(owner == 1000 || (owner > 0 && owner < 1000)) << owner;
}

/// Runs `read`, which must refuse its input in one line with `message` in it.
template <typename Read>
void expect_refused(const Read& read, const std::string& message) {
  try {
    read();
    ADD_FAILURE() << "was read; expected: " << message;
  } catch (const Error& error) {
    const std::string what = error.what();
    EXPECT_EQ(error.status(), ExitStatus::bad_input) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    EXPECT_LT(what.size(), 600u) << what;
    EXPECT_NE(what.find(message), std::string::npos) << what << "\nlacks " << message;
  }
}

/// Every `step`-th way of cutting bytes short, and `rounds` changed bytes: read, or refused as bad input.
template <typename Try>
void expect_cut_and_changed_bytes_never_crash(const std::string& good, size_t step, int rounds,
                                              const Try& read) {
  const auto attempt = [&](const std::string& bytes) {
    try {
      read(bytes);
      return true;
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::bad_input) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      return false;
    }
  };
  ASSERT_TRUE(attempt(good));
  for (size_t length = 0; length + 4 < good.size(); length += step)
    EXPECT_FALSE(attempt(good.substr(0, length))) << length << " bytes were read";
  uint32_t state = 1;
  for (int round = 0; round < rounds; ++round) {
    std::string changed = good;
    for (int k = 0; k < 1 + round % 3; ++k) {
      state = state * 1664525u + 1013904223u;
      const char digits[] = "0123456789[]{},:\"-e.";
      const char byte = round % 2 ? static_cast<char>(state >> 4) : digits[(state >> 4) % 20];
      changed[(state >> 8) % changed.size()] = byte;
    }
    attempt(changed);
  }
}

}  // namespace veduta
