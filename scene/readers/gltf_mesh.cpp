#include "scene/readers/gltf_mesh.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <numeric>

#include "scene/names.h"
#include "scene/text.h"

namespace veduta {
namespace {

// Files that draw the same vertices from many meshes stay below this; a hostile one cannot ask for terabytes.
constexpr uint64_t most_at_least = 1'000'000, most_per_byte = 2;

int attribute(const tinygltf::Primitive& primitive, const char* name) {
  const auto found = primitive.attributes.find(name);
  return found == primitive.attributes.end() ? -1 : found->second;
}

}  // namespace

GltfMeshes::GltfMeshes(const tinygltf::Model& gltf, RawModel& model, const std::string& file, uint64_t bytes,
                       ImportReport& report)
    : gltf_(gltf),
      model_(model),
      file_(file),
      report_(report),
      accessors_(gltf, file),
      left_(most_at_least + most_per_byte * bytes) {}

Error GltfMeshes::error(const std::string& place, const std::string& what) const {
  return bad_input(file_, place, what);
}

std::vector<GltfRun> GltfMeshes::add(int mesh, const glm::dmat4& matrix) {
  std::vector<GltfRun> runs;
  for (size_t i = 0; i < gltf_.meshes[static_cast<size_t>(mesh)].primitives.size(); ++i)
    add_primitive(mesh, i, matrix, runs);
  return runs;
}

void GltfMeshes::add_primitive(int mesh, size_t number, const glm::dmat4& matrix,
                               std::vector<GltfRun>& runs) {
  const tinygltf::Primitive& primitive = gltf_.meshes[static_cast<size_t>(mesh)].primitives[number];
  const std::string place = "meshes/" + std::to_string(mesh) + "/primitives/" + std::to_string(number);
  if (primitive.mode < TINYGLTF_MODE_TRIANGLES)
    return count_dropped(report_, "glTF primitive of points or lines", file_ + ": " + place);
  if (primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN)
    throw error(place + "/mode", std::to_string(primitive.mode) + " is not one of glTF 2.0");
  if (!primitive.targets.empty())
    count_dropped(report_, "glTF morph targets", file_ + ": " + place, primitive.targets.size());
  const int positions = attribute(primitive, "POSITION");
  if (positions < 0) return count_dropped(report_, "glTF primitive without positions", file_ + ": " + place);
  if (positions != positions_of_) {
    positions_of_ = -1;
    positions_ = accessors_.numbers(positions, 3);
    positions_of_ = positions;
  }
  const size_t vertex_count = positions_.size() / 3;

  std::vector<uint32_t> corners;
  if (primitive.indices >= 0) {
    corners = accessors_.indices(primitive.indices);
  } else {
    corners.resize(vertex_count);
    std::iota(corners.begin(), corners.end(), 0u);
  }
  for (const uint32_t corner : corners)
    if (corner >= vertex_count)
      throw error(place + "/indices", "vertex " + std::to_string(corner) + " is not among the " +
                                          std::to_string(vertex_count) + " of POSITION; export it again");
  std::vector<glm::uvec3> faces = triangles(primitive.mode, std::move(corners), place);

  int ids = attribute(primitive, "_FEATURE_ID_0");
  if (ids < 0) ids = attribute(primitive, "_BATCHID");
  std::vector<uint64_t> feature;  // of each vertex
  if (ids >= 0) {
    feature = feature_ids(ids, vertex_count, place);
    std::stable_sort(faces.begin(), faces.end(),
                     [&](const glm::uvec3& a, const glm::uvec3& b) { return feature[a.x] < feature[b.x]; });
  }
  const uint64_t begin = model_.polygons.size();
  uint64_t end_of_run = begin;
  for (size_t i = 0; i < faces.size(); ++i) {
    const uint64_t id = feature.empty() ? GltfRun::no_feature : feature[faces[i].x];
    if (i == 0 || id != runs.back().feature)
      runs.push_back({id, file_ + ": " + place, end_of_run, end_of_run});
    runs.back().polygon_end = ++end_of_run;
  }

  const auto material = static_cast<size_t>(primitive.material);
  const uint32_t first_vertex = add_vertices(matrix, faces, place);
  add_triangles(faces, first_vertex,
                primitive.material >= 0 && material < gltf_.materials.size()
                    ? material_of_name(gltf_.materials[material].name)
                    : Material::unknown,
                glm::determinant(glm::dmat3(matrix)) < 0);
}

std::vector<glm::uvec3> GltfMeshes::triangles(int mode, std::vector<uint32_t> corners,
                                              const std::string& place) {
  std::vector<glm::uvec3> faces;
  const size_t count = corners.size();
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    faces.reserve(count / 3);
    for (size_t i = 0; i + 2 < count; i += 3) faces.push_back({corners[i], corners[i + 1], corners[i + 2]});
    if (count % 3 != 0) count_dropped(report_, "glTF triangle of less than 3 corners", file_ + ": " + place);
    return faces;
  }
  faces.reserve(count);
  for (size_t i = 0; i + 2 < count; ++i) {
    const glm::uvec3 face = mode == TINYGLTF_MODE_TRIANGLE_FAN
                                ? glm::uvec3(corners[0], corners[i + 1], corners[i + 2])
                                : glm::uvec3(corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]);
    // Strips are joined by triangles that repeat a vertex.
    if (face.x != face.y && face.y != face.z && face.z != face.x) faces.push_back(face);
  }
  return faces;
}

