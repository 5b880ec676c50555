// What veduta/pvs.h says is to be drawn, held against the definition of the three bytes.
#include <array>
#include <map>

#include "tests/library/sliced_city.h"

namespace veduta {
namespace {

using Drawing = test::SlicedCity;
using test::to_point;

using Triangle = std::array<pvs::Point, 3>;
/// Triangles with their materials; one that is drawn twice is there once.
using Drawn = std::map<Triangle, int>;

void add_drawn(const pvs::Geometry& geometry, const pvs::Entry& entry, Drawn& drawn) {
  std::vector<pvs::DrawRange> ranges;
  geometry.add_ranges(entry, ranges);
  EXPECT_LE(ranges.size(), 2u);
  for (const pvs::DrawRange& range : ranges) {
    EXPECT_EQ(range.first % 3 + range.count % 3, 0u);
    EXPECT_GT(range.count, 0u);
    for (uint64_t i = range.first; i < range.first + range.count; i += 3) {
      Triangle triangle;
      for (size_t corner = 0; corner < 3; ++corner)
        triangle[corner] = geometry.vertices.at(geometry.indices.at(i + corner));
      drawn[triangle] = geometry.material.at(i / 3);
    }
  }
}

/// What the entries of a row draw, by the definition of the three bytes.
template <typename Entries>
void add_expected(const PvsFile& file, const Entries& entries, Drawn& drawn) {
  const Scene& scene = file.city.scene;
  for (const PvsEntry& entry : entries)
    for (uint64_t t = scene.objects[entry.object].triangle_begin;
         t < scene.objects[entry.object].triangle_end; ++t) {
      if (!draws(entry.index, file.city.triangle_slices[t])) continue;
      const glm::uvec3& v = scene.triangles[t];
      drawn[{to_point(scene.vertices[v.x]), to_point(scene.vertices[v.y]), to_point(scene.vertices[v.z])}] =
          static_cast<int>(scene.material[t]);
    }
}

/// Reads the geometry in pieces of as many objects.
std::vector<pvs::Geometry> pieces_of(const pvs::City& city, uint32_t objects) {
  std::vector<pvs::Geometry> pieces;
  for (uint32_t first = 0; first < city.object_count(); first += objects)
    pieces.push_back(city.read_geometry(first, std::min(city.object_count(), first + objects)));
  return pieces;
}

Drawn drawn_by(const std::vector<pvs::Geometry>& pieces, const pvs::Row& row) {
  Drawn drawn;
  for (const pvs::Geometry& piece : pieces)
    for (const pvs::Entry& entry : row) add_drawn(piece, entry, drawn);
  return drawn;
}

TEST_F(Drawing, RangesDrawTheTrianglesOfTheRow) {
  const pvs::City city(path_);
  for (const uint32_t objects : {1u, 7u, 40u}) {
    const std::vector<pvs::Geometry> pieces = pieces_of(city, objects);
    pvs::Row row;
    size_t drawn_triangles = 0;
    for (uint32_t c = 0; c < city.cell_count(); ++c) {
      city.read_row(c, row);
      const Drawn drawn = drawn_by(pieces, row);
      Drawn known;
      add_expected(file_, file_.row(c), known);
      ASSERT_EQ(drawn, known) << "cell " << c << ", " << objects << " objects at a time";
      drawn_triangles += drawn.size();
    }
    EXPECT_GT(drawn_triangles, 1000u);
    EXPECT_LT(drawn_triangles, city.cell_count() * file_.city.scene.triangles.size());
  }
}

TEST_F(Drawing, AUnionDrawsWhatEitherRowDraws) {
  const pvs::City city(path_);
  const std::vector<pvs::Geometry> pieces = pieces_of(city, 40);
  pvs::Row left, right, both;
  size_t twice = 0;
  for (uint32_t c = 0; c + 2 < city.cell_count(); ++c) {
    city.read_row(c, left);
    city.read_row(c + 2, right);
    pvs::unite(left, right, both);
    Drawn known;
    add_expected(file_, file_.row(c), known);
    add_expected(file_, file_.row(c + 2), known);
    ASSERT_EQ(drawn_by(pieces, both), known);
    for (size_t i = 1; i < both.size(); ++i) {
      ASSERT_LE(both[i - 1].object, both[i].object);
      twice += both[i - 1].object == both[i].object;
    }
  }
  EXPECT_GT(twice, 0u) << "no union of two kinds was tried";
}

TEST_F(Drawing, ObjectsOfAnotherPieceAddNothing) {
  const pvs::City city(path_);
  const pvs::Geometry geometry = city.read_geometry(10, 20);
  std::vector<pvs::DrawRange> ranges;
  for (const uint32_t object : {0u, 9u, 20u, 39u, 40u, UINT32_MAX})
    geometry.add_ranges({object, 0, 0, 1}, ranges);
  pvs::Geometry().add_ranges({0, 0, 0, 1}, ranges);
  city.read_geometry(5, 5).add_ranges({5, 0, 0, 1}, ranges);
  EXPECT_TRUE(ranges.empty());
}

}  // namespace
}  // namespace veduta
