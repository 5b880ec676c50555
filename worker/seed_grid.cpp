#include "worker/seed_grid.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "worker/clip.h"

namespace veduta {
namespace {

/// Calls visit(i, z0, z1) for each column i of row j that the triangle touches, with its z-range there.
template <typename Visit>
void clip_to_row(const ClippedTriangle& triangle, const GridFrame& frame, int j, double margin, Visit visit) {
  const ClippedTriangle row = clip_slab(triangle, 1, frame.y(j) - margin, frame.y(j + 1) + margin);
  if (row.count == 0) return;
  double x0 = row.corner[0].x, x1 = x0;
  for (int n = 1; n < row.count; ++n) x0 = std::min(x0, row.corner[n].x), x1 = std::max(x1, row.corner[n].x);
  for (int i = frame.column_x(x0 - margin); i <= frame.column_x(x1 + margin); ++i) {
    const ClippedTriangle cell = clip_slab(row, 0, frame.x(i) - margin, frame.x(i + 1) + margin);
    if (cell.count == 0) continue;
    double z0 = cell.corner[0].z, z1 = z0;
    for (int n = 1; n < cell.count; ++n)
      z0 = std::min(z0, cell.corner[n].z), z1 = std::max(z1, cell.corner[n].z);
    visit(i, z0, z1);
  }
}

}  // namespace

void visit_touched_columns(const std::vector<PlacedTriangle>& triangles, const GridFrame& frame,
                           const ColumnVisitor& visit) {
  const double margin = frame.size_m * 1e-6;  // more than doubles round
  // Triangles by the band of rows that they touch, so that bands run in parallel without sharing a column.
  constexpr int band_rows = 64;
  const int bands = (frame.ny + band_rows - 1) / band_rows;
  const auto rows = [&](const PlacedTriangle& triangle) {
    const auto& c = triangle.corner;
    const auto [y0, y1] = std::minmax({c[0].y, c[1].y, c[2].y});
    return std::pair(frame.column_y(y0 - margin), frame.column_y(y1 + margin));
  };
  std::vector<std::vector<uint32_t>> touching(static_cast<size_t>(bands));
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    const auto [first, last] = rows(triangles[t]);
    for (int b = first / band_rows; b <= last / band_rows; ++b) touching[b].push_back(t);
  }
  tbb::parallel_for(0, bands, [&](int b) {
    for (const uint32_t t : touching[b]) {
      const PlacedTriangle& triangle = triangles[t];
      const auto [first, last] = rows(triangle);
      for (int j = std::max(first, b * band_rows); j <= std::min(last, (b + 1) * band_rows - 1); ++j) {
        clip_to_row(uncut(triangle.corner), frame, j, margin, [&](int i, double z0, double z1) {
          visit(i, j, frame.layer(z0 - margin), frame.layer(z1 + margin));
        });
      }
    }
  });
}

BitGrid seed_test(const std::vector<PlacedTriangle>& triangles, const GridFrame& frame) {
  BitGrid occupied(frame);
  visit_touched_columns(triangles, frame,
                        [&](int i, int j, int k0, int k1) { occupied.set_run(i, j, k0, k1); });
  return occupied;
}

BitGrid seed_test(const Scene& scene, const GridFrame& frame) {
  return seed_test(all_triangles(scene), frame);
}

}  // namespace veduta
