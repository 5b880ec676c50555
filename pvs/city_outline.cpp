// A prepared city without its geometry, for who copies it.
#include <cstring>
#include <string_view>

#include "pvs/city_columns.h"
#include "pvs/pvs_check.h"

namespace veduta {

namespace {

/// Does a prepared city have it?
bool of_city(const Column& column) {
  const std::string_view path = column.path;
  return path.starts_with("/scene/") || path.starts_with("/navigation/") || path == column::cell_bounds.path;
}

}  // namespace

void copy_city(hdf5::Output& output, const hdf5::Input& from, const CityOutline& city) {
  output.require_space(from.file_bytes());
  write_scene_groups(output);
  write_place_groups(output, city.frame.navigation);
  for (const Column* column : column::all)
    if (of_city(*column)) hdf5::copy_column(output, from, *column);
}

CityOutline read_city_outline(const std::filesystem::path& city_file, const WorkHeard& heard) {
  const hdf5::Input input(city_file);
  const RootAttributes root = read_root(input, city_format);
  CityOutline city;
  city.frame.scene.crs = root.crs;
  city.frame.scene.origin = root.origin;
  read_lattices(input, city.frame.navigation);
  std::vector<const Column*> columns;
  for (const Column* column : column::all)
    if (of_city(*column)) columns.push_back(column);
  read_columns(input, columns, city.digests, "the city", heard);
  hdf5::ColumnReader(input, column::object_slices).read_into(city.slices);
  city.cells = hdf5::ColumnReader(input, column::cell_bounds).rows();
  if (city.cells > UINT32_MAX) input.fail(column::cell_bounds.path, "more than 2^32 - 1");
  if (content_digest(city.frame, root.header.conservative, city.digests) != root.content_digest)
    input.fail("/@content_digest", "does not hold; prepare the city again with --fresh");
  return city;
}

}  // namespace veduta
