#include <fmt/format.h>

#include <cstring>

#include "pvs/cell_columns.h"
#include "pvs/city_columns.h"
#include "pvs/form_columns.h"
#include "pvs/pvs_check.h"
#include "pvs/verification_columns.h"
#include "scene/error.h"

namespace veduta {

namespace {

using hdf5::ColumnReader;
using hdf5::Input;

/// Steps and forms become objects and their three bytes in place: entries are most of what a file takes in
/// memory. Cells and slices are there.
void read_entries(const Input& input, PvsFile& file, ColumnDigests& digests) {
  std::vector<PvsEntry>& entries = file.entries;
  const ColumnReader step(input, column::pvs_object_step);
  const ColumnReader form(input, column::pvs_form);
  if (form.rows() != step.rows()) input.fail(column::pvs_form.path, "not one for each of /pvs/object_step");
  entries.resize(step.rows());
  digests[column::pvs_object_step.path] = step.read([&](const std::byte* rows, uint64_t first, size_t count) {
    for (size_t i = 0; i < count; ++i) std::memcpy(&entries[first + i].object, rows + 4 * i, 4);
  });
  input.refuse(find_row_defect(file));
  for (size_t r = 0; r + 1 < file.row_begin.size(); ++r)
    if (const auto defect = sum_steps(entries.data() + file.row_begin[r],
                                      entries.data() + file.row_begin[r + 1], file.city.slices.size()))
      input.fail(column::pvs_object_step.path, fmt::format("row {}: {}", r, *defect));
  const Forms forms = read_forms(input, file.city.slices, digests);
  digests[column::pvs_form.path] = form.read([&](const std::byte* rows, uint64_t first, size_t count) {
    for (size_t i = 0; i < count; ++i) {
      uint16_t number = 0;
      std::memcpy(&number, rows + 2 * i, 2);
      if (!forms.set(number, entries[first + i]))
        input.fail(column::pvs_form.path, fmt::format("entry {}: no such form of its object", first + i));
    }
  });
}

/// The city with its root, every relation and the content digest checked. `bounds`: of its objects, as
/// stated.
void finish_city(const Input& input, const RootAttributes& root, const ColumnDigests& digests,
                 const std::vector<Box>& bounds, City& city) {
  city.scene.crs = root.crs;
  city.scene.origin = root.origin;
  input.refuse(find_defect(city));
  for (size_t i = 0; i < bounds.size(); ++i)
    if (city.scene.bounds(i) != bounds[i])
      input.fail(column::object_bounds.path, fmt::format("object {}: not those of its triangles", i));
  if (content_digest(city, root.header.conservative, digests) != root.content_digest)
    input.fail("/@content_digest", "does not hold; get the file again, or bake again");
}

City read_prepared(const std::filesystem::path& path, CityParts parts) {
  const Input input(path);
  const RootAttributes root = read_root(input, city_format);
  ColumnDigests digests;
  std::vector<Box> bounds;
  City city = read_city_columns(input, digests, bounds, parts);
  finish_city(input, root, digests, bounds, city);
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
  std::vector<Box> bounds;
  file.city = read_city_columns(input, digests, bounds);
  read_cell_columns(input, file, digests);
  read_entries(input, file, digests);
  finish_city(input, root, digests, bounds, file.city);
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
