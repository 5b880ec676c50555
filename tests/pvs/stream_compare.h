// A file that was read piece by piece, held against the same file read whole.
#pragma once

#include <gtest/gtest.h>

#include "pvs/digest.h"
#include "pvs/pvs_stream.h"

namespace veduta::test {

inline void expect_same_index(const PvsIndex& index, const PvsFile& file) {
  EXPECT_EQ(index.header.fingerprint, file.header.fingerprint);
  EXPECT_EQ(index.header.config, file.header.config);
  EXPECT_EQ(index.header.renderer, file.header.renderer);
  EXPECT_EQ(index.header.complete, file.header.complete);
  EXPECT_EQ(index.header.conservative, file.header.conservative);
  EXPECT_EQ(index.crs, file.city.scene.crs);
  EXPECT_EQ(index.origin, file.city.scene.origin);
  EXPECT_EQ(index.content_digest, file.content_digest);
  ASSERT_EQ(index.objects.size(), file.city.scene.objects.size());
  ASSERT_EQ(index.bounds.size(), index.objects.size());
  for (size_t i = 0; i < index.objects.size(); ++i) {
    const Object &a = index.objects[i], &b = file.city.scene.objects[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.kind, b.kind);
    EXPECT_EQ(a.triangle_begin, b.triangle_begin);
    EXPECT_EQ(a.triangle_end, b.triangle_end);
    EXPECT_EQ(index.bounds[i], file.city.scene.bounds(i));
  }
  EXPECT_EQ(index.slices, file.city.slices);
  EXPECT_EQ(index.cells, file.city.cells);
  EXPECT_EQ(index.cell_row, file.cell_row);
  EXPECT_EQ(index.cell_status, file.cell_status);
  EXPECT_EQ(index.bake_us, file.bake_us);
  EXPECT_EQ(index.overestimate, file.overestimate);
  EXPECT_EQ(index.cell_worker, file.cell_worker);
  EXPECT_EQ(index.workers, file.workers);
  EXPECT_EQ(index.row_begin, file.row_begin);
  EXPECT_EQ(index.navigation.free, file.city.navigation.free);
  EXPECT_EQ(index.navigation.surfaces, file.city.navigation.surfaces);
  const HeightField &h = index.navigation.ground, &k = file.city.navigation.ground;
  EXPECT_EQ(h.lower_x, k.lower_x);
  EXPECT_EQ(h.lower_y, k.lower_y);
  EXPECT_EQ(h.step_m, k.step_m);
  EXPECT_EQ(h.nx, k.nx);
  EXPECT_EQ(h.ny, k.ny);
  ASSERT_EQ(h.height.size(), k.height.size());
  EXPECT_EQ(hash128(h.height.data(), 4 * h.height.size()),
            hash128(k.height.data(), 4 * k.height.size()));  // NaN too
  EXPECT_EQ(index.verification, file.verification);
  for (uint32_t c = 0; c < index.cells.size(); ++c)
    ASSERT_EQ(index.find_cell(index.cells[c].center()), file.find_cell(index.cells[c].center()));
}

inline void expect_same_row(const PvsStream& stream, const PvsFile& file, uint32_t row) {
  const PvsRow whole(file.entries.begin() + static_cast<ptrdiff_t>(file.row_begin[row]),
                     file.entries.begin() + static_cast<ptrdiff_t>(file.row_begin[row + 1]));
  ASSERT_EQ(stream.read_row(row), whole) << "row " << row;
  PvsRow again(row % 7, {row, completely_visible});  // of whatever was there, nothing stays
  stream.read_row(row, again);
  ASSERT_EQ(again, whole) << "row " << row;
}

/// Objects [first, last): corner by corner, since vertices may be numbered in another way.
inline void expect_same_objects(const PvsStream& stream, const PvsFile& file, uint32_t first, uint32_t last) {
  SCOPED_TRACE("objects " + std::to_string(first) + " to " + std::to_string(last));
  const City page = stream.read_objects(first, last);
  const City& city = file.city;
  EXPECT_EQ(page.scene.crs, city.scene.crs);
  EXPECT_EQ(page.scene.origin, city.scene.origin);
  EXPECT_TRUE(page.cells.empty() && page.scene.parts.empty());
  ASSERT_EQ(page.scene.objects.size(), last - first);
  ASSERT_EQ(page.slices.size(), last - first);
  uint64_t end = 0;
  for (uint32_t i = first; i < last; ++i) {
    const Object &a = page.scene.objects[i - first], &b = city.scene.objects[i];
    ASSERT_EQ(a.name, b.name);
    ASSERT_EQ(a.kind, b.kind);
    ASSERT_EQ(page.slices[i - first], city.slices[i]);
    ASSERT_EQ(a.triangle_begin, end);
    ASSERT_EQ(a.triangle_end - a.triangle_begin, b.triangle_end - b.triangle_begin);
    end = a.triangle_end;
    for (uint64_t t = 0; t < b.triangle_end - b.triangle_begin; ++t) {
      const uint64_t at = a.triangle_begin + t, of = b.triangle_begin + t;
      ASSERT_EQ(page.scene.material[at], city.scene.material[of]);
      ASSERT_EQ(page.triangle_slices[at], city.triangle_slices[of]);
      for (int corner = 0; corner < 3; ++corner)
        ASSERT_EQ(page.scene.vertices[page.scene.triangles[at][corner]],
                  city.scene.vertices[city.scene.triangles[of][corner]]);
    }
  }
  EXPECT_EQ(page.scene.triangles.size(), end);
  EXPECT_EQ(page.scene.material.size(), end);
  EXPECT_EQ(page.triangle_slices.size(), end);
}

}  // namespace veduta::test
