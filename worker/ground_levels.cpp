#include "worker/ground_levels.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "worker/clip.h"

namespace veduta {
namespace {

/// What a triangle is in a column: from its lowest to its highest point there.
struct Piece {
  uint32_t column = 0;
  float lower = 0, upper = 0;
};

void add_pieces(const PlacedTriangle& triangle, const GridFrame& frame, std::vector<Piece>& pieces) {
  const auto& c = triangle.corner;
  const auto [x0, x1] = std::minmax({c[0].x, c[1].x, c[2].x});
  const auto [y0, y1] = std::minmax({c[0].y, c[1].y, c[2].y});
  if (x1 < frame.x(0) || y1 < frame.y(0) || x0 > frame.x(frame.nx) || y0 > frame.y(frame.ny)) return;
  for (int j = frame.column_y(y0); j <= frame.column_y(y1); ++j) {
    const ClippedTriangle row = clip_slab(uncut(c), 1, frame.y(j), frame.y(j + 1));
    for (int i = frame.column_x(x0); row.count > 0 && i <= frame.column_x(x1); ++i) {
      const ClippedTriangle cut = clip_slab(row, 0, frame.x(i), frame.x(i + 1));
      if (cut.count == 0) continue;
      double lower = cut.corner[0].z, upper = lower;
      for (int n = 1; n < cut.count; ++n)
        lower = std::min(lower, cut.corner[n].z), upper = std::max(upper, cut.corner[n].z);
      pieces.push_back({static_cast<uint32_t>(j) * static_cast<uint32_t>(frame.nx) + static_cast<uint32_t>(i),
                        static_cast<float>(lower), static_cast<float>(upper)});
    }
  }
}

bool is_ground(Kind kind) {
  return kind == Kind::terrain || kind == Kind::road || kind == Kind::bridge;
}

}  // namespace

GroundLevels ground_levels(const std::vector<PlacedTriangle>& triangles, const GridFrame& frame,
                           double headroom_m, std::optional<float> level_m) {
  std::vector<Piece> pieces;
  for (const PlacedTriangle& triangle : triangles)
    if (is_ground(triangle.kind)) add_pieces(triangle, frame, pieces);
  const auto columns = static_cast<uint32_t>(frame.nx) * static_cast<uint32_t>(frame.ny);
  for (uint32_t c = 0; level_m && c < columns; ++c) pieces.push_back({c, *level_m, *level_m});
  // By column, then from above, so that the order of the triangles does not matter.
  std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) {
    return std::tuple(a.column, -a.upper, -a.lower) < std::tuple(b.column, -b.upper, -b.lower);
  });

  GroundLevels levels;
  levels.begin.reserve(columns + 1);
  auto piece = pieces.begin();
  for (uint32_t c = 0; c < columns; ++c) {
    levels.begin.push_back(static_cast<uint32_t>(levels.height.size()));
    double ceiling = std::numeric_limits<double>::infinity();
    for (; piece != pieces.end() && piece->column == c; ++piece) {
      if (ceiling - piece->upper >= headroom_m) levels.height.push_back(piece->upper);
      ceiling = std::min<double>(ceiling, piece->lower);
    }
    std::reverse(levels.height.begin() + levels.begin.back(), levels.height.end());
  }
  levels.begin.push_back(static_cast<uint32_t>(levels.height.size()));
  return levels;
}

}  // namespace veduta
