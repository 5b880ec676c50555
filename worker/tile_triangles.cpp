#include "worker/tile_triangles.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>

#include "scene/error.h"
#include "scene/sync_path.h"

namespace veduta {
namespace {

struct StoredTriangle {
  float corner[9];
  uint32_t object, kind;
};
static_assert(sizeof(StoredTriangle) == 44);

StoredTriangle stored(const PlacedTriangle& triangle) {
  StoredTriangle s{};
  for (int n = 0; n < 9; ++n) s.corner[n] = triangle.corner[n / 3][n % 3];
  s.object = triangle.object, s.kind = static_cast<uint32_t>(triangle.kind);
  return s;
}

PlacedTriangle placed(const StoredTriangle& s) {
  PlacedTriangle triangle;
  for (int n = 0; n < 9; ++n) triangle.corner[n / 3][n % 3] = s.corner[n];
  triangle.object = s.object, triangle.kind = static_cast<Kind>(s.kind);
  return triangle;
}

/// What waits to be appended to the tiles' files.
class Buckets {
 public:
  Buckets(const RunPaths& run, PreparationPlan& plan, size_t limit_bytes)
      : run_(run), plan_(plan), limit_(limit_bytes / sizeof(StoredTriangle)), waiting_(plan.tiles()) {}

  void add(const PlacedTriangle& triangle) {
    for (const uint32_t tile : plan_.tiles_of(touched_columns(triangle))) {
      waiting_[tile].push_back(stored(triangle));
      ++plan_.tile_triangles[tile];
      if (++count_ >= limit_) write();
    }
  }

  void write() {
    for (uint32_t tile = 0; tile < waiting_.size(); ++tile) {
      std::vector<StoredTriangle>& triangles = waiting_[tile];
      if (triangles.empty()) continue;
      const std::filesystem::path file = part_file(run_, "triangles", tile);
      std::ofstream out(file, std::ios::binary | std::ios::app);
      out.write(reinterpret_cast<const char*>(triangles.data()),
                static_cast<std::streamsize>(triangles.size() * sizeof(StoredTriangle)));
      out.close();
      if (!out)
        throw Error(ExitStatus::input_output, file.string() + ": cannot be written; is the disk full?");
      std::vector<StoredTriangle>().swap(triangles);
    }
    count_ = 0;
  }

 private:
  LatticeRect touched_columns(const PlacedTriangle& triangle) const {
    const Box box = bounds(triangle);
    const GridFrame& f = plan_.frame;
    // A voxel more: a triangle between two columns touches both.
    const int by = plan_.triangle_voxels + 1;
    return plan_.grown({f.i0 + f.column_x(box.lower.x), f.i0 + f.column_x(box.upper.x) + 1,
                        f.j0 + f.column_y(box.lower.y), f.j0 + f.column_y(box.upper.y) + 1},
                       by);
  }

  const RunPaths& run_;
  PreparationPlan& plan_;
  size_t limit_, count_ = 0;
  std::vector<std::vector<StoredTriangle>> waiting_;
};

}  // namespace

void write_tile_triangles(const RunPaths& run, const Scene& scene, PreparationPlan& plan,
                          size_t buffer_bytes) {
  plan.tile_triangles.assign(plan.tiles(), 0);
  Buckets buckets(run, plan, buffer_bytes);
  visit_placed_triangles(
      scene, [&](const PlacedTriangle& triangle) { buckets.add(plan.axes.to_canonical(triangle)); });
  buckets.write();
}

std::vector<PlacedTriangle> read_tile_triangles(const RunPaths& run, const PreparationPlan& plan,
                                                uint32_t tile) {
  std::vector<PlacedTriangle> triangles;
  const uint64_t count = plan.tile_triangles.at(tile);
  if (count == 0) return triangles;
  const std::filesystem::path file = part_file(run, "triangles", tile);
  std::error_code error;
  if (std::filesystem::file_size(file, error) != count * sizeof(StoredTriangle) || error)
    throw Error(ExitStatus::bad_input, file.string() + ": missing or damaged; bake again");
  std::ifstream in(file, std::ios::binary);
  triangles.reserve(count);
  std::vector<StoredTriangle> part(std::min<uint64_t>(count, 1 << 16));
  while (triangles.size() < count) {
    part.resize(std::min<uint64_t>(part.size(), count - triangles.size()));
    in.read(reinterpret_cast<char*>(part.data()),
            static_cast<std::streamsize>(part.size() * sizeof(StoredTriangle)));
    if (!in) throw Error(ExitStatus::input_output, file.string() + ": cannot be read");
    for (const StoredTriangle& s : part) triangles.push_back(placed(s));
  }
  return triangles;
}

}  // namespace veduta
