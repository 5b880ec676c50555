#include <fmt/format.h>

#include <cstring>

#include "pvs/cell_columns.h"
#include "pvs/city_columns.h"
#include "pvs/pvs_check.h"
#include "pvs/verification_columns.h"
#include "scene/error.h"

namespace veduta {

namespace {

using hdf5::ColumnReader;
using hdf5::Input;

void read_entries(const Input& input, std::vector<PvsEntry>& entries, ColumnDigests& digests) {
  const ColumnReader object(input, column::pvs_object);
  const ColumnReader index(input, column::pvs_index);
  if (object.rows() != index.rows())
    input.fail(column::pvs_index.path, "not one for each object of /pvs/object");
  entries.resize(object.rows());
  digests[column::pvs_object.path] = object.read([&](const std::byte* rows, uint64_t first, size_t count) {
    for (size_t i = 0; i < count; ++i) std::memcpy(&entries[first + i].object, rows + 4 * i, 4);
  });
  digests[column::pvs_index.path] = index.read([&](const std::byte* rows, uint64_t first, size_t count) {
    for (size_t i = 0; i < count; ++i) std::memcpy(&entries[first + i].index, rows + 3 * i, 3);
  });
}

/// The city with its root, every relation and the content digest checked.
void finish_city(const Input& input, const RootAttributes& root, const ColumnDigests& digests, City& city) {
  city.scene.crs = root.crs;
  city.scene.origin = root.origin;
  input.refuse(find_defect(city));
  if (content_digest(city, root.header.conservative, digests) != root.content_digest)
    input.fail("/@content_digest", "does not hold; get the file again, or bake again");
}

City read_prepared(const std::filesystem::path& path, CityParts parts) {
  const Input input(path);
  const RootAttributes root = read_root(input, city_format);
  ColumnDigests digests;
  City city = read_city_columns(input, digests, parts);
  finish_city(input, root, digests, city);
  return city;
}

}  // namespace

PvsFile read_pvs(const std::filesystem::path& path) {
  const Input input(path);
  const RootAttributes root = read_root(input, pvs_format);
  ColumnDigests digests;
  PvsFile file;
  file.header = root.header;
  file.content_digest = root.content_digest;
  file.city = read_city_columns(input, digests);
  read_cell_columns(input, file, digests);
  read_entries(input, file.entries, digests);
  finish_city(input, root, digests, file.city);
  input.refuse(find_row_defect(file));
  if (input.has(verification_group)) {
    file.verification = read_verification(input, root.content_digest);
    input.refuse(find_defect(*file.verification, file.city.cells.size(), file.city.scene.objects));
  }
  file.index_cells();
  return file;
}

City read_city(const std::filesystem::path& path) {
  return read_prepared(path, CityParts::all);
}

City read_city_to_bake(const std::filesystem::path& path) {
  return read_prepared(path, CityParts::to_bake);
}

}  // namespace veduta
