#include "tests/fuzz/read_by_library.h"

#include <algorithm>
#include <array>
#include <set>

#include "pvs/library/veduta/pvs.h"
#include "tests/fuzz/read_every_way.h"

namespace veduta::test {

namespace {

using Corners = std::array<pvs::Point, 3>;

constexpr size_t most_rows = 200, most_entries = 200;

void require(bool holds, const char* what) {
  if (!holds) throw BrokenPromise(std::string("the library: ") + what);
}

/// What ranges draw, as corners of triangles; every range has to lie in the indices.
std::multiset<Corners> drawn_by(const pvs::Geometry& geometry, const pvs::Entry& entry) {
  std::vector<pvs::DrawRange> ranges;
  geometry.add_ranges(entry, ranges);
  std::set<std::array<uint32_t, 3>> drawn;  // ranges of an entry may overlap
  for (const pvs::DrawRange& range : ranges) {
    require(range.first <= geometry.indices.size() && range.count <= geometry.indices.size() - range.first &&
                range.count % 3 == 0,
            "a range outside of the indices");
    for (uint64_t i = range.first; i < range.first + range.count; i += 3)
      drawn.insert({geometry.indices[i], geometry.indices[i + 1], geometry.indices[i + 2]});
  }
  std::multiset<Corners> corners;
  for (const auto& [a, b, c] : drawn) {
    require(std::max({a, b, c}) < geometry.vertices.size(), "an index of no vertex");
    corners.insert({geometry.vertices[a], geometry.vertices[b], geometry.vertices[c]});
  }
  return corners;
}

std::multiset<Corners> named_by(const City& city, const PvsEntry& entry) {
  const Scene& scene = city.scene;
  const Object& object = scene.objects[entry.object];
  std::set<std::array<uint32_t, 3>> named;
  for (uint64_t t = object.triangle_begin; t < object.triangle_end; ++t)
    if (draws(entry.index, city.triangle_slices[t]))
      named.insert({scene.triangles[t].x, scene.triangles[t].y, scene.triangles[t].z});
  std::multiset<Corners> corners;
  for (const auto& triangle : named) {
    Corners points;
    for (size_t i = 0; i < 3; ++i) {
      const glm::vec3& v = scene.vertices[triangle[i]];
      points[i] = {v.x, v.y, v.z};
    }
    corners.insert(points);
  }
  return corners;
}

void require_same(const pvs::City& city, const PvsFile& whole) {
  require(city.object_count() == whole.city.scene.objects.size(), "another number of objects");
  require(city.cell_count() == whole.city.cells.size(), "another number of cells");
  require(city.content_digest() == whole.content_digest, "another content digest");
  for (uint32_t i = 0; i < city.object_count(); ++i)
    require(city.object(i).name == whole.city.scene.objects[i].name, "another name");
  const pvs::Geometry geometry = city.read_geometry(0, city.object_count());
  pvs::Row row;
  size_t entries = 0;
  for (uint32_t c = 0; c < std::min<size_t>(city.cell_count(), most_rows); ++c) {
    city.read_row(c, row);
    const PvsFile::Span expected = whole.row(c);
    require(row.size() == expected.size(), "a row of another length");
    for (size_t i = 0; i < row.size(); ++i) {
      const PvsEntry& entry = expected.begin()[i];
      require(row[i] == pvs::Entry{entry.object, entry.index.x, entry.index.y, entry.index.z},
              "another entry");
      if (entries++ < most_entries)
        require(drawn_by(geometry, row[i]) == named_by(whole.city, entry),
                "an entry that draws other triangles");
    }
    const Box& cell = whole.city.cells[c];
    const int64_t found = whole.find_cell(cell.lower);
    require(city.find_cell({cell.lower.x, cell.lower.y, cell.lower.z}) == static_cast<uint32_t>(found),
            "another cell");
  }
}

}  // namespace

std::string read_by_library(const std::filesystem::path& file, const PvsFile* whole) {
  try {
    const pvs::City city(file, 1 << 20);
    pvs::Row row;
    for (uint32_t c = city.cell_count(); c-- > 0;) city.read_row(c, row);
    for (uint32_t last = city.object_count(); last > 0; last -= std::min(last, 1 + city.object_count() / 3))
      city.read_geometry(last - std::min(last, 1 + city.object_count() / 3), last);
    if (whole != nullptr) require_same(city, *whole);
    return {};
  } catch (const pvs::Error& error) {
    const std::string message = error.what();
    require(message.find('\n') == std::string::npos, "more than one line");
    require(message.starts_with(file.string() + ": /"), "names no file and place");
    return message;
  }
}

}  // namespace veduta::test
