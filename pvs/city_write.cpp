#include "pvs/city_columns.h"

#include <algorithm>
#include <cstring>

namespace veduta {

namespace {

using hdf5::ColumnWriter;
using hdf5::Output;

template <typename T>
void write_rows(Output& output, const Column& column, const std::vector<T>& rows, ColumnDigests& digests) {
  digests[column.path] = hdf5::write_rows(output, column, rows);
}

/// Writes member values of the items of a list as a dataset.
template <typename T, typename Items, typename Member>
void write_members(Output& output, const Column& column, const Items& items, Member member,
                   ColumnDigests& digests) {
  ColumnWriter writer(output, column, items.size());
  for (const auto& item : items) {
    const T value = member(item);
    writer.append(&value, 1);
  }
  digests[column.path] = writer.finish();
}

template <typename Items>
void write_names(Output& output, const Column& column, const Items& items, ColumnDigests& digests) {
  digests[column.path] = hdf5::write_texts(output, column, items.size(),
                                           [&](size_t i) -> const std::string& { return items[i].name; });
}

/// The file holds every triangle that there is to see: instances are placed one by one, so that memory holds
/// one of them.
void write_geometry(Output& output, const Scene& scene, ColumnDigests& digests) {
  uint64_t vertex_count = scene.vertices.size();
  for (const Instance& instance : scene.instances)
    vertex_count += scene.meshes[instance.mesh].vertices.size();
  ColumnWriter vertices(output, column::vertices, vertex_count);
  vertices.append(scene.vertices.data(), scene.vertices.size());
  for (const Instance& instance : scene.instances) {
    const std::vector<glm::vec3> placed = placed_vertices(scene, instance);
    vertices.append(placed.data(), placed.size());
  }
  digests[column::vertices.path] = vertices.finish();

  ColumnWriter triangles(output, column::triangles, scene.triangle_count());
  triangles.append(scene.triangles.data(), scene.triangles.size());
  uint32_t first_vertex = static_cast<uint32_t>(scene.vertices.size());
  for (const Instance& instance : scene.instances) {
    std::vector<glm::uvec3> placed = placed_triangles(scene, instance);
    for (glm::uvec3& triangle : placed) triangle += first_vertex;
    triangles.append(placed.data(), placed.size());
    first_vertex += static_cast<uint32_t>(scene.meshes[instance.mesh].vertices.size());
  }
  digests[column::triangles.path] = triangles.finish();

  ColumnWriter material(output, column::material, scene.triangle_count());
  material.append(scene.material.data(), scene.material.size());
  for (const Instance& instance : scene.instances) {
    const std::vector<Material>& shared = scene.meshes[instance.mesh].material;
    material.append(shared.data(), shared.size());
  }
  digests[column::material.path] = material.finish();
}

}  // namespace

void write_scene_groups(Output& output) {
  for (const char* group : {"/scene", "/scene/objects", "/scene/parts"}) output.group(group);
}

void write_scene_columns(Output& output, const City& city, ColumnDigests& digests) {
  const Scene& scene = city.scene;
  write_scene_groups(output);
  static_assert(sizeof(glm::vec3) == 12 && sizeof(glm::uvec3) == 12 && sizeof(Box) == 24 &&
                sizeof(SliceCounts) == 3);
  write_geometry(output, scene, digests);
  write_rows(output, column::triangle_slice, city.triangle_slices, digests);
  write_names(output, column::object_name, scene.objects, digests);
  write_members<Kind>(
      output, column::object_kind, scene.objects, [](const Object& o) { return o.kind; }, digests);
  std::vector<Box> bounds;
  for (size_t o = 0; o < scene.objects.size(); ++o) bounds.push_back(scene.bounds(o));
  write_rows(output, column::object_bounds, bounds, digests);
  std::vector<uint64_t> begin{0};
  for (const Object& object : scene.objects) begin.push_back(object.triangle_end);
  write_rows(output, column::object_begin, begin, digests);
  write_rows(output, column::object_slices, city.slices, digests);
  write_names(output, column::part_name, scene.parts, digests);
  write_members<uint32_t>(
      output, column::part_object, scene.parts, [](const Part& p) { return p.object; }, digests);
  write_members<uint64_t>(
      output, column::part_begin, scene.parts, [](const Part& p) { return p.triangle_begin; }, digests);
  write_members<uint64_t>(
      output, column::part_end, scene.parts, [](const Part& p) { return p.triangle_end; }, digests);
}

namespace {

void write_lattice(Output& output, const char* group, const OctreeForest& forest) {
  output.group(group);
  output.attribute(group, "lower", std::vector<float>{forest.lower.x, forest.lower.y, forest.lower.z});
  output.attribute(group, "leaf_size_m", std::vector<float>{forest.leaf_size_m});
  output.attribute(group, "depth", forest.depth);
}

void write_forest(Output& output, const column::ForestColumns& columns, const OctreeForest& forest,
                  ColumnDigests& digests) {
  static_assert(sizeof(glm::ivec3) == 12);
  write_rows(output, columns.roots, forest.roots, digests);
  write_rows(output, columns.states, forest.states, digests);
  write_rows(output, columns.first_child, forest.first_child, digests);
}

void write_navigation(Output& output, const Navigation& navigation, ColumnDigests& digests) {
  write_forest(output, column::free_forest, navigation.free, digests);
  write_forest(output, column::surface_forest, navigation.surfaces, digests);
  const HeightField& ground = navigation.ground;
  const uint32_t nx = ground.height.empty() ? 0 : ground.nx, ny = ground.height.empty() ? 0 : ground.ny;
  ColumnWriter writer(output, column::ground_height, ny, 0, nx);
  writer.append(ground.height.data(), ny);
  digests[column::ground_height.path] = writer.finish();
}

}  // namespace

void write_place_groups(Output& output, const Navigation& lattices) {
  output.group("/navigation");
  write_lattice(output, column::free_forest.group, lattices.free);
  write_lattice(output, column::surface_forest.group, lattices.surfaces);
  constexpr const char* ground = "/navigation/ground";
  output.group(ground);
  output.attribute(ground, "lower", std::vector<float>{lattices.ground.lower_x, lattices.ground.lower_y});
  output.attribute(ground, "step_m", std::vector<float>{lattices.ground.step_m});
  output.group("/cells");
}

void write_place_columns(Output& output, const City& city, ColumnDigests& digests) {
  write_place_groups(output, city.navigation);
  write_navigation(output, city.navigation, digests);
  write_rows(output, column::cell_bounds, city.cells, digests);
}

void write_root(Output& output, const RootAttributes& root) {
  output.attribute("/", "format", root.format);
  output.attribute("/", "version", root.version);
  output.attribute("/", "unit", root.unit);
  output.attribute("/", "up", root.up);
  output.attribute("/", "crs", root.crs);
  output.attribute("/", "origin", root.origin);
  output.attribute("/", "fingerprint", root.header.fingerprint);
  output.attribute("/", "config", root.header.config);
  output.attribute("/", "renderer", root.header.renderer);
  output.attribute("/", "complete", static_cast<uint8_t>(root.header.complete));
  output.attribute("/", "conservative", static_cast<uint8_t>(root.header.conservative));
  output.attribute("/", "content_digest", root.content_digest);
  output.attribute("/", "header_digest", header_digest(root));
}

}  // namespace veduta
