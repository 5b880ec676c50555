#include "pvs/pvs_check.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <tuple>

#include "pvs/pvs_layout.h"
#include "scene/error.h"

namespace veduta {

namespace {

using Defect = std::optional<std::string>;

bool finite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

Defect check_arrays(const City& city) {
  const Scene& scene = city.scene;
  uint64_t vertices = scene.vertices.size();
  for (const Instance& instance : scene.instances) {
    if (instance.mesh >= scene.meshes.size()) return "/scene: an instance of a mesh that is not there";
    vertices += scene.meshes[instance.mesh].vertices.size();
  }
  if (vertices > UINT32_MAX) return "/scene/vertices: more than 2^32 - 1";
  if (scene.instances.size() > scene.objects.size()) return "/scene/objects: fewer than instances";
  if (scene.objects.size() > UINT32_MAX) return "/scene/objects: more than 2^32 - 1";
  if (city.triangle_slices.size() != scene.triangle_count())
    return "/scene/triangle_slice: not one for each triangle";
  if (city.slices.size() != scene.objects.size()) return "/scene/objects/slices: not one for each object";
  for (const double x : scene.origin)
    if (!std::isfinite(x)) return "/@origin: not finite";
  // Texts are stored padded with NUL.
  const auto has_nul = [](const std::string& text) { return text.find('\0') != std::string::npos; };
  if (has_nul(scene.crs)) return "/@crs: holds a NUL character";
  for (const Object& object : scene.objects)
    if (has_nul(object.name)) return "/scene/objects/name: a name holds a NUL character";
  for (const Part& part : scene.parts)
    if (has_nul(part.name)) return "/scene/parts/name: a name holds a NUL character";
  return {};
}

Defect check_triangles(const std::vector<glm::vec3>& vertices, const std::vector<glm::uvec3>& triangles,
                       const std::vector<Material>& material) {
  if (material.size() != triangles.size()) return "/scene/material: not one for each triangle";
  for (size_t v = 0; v < vertices.size(); ++v)
    if (!finite(vertices[v])) return fmt::format("/scene/vertices: vertex {} is not finite", v);
  for (size_t t = 0; t < triangles.size(); ++t) {
    const glm::uvec3 corner = triangles[t];
    if (std::max({corner.x, corner.y, corner.z}) >= vertices.size())
      return fmt::format("/scene/triangles: triangle {} names a vertex that is not there", t);
    if (material[t] > Material::door) return fmt::format("/scene/material: triangle {}: unknown material", t);
  }
  return {};
}

Defect check_geometry(const Scene& scene) {
  if (Defect defect = check_triangles(scene.vertices, scene.triangles, scene.material)) return defect;
  for (const SharedMesh& mesh : scene.meshes)
    if (Defect defect = check_triangles(mesh.vertices, mesh.triangles, mesh.material)) return defect;
  for (const Instance& instance : scene.instances)
    for (int column = 0; column < 4; ++column)
      for (int row = 0; row < 3; ++row)
        if (!std::isfinite(instance.scene_from_mesh[column][row]))
          return "/scene: an instance whose placement is not finite";
  return {};
}

Defect check_object(const Object& object, SliceCounts n, size_t number) {
  if (object.kind > Kind::other) return fmt::format("/scene/objects/kind: object {}: unknown kind", number);
  if (n.x < 1 || n.y < 1 || n.z < 1 || n.x > 127 || n.y > 127 || n.z > 127)
    return fmt::format("/scene/objects/slices: object {}: not 1 to 127", number);
  return {};
}

Defect check_objects(const City& city) {
  const Scene& scene = city.scene;
  uint64_t end = 0, own = 0;
  for (size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    const Instance* instance = scene.instance_of(i);
    const uint64_t size = object.triangle_end - object.triangle_begin;
    if (object.triangle_begin != end || object.triangle_end < end ||
        object.triangle_end > city.triangle_slices.size() ||
        (instance == nullptr ? object.triangle_end > scene.triangles.size()
                             : size != scene.meshes[instance->mesh].triangles.size()))
      return fmt::format("/scene/objects/triangle_begin: object {} does not follow the one before it", i);
    end = object.triangle_end;
    if (instance == nullptr) own = end;
    const SliceCounts n = city.slices[i];
    if (Defect defect = check_object(object, n, i)) return defect;
    const auto within = [](uint8_t first, uint8_t last, uint8_t count) {
      return first >= 1 && first <= last && last <= count;
    };
    for (uint64_t t = object.triangle_begin; t < end; ++t) {
      const TriangleSlices s = city.triangle_slices[t];
      if (!within(s.x_first, s.x_last, n.x) || !within(s.y_first, s.y_last, n.y) ||
          !within(s.z_first, s.z_last, n.z))
        return fmt::format("/scene/triangle_slice: triangle {} is outside of the slices of object {}", t, i);
    }
  }
  if (own != scene.triangles.size())
    return fmt::format("/scene/objects/triangle_begin: {} of {} triangles belong to an object", own,
                       scene.triangles.size());
  for (size_t i = 0; i < scene.parts.size(); ++i) {
    const Part& part = scene.parts[i];
    if (part.object >= scene.objects.size())
      return fmt::format("/scene/parts/object: part {}: no such object", i);
    const Object& object = scene.objects[part.object];
    if (part.triangle_begin < object.triangle_begin || part.triangle_end < part.triangle_begin ||
        part.triangle_end > object.triangle_end)
      return fmt::format("/scene/parts/triangle_begin: part {} is outside of its object", i);
  }
  return {};
}

Defect check_forest(const OctreeForest& forest, const column::ForestColumns& columns) {
  const size_t roots = forest.roots.size(), nodes = forest.states.size();
  if (forest.first_child.size() != nodes)
    return fmt::format("{}: not one for each node", columns.first_child.path);
  if (!finite(forest.lower) || !std::isfinite(forest.leaf_size_m) || forest.leaf_size_m <= 0 ||
      forest.depth < 1 || forest.depth > octree_depth_limit)
    return fmt::format("{}: its roots are not cubes", columns.group);
  if (roots > nodes) return fmt::format("{}: more than there are nodes", columns.roots.path);
  const auto key = [](const glm::ivec3& r) { return std::tuple(r.z, r.y, r.x); };
  for (size_t r = 0; r < roots; ++r) {
    const glm::ivec3& root = forest.roots[r];
    for (int axis = 0; axis < 3; ++axis)
      if (root[axis] < -root_number_limit || root[axis] > root_number_limit)
        return fmt::format("{}: root {} is too far away", columns.roots.path, r);
    if (r > 0 && key(root) <= key(forest.roots[r - 1]))
      return fmt::format("{}: root {} is not in ascending order", columns.roots.path, r);
  }
  // Children come after their node, so one pass knows each node's level, and no walk can go in a circle.
  std::vector<uint8_t> level(nodes, 0);
  for (size_t i = 0; i < nodes; ++i) {
    const unsigned state = forest.states[i];
    if ((state & (state >> 1) & 0x5555u) != 0)
      return fmt::format("{}: node {}: a child in no known state", columns.states.path, i);
    const uint64_t mixed = static_cast<uint64_t>(std::popcount((state >> 1) & 0x5555u));
    if (level[i] >= forest.depth)
      return fmt::format("{}: node {} is deeper than the tree", columns.states.path, i);
    if (mixed == 0) continue;
    const uint64_t child = forest.first_child[i];
    if (child <= i || child < roots || child + mixed > nodes)
      return fmt::format("{}: node {}: its children are not behind it", columns.first_child.path, i);
    for (uint64_t k = child; k < child + mixed; ++k)
      level[k] = std::max(level[k], static_cast<uint8_t>(level[i] + 1));
  }
  return {};
}

Defect check_ground(const HeightField& ground) {
  if (ground.height.size() != uint64_t{ground.nx} * ground.ny)
    return "/navigation/ground/height: not ny * nx values";
  if (!std::isfinite(ground.lower_x) || !std::isfinite(ground.lower_y) || !std::isfinite(ground.step_m) ||
      ground.step_m <= 0)
    return "/navigation/ground: its grid is not a grid";
  for (const float height : ground.height)
    if (std::isinf(height)) return "/navigation/ground/height: an infinite height";
  return {};
}

Defect check_cells(const std::vector<Box>& cells) {
  if (cells.size() > UINT32_MAX) return "/cells/bounds: more than 2^32 - 1";
  for (size_t i = 0; i < cells.size(); ++i)
    if (!finite(cells[i].lower) || !finite(cells[i].upper) || cells[i].empty())
      return fmt::format("/cells/bounds: cell {} is not a box", i);
  return {};
}

}  // namespace

Defect find_scene_defect(const City& city) {
  if (Defect defect = check_arrays(city)) return defect;
  if (Defect defect = check_geometry(city.scene)) return defect;
  return check_objects(city);
}

Defect find_place_defect(const City& city) {
  if (Defect defect = check_cells(city.cells)) return defect;
  if (Defect defect = check_forest(city.navigation.free, column::free_forest)) return defect;
  if (Defect defect = check_forest(city.navigation.surfaces, column::surface_forest)) return defect;
  return check_ground(city.navigation.ground);
}

Defect find_defect(const City& city) {
  if (Defect defect = find_scene_defect(city)) return defect;
  return find_place_defect(city);
}

Defect find_object_defect(const std::vector<Object>& objects, const std::vector<SliceCounts>& slices,
                          uint64_t triangles) {
  if (objects.size() > UINT32_MAX) return "/scene/objects: more than 2^32 - 1";
  if (slices.size() != objects.size()) return "/scene/objects/slices: not one for each object";
  uint64_t end = 0;
  for (size_t i = 0; i < objects.size(); ++i) {
    if (objects[i].triangle_begin != end || objects[i].triangle_end < end)
      return fmt::format("/scene/objects/triangle_begin: object {} does not follow the one before it", i);
    end = objects[i].triangle_end;
    if (Defect defect = check_object(objects[i], slices[i], i)) return defect;
  }
  if (end != triangles)
    return fmt::format("/scene/objects/triangle_begin: {} of {} triangles belong to an object", end,
                       triangles);
  return {};
}

}  // namespace veduta
