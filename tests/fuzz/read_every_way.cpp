#include "tests/fuzz/read_every_way.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>

#include "pvs/index_ranges.h"
#include "pvs/pvs_stream.h"
#include "scene/error.h"
#include "tests/fuzz/read_by_library.h"

namespace veduta::test {

namespace {

// Enough for every file of a corpus; what a mutant claims to have more of is not followed to its end.
constexpr size_t most_questions = 500;

void require_refusal(const Error& error, const std::filesystem::path& file) {
  const std::string message = error.what();
  if (error.status() != ExitStatus::bad_input)
    throw BrokenPromise(fmt::format("status {}: {}", static_cast<int>(error.status()), message));
  if (message.find('\n') != std::string::npos) throw BrokenPromise("more than one line: " + message);
  if (!message.starts_with(file.string() + ": /")) throw BrokenPromise("names no file and place: " + message);
}

/// find_cell by the grid and by looking at every cell.
void require_same_cells(const PvsFile& file) {
  const std::vector<Box>& cells = file.city.cells;
  const size_t step = 1 + cells.size() / most_questions;
  for (size_t c = 0; c < cells.size(); c += step)
    for (const glm::vec3& point : {cells[c].lower, cells[c].center(), cells[c].upper}) {
      const auto first =
          std::find_if(cells.begin(), cells.end(), [&](const Box& cell) { return cell.contains(point); });
      const int64_t expected = first == cells.end() ? -1 : std::distance(cells.begin(), first);
      if (file.find_cell(point) != expected)
        throw BrokenPromise(fmt::format("find_cell says {} in place of {}", file.find_cell(point), expected));
    }
}

/// The ranges that an entry draws hold the triangles that its three bytes name.
void require_same_ranges(const PvsFile& file) {
  const City& city = file.city;
  const TriangleOrders orders = triangle_orders(city);
  const SliceRanges ranges(city);
  const size_t step = 1 + file.entries.size() / most_questions;
  for (size_t k = 0; k < file.entries.size(); k += step) {
    const PvsEntry entry = file.entries[k];
    const Object& object = city.scene.objects[entry.object];
    std::set<uint64_t> named, drawn;
    for (uint64_t t = object.triangle_begin; t < object.triangle_end; ++t)
      if (draws(entry.index, city.triangle_slices[t])) named.insert(t);
    const ObjectRanges found = ranges.ranges(entry.object, entry.index);
    for (uint8_t r = 0; r < found.count; ++r)
      for (uint64_t i = found.range[r].begin; i < found.range[r].end; ++i)
        drawn.insert(orders[static_cast<size_t>(found.range[r].order)][i]);
    if (named != drawn) throw BrokenPromise(fmt::format("entry {}: its ranges draw other triangles", k));
  }
}

/// All that a stream gives, in an order that is not the file's.
PvsFile read_by_pieces(PvsStream& stream) {
  stream.read_navigation();
  const PvsIndex& index = stream.index();
  PvsFile file;
  const auto objects = static_cast<uint32_t>(index.objects.size());
  const auto rows = static_cast<uint32_t>(index.row_begin.size() - 1);
  for (uint32_t row = rows; row-- > 0;) {
    const PvsRow entries = stream.read_row(row);
    file.entries.insert(file.entries.end(), entries.rbegin(), entries.rend());
  }
  std::reverse(file.entries.begin(), file.entries.end());
  for (uint32_t first = objects; first > 0;) {
    const uint32_t last = first;
    first -= std::min(first, 1 + objects / 3);
    stream.read_objects(first, last);
  }
  file.city = stream.read_objects(0, objects);
  file.city.scene.crs = index.crs;
  file.city.scene.origin = index.origin;
  file.city.slices = index.slices;
  file.city.cells = index.cells;
  file.city.navigation = index.navigation;
  file.header = index.header;
  file.cell_row = index.cell_row;
  file.cell_status = index.cell_status;
  file.bake_us = index.bake_us;
  file.overestimate = index.overestimate;
  file.cell_worker = index.cell_worker;
  file.workers = index.workers;
  file.row_begin = index.row_begin;
  file.content_digest = index.content_digest;
  file.verification = index.verification;
  file.grid = index.grid;
  for (uint32_t i = 0; i < objects; ++i)
    if (file.city.scene.bounds(i) != index.bounds[i])
      throw BrokenPromise(fmt::format("object {}: its bounds are not those of its triangles", i));
  return file;
}

}  // namespace

Reading read_every_way(const std::filesystem::path& file) {
  Reading reading;
  try {
    reading.whole = read_pvs(file);
    describe(*reading.whole, file);
    describe_json(*reading.whole, file);
  } catch (const Error& error) {
    require_refusal(error, file);
    reading.whole.reset();
    reading.whole_error = error.what();
  }
  try {
    PvsStream stream(file);
    reading.stream_opened = true;
    reading.streamed = read_by_pieces(stream);
    require_same_cells(*reading.streamed);
  } catch (const Error& error) {
    require_refusal(error, file);
    reading.stream_error = error.what();
  }
  reading.library_error = read_by_library(file, reading.whole ? &*reading.whole : nullptr);
  if (!reading.whole) return reading;
  if (!reading.library_error.empty())
    throw BrokenPromise("only the library refuses: " + reading.library_error);
  if (!reading.streamed) throw BrokenPromise("only the stream refuses: " + reading.stream_error);
  if (const std::string where = difference(*reading.whole, *reading.streamed); !where.empty())
    throw BrokenPromise("the stream read something else: " + where);
  require_same_cells(*reading.whole);
  require_same_ranges(*reading.whole);
  return reading;
}

}  // namespace veduta::test
