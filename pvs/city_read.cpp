#include <fmt/format.h>

#include <cstring>

#include "pvs/city_columns.h"
#include "pvs/pvs_check.h"
#include "scene/error.h"
#include "scene/text.h"

namespace veduta {

namespace {

using hdf5::ColumnReader;
using hdf5::Input;

template <typename T>
std::vector<T> read_rows(const Input& input, const Column& column, ColumnDigests& digests) {
  std::vector<T> rows;
  digests[column.path] = ColumnReader(input, column).read_into(rows);
  return rows;
}

/// Reads a dataset into one member of each item of a list that has its size already.
template <typename T, typename Items, typename Set>
void read_members(const Input& input, const Column& column, Items& items, Set set, ColumnDigests& digests) {
  const std::vector<T> values = read_rows<T>(input, column, digests);
  if (values.size() != items.size())
    input.fail(column.path, fmt::format("{} values for {}", values.size(), items.size()));
  for (size_t i = 0; i < values.size(); ++i) set(items[i], values[i]);
}

template <typename Items>
void read_names(const Input& input, const Column& column, Items& items, ColumnDigests& digests) {
  std::vector<std::string> names;
  digests[column.path] = ColumnReader(input, column).read_texts(names);
  items.resize(names.size());
  for (size_t i = 0; i < names.size(); ++i) items[i].name = std::move(names[i]);
}

std::vector<Box> read_scene(const Input& input, City& city, ColumnDigests& digests) {
  Scene& scene = city.scene;
  scene.vertices = read_rows<glm::vec3>(input, column::vertices, digests);
  scene.triangles = read_rows<glm::uvec3>(input, column::triangles, digests);
  scene.material = read_rows<Material>(input, column::material, digests);
  city.triangle_slices = read_rows<TriangleSlices>(input, column::triangle_slice, digests);
  std::vector<Box> bounds = read_object_columns(input, city, digests);
  read_names(input, column::part_name, scene.parts, digests);
  read_members<uint32_t>(
      input, column::part_object, scene.parts, [](Part& p, uint32_t object) { p.object = object; }, digests);
  read_members<uint64_t>(
      input, column::part_begin, scene.parts, [](Part& p, uint64_t t) { p.triangle_begin = t; }, digests);
  read_members<uint64_t>(
      input, column::part_end, scene.parts, [](Part& p, uint64_t t) { p.triangle_end = t; }, digests);
  return bounds;
}

void pass_over(const Input& input, const Column& column, ColumnDigests& digests) {
  digests[column.path] = ColumnReader(input, column).stated_digest();
}

void read_lattice(const Input& input, const char* group, OctreeForest& forest) {
  const auto lower = input.floats(group, "lower", 3);
  forest.lower = {lower[0], lower[1], lower[2]};
  forest.leaf_size_m = input.floats(group, "leaf_size_m", 1)[0];
  forest.depth = input.number(group, "depth");
}

void read_forest(const Input& input, const column::ForestColumns& columns, OctreeForest& forest, bool nodes,
                 ColumnDigests& digests) {
  if (!nodes) {
    for (const Column& column : {columns.roots, columns.states, columns.first_child})
      pass_over(input, column, digests);
    return;
  }
  forest.roots = read_rows<glm::ivec3>(input, columns.roots, digests);
  forest.states = read_rows<uint16_t>(input, columns.states, digests);
  forest.first_child = read_rows<uint32_t>(input, columns.first_child, digests);
}

void read_navigation(const Input& input, CityParts parts, Navigation& navigation, ColumnDigests& digests) {
  const bool all = parts == CityParts::all;
  read_lattices(input, navigation);
  read_forest(input, column::free_forest, navigation.free, parts != CityParts::to_look_up, digests);
  read_forest(input, column::surface_forest, navigation.surfaces, all, digests);
  HeightField& ground = navigation.ground;
  if (!all) return pass_over(input, column::ground_height, digests);
  const ColumnReader height(input, column::ground_height);
  if (height.rows() > UINT32_MAX || height.columns() > UINT32_MAX)
    input.fail(column::ground_height.path, "more than 2^32 - 1 samples along an axis");
  ground.nx = static_cast<uint32_t>(height.columns());
  ground.ny = static_cast<uint32_t>(height.rows());
  ground.height.resize(height.rows() * height.columns());
  digests[column::ground_height.path] = height.read([&](const std::byte* rows, uint64_t first, size_t count) {
    std::memcpy(ground.height.data() + first * height.columns(), rows, count * height.row_bytes());
  });
}

}  // namespace

void read_lattices(const Input& input, Navigation& navigation) {
  read_lattice(input, column::free_forest.group, navigation.free);
  read_lattice(input, column::surface_forest.group, navigation.surfaces);
  const auto corner = input.floats("/navigation/ground", "lower", 2);
  navigation.ground.lower_x = corner[0];
  navigation.ground.lower_y = corner[1];
  navigation.ground.step_m = input.floats("/navigation/ground", "step_m", 1)[0];
}

void read_navigation_columns(const Input& input, Navigation& navigation) {
  ColumnDigests digests;
  read_navigation(input, CityParts::all, navigation, digests);
}

std::vector<Box> read_object_columns(const Input& input, City& city, ColumnDigests& digests) {
  std::vector<Object>& objects = city.scene.objects;
  read_names(input, column::object_name, objects, digests);
  read_members<Kind>(
      input, column::object_kind, objects, [](Object& o, Kind kind) { o.kind = kind; }, digests);
  const auto begin = read_rows<uint64_t>(input, column::object_begin, digests);
  if (begin.size() != objects.size() + 1 || begin.front() != 0)
    input.fail(column::object_begin.path, "not one more than there are objects, from 0 on");
  for (size_t i = 0; i < objects.size(); ++i) {
    objects[i].triangle_begin = begin[i];
    objects[i].triangle_end = begin[i + 1];
  }
  city.slices = read_rows<SliceCounts>(input, column::object_slices, digests);
  std::vector<Box> bounds = read_rows<Box>(input, column::object_bounds, digests);
  if (bounds.size() != objects.size()) input.fail(column::object_bounds.path, "not one for each object");
  return bounds;
}

void read_place_columns(const Input& input, City& city, ColumnDigests& digests, CityParts parts) {
  read_navigation(input, parts, city.navigation, digests);
  city.cells = read_rows<Box>(input, column::cell_bounds, digests);
}

City read_city_columns(const Input& input, ColumnDigests& digests, std::vector<Box>& bounds,
                       CityParts parts) {
  City city;
  bounds = read_scene(input, city, digests);
  read_place_columns(input, city, digests, parts);
  return city;
}

RootAttributes read_root(const Input& input, const std::string& format) {
  RootAttributes root;
  root.format = input.text("/", "format");
  if (root.format != format)
    input.fail("/@format", fmt::format("\"{}\", this program reads \"{}\" here; was the right file given?",
                                       printable(root.format), format));
  root.version = input.number("/", "version");
  const uint32_t ours = format == pvs_format ? pvs_version : city_version;
  if (root.version != ours)
    input.fail("/@version", fmt::format("version {}, this program reads {}; {}", root.version, ours,
                                        root.version == 3 ? "merge its run directory again, or bake again"
                                                          : "use the version that wrote it, or bake again"));
  root.unit = input.text("/", "unit");
  root.up = input.text("/", "up");
  if (root.unit != "m" || root.up != "z") input.fail("/@unit", "not in metres with z up");
  root.crs = input.text("/", "crs");
  root.origin = input.doubles("/", "origin");
  root.header.fingerprint = input.text("/", "fingerprint");
  root.header.config = input.text("/", "config");
  root.header.renderer = input.text("/", "renderer");
  root.header.complete = input.flag("/", "complete") != 0;
  root.header.conservative = input.flag("/", "conservative") != 0;
  root.content_digest = input.text("/", "content_digest");
  if (input.text("/", "header_digest") != header_digest(root))
    input.fail("/@header_digest", "an attribute of the root is damaged; get the file again, or bake again");
  return root;
}

}  // namespace veduta
