#include "pvs/pvs_stream.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "pvs/cell_columns.h"
#include "pvs/city_columns.h"
#include "pvs/form_columns.h"
#include "pvs/hdf5_window.h"
#include "pvs/pvs_check.h"
#include "pvs/verification_columns.h"
#include "pvs/vertex_numbers.h"

namespace veduta {

using hdf5::ColumnReader;
using hdf5::ColumnWindow;
using hdf5::Input;

namespace {

/// Of a block that is being read: as it is stored, shuffled, and whole.
constexpr uint64_t unpacking_bytes = 3 * chunk_bytes;

}  // namespace

struct PvsStream::Open {
  Open(const std::filesystem::path& file, uint64_t memory_bytes)
      : input(file), cache(memory_bytes - std::min(memory_bytes, unpacking_bytes)) {}

  /// \throw Error(bad_input) where datasets that belong together are of different lengths.
  void same_rows(const ColumnWindow& one, const ColumnWindow& other, const Column& place) const {
    if (one.reader().rows() != other.reader().rows())
      input.fail(place.path, "not as long as those beside it");
  }

  Input input;
  RootAttributes root = read_root(input, pvs_format);  // before datasets, of which another version has others
  BlockCache cache;
  ColumnWindow vertices{input, column::vertices, cache};
  ColumnWindow triangles{input, column::triangles, cache};
  ColumnWindow material{input, column::material, cache};
  ColumnWindow triangle_slices{input, column::triangle_slice, cache};
  ColumnWindow entry_step{input, column::pvs_object_step, cache};
  ColumnWindow entry_form{input, column::pvs_form, cache};
  Forms forms;  ///< of all objects: 8 bytes an object and 3 a form
};

namespace {

/// What is not looked at as the file is opened: its digests are taken as they are stated. That they are the
/// file's own is what the content digest says.
void state_the_rest(const Input& input, ColumnDigests& digests) {
  for (const Column& column :
       {column::vertices, column::triangles, column::material, column::triangle_slice, column::part_name,
        column::part_object, column::part_begin, column::part_end, column::pvs_object_step, column::pvs_form})
    digests[column.path] = ColumnReader(input, column).stated_digest();
}

}  // namespace

PvsStream::PvsStream(const std::filesystem::path& file, uint64_t memory_bytes)
    : open_(std::make_unique<Open>(file, memory_bytes)) {
  const Input& input = open_->input;
  const RootAttributes& root = open_->root;
  index_.header = root.header;
  index_.crs = root.crs;
  index_.origin = root.origin;
  index_.content_digest = root.content_digest;

  ColumnDigests digests;
  City city;
  city.scene.crs = root.crs;
  city.scene.origin = root.origin;
  index_.bounds = read_object_columns(input, city, digests);
  read_place_columns(input, city, digests, CityParts::to_look_up);
  read_cell_columns(input, index_, digests);
  open_->forms = read_forms(input, city.slices, digests);
  state_the_rest(input, digests);
  if (content_digest(city, root.header.conservative, digests) != root.content_digest)
    input.fail("/@content_digest", "does not hold; get the file again, or bake again");

  open_->same_rows(open_->triangles, open_->material, column::material);
  open_->same_rows(open_->triangles, open_->triangle_slices, column::triangle_slice);
  open_->same_rows(open_->entry_step, open_->entry_form, column::pvs_form);
  input.refuse(find_object_defect(city.scene.objects, city.slices, open_->triangles.reader().rows()));
  input.refuse(find_place_defect(city));
  index_.objects = std::move(city.scene.objects);
  index_.slices = std::move(city.slices);
  index_.cells = std::move(city.cells);
  index_.navigation = std::move(city.navigation);
  input.refuse(find_row_defect(index_, open_->entry_step.reader().rows()));
  if (input.has(verification_group)) {
    index_.verification = read_verification(input, root.content_digest);
    input.refuse(find_defect(*index_.verification, index_.cells.size(), index_.objects));
  }
  index_.grid = CellGrid(index_.cells);
}

PvsStream::~PvsStream() = default;
PvsStream::PvsStream(PvsStream&&) noexcept = default;
PvsStream& PvsStream::operator=(PvsStream&&) noexcept = default;

void PvsStream::read_navigation() {
  hdf5::prepare_library();
  City city;
  read_navigation_columns(open_->input, city.navigation);
  open_->input.refuse(find_place_defect(city));
  index_.navigation = std::move(city.navigation);
}

uint64_t PvsStream::kept_bytes() const {
  return open_->cache.bytes();
}

PvsRow PvsStream::read_row(uint32_t row) const {
  PvsRow out;
  read_row(row, out);
  return out;
}

void PvsStream::read_row(uint32_t row, PvsRow& out) const {
  const uint64_t first = index_.row_begin[row], count = index_.row_begin[row + 1] - first;
  if (count > index_.objects.size())
    open_->input.fail(column::pvs_begin.path, fmt::format("row {} lists more than there are objects", row));
  keeps_row(row);  // so that steps and forms come from memory together, not one after the other
  out.resize(count);
  PvsEntry* entry = out.data();
  open_->entry_step.visit(first, count, [&](const std::byte* steps, uint64_t here) {
    for (uint64_t i = 0; i < here; ++i, ++entry) std::memcpy(&entry->object, steps + 4 * i, 4);
  });
  if (const auto defect = sum_steps(out.data(), out.data() + count, index_.objects.size()))
    open_->input.fail(column::pvs_object_step.path, fmt::format("row {}: {}", row, *defect));
  entry = out.data();
  open_->entry_form.visit(first, count, [&](const std::byte* forms, uint64_t here) {
    for (uint64_t i = 0; i < here; ++i, ++entry) {
      uint16_t form = 0;
      std::memcpy(&form, forms + 2 * i, 2);
      if (!open_->forms.set(form, *entry))
        open_->input.fail(column::pvs_form.path,
                          fmt::format("row {}: no such form of object {}", row, entry->object));
    }
  });
}

bool PvsStream::keeps_row(uint32_t row) const {
  const uint64_t first = index_.row_begin[row], count = index_.row_begin[row + 1] - first;
  const bool steps = open_->entry_step.fetch_kept(first, count);
  return open_->entry_form.fetch_kept(first, count) && steps;
}

City PvsStream::read_objects(uint32_t first, uint32_t last) const {
  hdf5::prepare_library();
  const Input& input = open_->input;
  City city;
  Scene& scene = city.scene;
  scene.crs = index_.crs;
  scene.origin = index_.origin;
  if (first >= last) return city;
  scene.objects.assign(index_.objects.begin() + first, index_.objects.begin() + last);
  city.slices.assign(index_.slices.begin() + first, index_.slices.begin() + last);
  const uint64_t begin = scene.objects.front().triangle_begin;
  const uint64_t count = scene.objects.back().triangle_end - begin;
  for (Object& object : scene.objects) object.triangle_begin -= begin, object.triangle_end -= begin;
  scene.triangles = open_->triangles.read<glm::uvec3>(begin, count);
  scene.material = open_->material.read<Material>(begin, count);
  city.triangle_slices = open_->triangle_slices.read<TriangleSlices>(begin, count);

  const uint64_t vertices = open_->vertices.reader().rows();
  for (size_t t = 0; t < count; ++t)
    if (std::max({scene.triangles[t].x, scene.triangles[t].y, scene.triangles[t].z}) >= vertices)
      input.fail(column::triangles.path,
                 fmt::format("triangle {} names a vertex that is not there", begin + t));
  const std::vector<VertexRun> runs = number_from_zero(scene.triangles);
  for (const VertexRun& run : runs) scene.vertices.resize(scene.vertices.size() + run.count);
  glm::vec3* out = scene.vertices.data();
  for (const VertexRun& run : runs) {
    open_->vertices.read(run.first, run.count, out);
    out += run.count;
  }
  input.refuse(find_scene_defect(city));
  // Checksums say nothing of a chunk that took the place of another on purpose: then the bounds, whose digest
  // was compared, are not those of the triangles.
  for (uint32_t i = first; i < last; ++i)
    if (scene.bounds(i - first) != index_.bounds[i])
      input.fail(column::vertices.path,
                 fmt::format("object {} lies outside of its bounds; get the file again", i));
  return city;
}

}  // namespace veduta