std::vector<uint64_t> GltfMeshes::feature_ids(int accessor, size_t vertices, const std::string& place) const {
  const std::vector<double> numbers = accessors_.numbers(accessor, 1);
  if (numbers.size() != vertices)
    throw error(place, std::to_string(numbers.size()) + " feature ids for " + std::to_string(vertices) +
                           " vertices; export it again");
  std::vector<uint64_t> ids(vertices);
  for (size_t i = 0; i < vertices; ++i) {
    if (!(numbers[i] >= 0 && numbers[i] <= std::numeric_limits<uint32_t>::max() &&
          numbers[i] == std::floor(numbers[i])))
      throw error(place, "feature id " + std::to_string(numbers[i]) + " of vertex " + std::to_string(i) +
                             " is not a whole number from 0 on; export it again");
    ids[i] = static_cast<uint64_t>(numbers[i]);
  }
  return ids;
}

// Appends the vertices that the triangles use; they then count from the first one appended, which is
// returned.
uint32_t GltfMeshes::add_vertices(const glm::dmat4& matrix, std::vector<glm::uvec3>& triangles,
                                  const std::string& place) {
  std::vector<uint32_t> used;  // empty: all
  const size_t all = positions_.size() / 3;
  if (triangles.size() * 3 < all) {
    used.reserve(triangles.size() * 3);
    for (const glm::uvec3& t : triangles) used.insert(used.end(), {t.x, t.y, t.z});
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (glm::uvec3& t : triangles)
      for (int c = 0; c < 3; ++c)
        t[c] = static_cast<uint32_t>(std::lower_bound(used.begin(), used.end(), t[c]) - used.begin());
  }
  const size_t count = triangles.empty() ? 0 : used.empty() ? all : used.size();
  if (count + triangles.size() > left_)
    throw error(place,
                "the file draws its vertices more often than its size allows; export it with instances");
  left_ -= count + triangles.size();
  const size_t first = model_.vertices.size();
  if (first + count > std::numeric_limits<uint32_t>::max())
    throw error(place, "more than 4 billion vertices; cut the model into tiles");
  model_.vertices.resize(first + count);
  for (size_t i = 0; i < count; ++i) {
    const double* p = &positions_[3 * (used.empty() ? i : used[i])];
    const glm::dvec3 moved(matrix * glm::dvec4(p[0], p[1], p[2], 1));
    if (!std::isfinite(moved.x) || !std::isfinite(moved.y) || !std::isfinite(moved.z))
      throw error(place, "a coordinate is not a finite number; repair the mesh");
    model_.vertices[first + i] = moved;
  }
  return static_cast<uint32_t>(first);
}

void GltfMeshes::add_triangles(const std::vector<glm::uvec3>& triangles, uint32_t first_vertex,
                               Material material, bool mirrored) {
  for (const glm::uvec3& t : triangles) {
    model_.ring_vertex.insert(
        model_.ring_vertex.end(),
        {first_vertex + t.x, first_vertex + (mirrored ? t.z : t.y), first_vertex + (mirrored ? t.y : t.z)});
    model_.ring_end.push_back(model_.ring_vertex.size());
    model_.polygons.push_back({model_.ring_end.size(), 0, material});
  }
}

}  // namespace veduta
