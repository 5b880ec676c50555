#include "worker/tile_sides.h"

#include <cstring>

#include "scene/error.h"
#include "worker/packed_file.h"

namespace veduta {
namespace {

constexpr SeedFace whole = 0xffff;

/// The seed of a brick at place (a, z) of a side.
int brick_bit(int side, int a, int z) {
  const int across = side % 2 == 0 ? 0 : seeds_per_voxel - 1;
  return side < 2 ? across + 4 * a + 16 * z : a + 4 * across + 16 * z;
}

SeedFace face_of(Brick brick, int side) {
  unsigned face = 0;
  for (int bit = 0; bit < 16; ++bit)
    face |= static_cast<unsigned>(brick >> brick_bit(side, bit % 4, bit / 4) & 1) << bit;
  return static_cast<SeedFace>(face);
}

Brick brick_of(SeedFace face, int side) {
  Brick brick = 0;
  for (int bit = 0; bit < 16; ++bit)
    brick |= static_cast<Brick>(face >> bit & 1) << brick_bit(side, bit % 4, bit / 4);
  return brick;
}

/// Column n along a side of a frame.
std::pair<int, int> column_at(const GridFrame& frame, int side, int n) {
  if (side < 2) return {side == 0 ? 0 : frame.nx - 1, n};
  return {n, side == 2 ? 0 : frame.ny - 1};
}

int length(const GridFrame& frame, int side) {
  return side < 2 ? frame.ny : frame.nx;
}

bool more(SeedFace from, const TileSide& into, size_t voxel) {
  return (from & into.open[voxel] & ~into.reached[voxel]) != 0;
}

}  // namespace

TileSides sides_of(const SeedRegion& tile) {
  const GridFrame& frame = tile.frame();
  TileSides sides;
  for (int side = 0; side < 4; ++side) {
    TileSide& s = sides[static_cast<size_t>(side)];
    for (int n = 0; n < length(frame, side); ++n) {
      const auto [i, j] = column_at(frame, side, n);
      const auto touched = tile.touched.column(i, j), reached = tile.reached.column(i, j);
      size_t brick = 0;
      for (int k = 0; k < frame.nz; ++k) {
        if (tile.occupied->get(i, j, k)) {
          s.reached.push_back(face_of(reached[brick], side));
          s.open.push_back(face_of(~touched[brick], side));
          ++brick;
        } else {
          s.reached.push_back(tile.free.get(i, j, k) ? whole : SeedFace{0});
          s.open.push_back(whole);
        }
      }
    }
  }
  return sides;
}

std::vector<Inflow> inflow(const GridFrame& tile, int side, const TileSide& own, const TileSide& other) {
  std::vector<Inflow> all;
  for (size_t voxel = 0; voxel < own.reached.size(); ++voxel) {
    if (!more(other.reached[voxel], own, voxel)) continue;
    const auto n = static_cast<int>(voxel / static_cast<size_t>(tile.nz));
    const auto [i, j] = column_at(tile, side, n);
    all.push_back(
        {i, j, static_cast<int>(voxel % static_cast<size_t>(tile.nz)), brick_of(other.reached[voxel], side)});
  }
  return all;
}

bool more_flows(const TileSide& from, const TileSide& into) {
  for (size_t voxel = 0; voxel < from.reached.size(); ++voxel) {
    if (more(from.reached[voxel], into, voxel)) return true;
  }
  return false;
}

void write_tile_sides(const RunPaths& run, uint32_t tile, const TileSides& sides) {
  write_packed(part_file(run, "sides", tile), sides.size(), [&](size_t side) {
    const TileSide& s = sides[side];
    std::vector<uint64_t> words((s.reached.size() + 3) / 4 * 2, 0);  // four faces a word; reached, then open
    std::memcpy(words.data(), s.reached.data(), s.reached.size() * sizeof(SeedFace));
    std::memcpy(words.data() + words.size() / 2, s.open.data(), s.open.size() * sizeof(SeedFace));
    return words;
  });
}

std::optional<TileSides> read_tile_sides(const RunPaths& run, const PreparationPlan& plan, uint32_t tile) {
  const std::filesystem::path path = part_file(run, "sides", tile);
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return {};
  const GridFrame frame = plan.frame_of(plan.tile(tile));
  PackedFile file(path, 4);
  TileSides sides;
  for (int side = 0; side < 4; ++side) {
    const std::vector<uint64_t> words = file.read(static_cast<size_t>(side));
    const size_t faces = static_cast<size_t>(length(frame, side)) * static_cast<size_t>(frame.nz);
    if (words.size() != (faces + 3) / 4 * 2)
      throw Error(ExitStatus::bad_input,
                  path.string() + ": damaged; remove the folder it is in and bake again");
    TileSide& s = sides[static_cast<size_t>(side)];
    s.reached.resize(faces), s.open.resize(faces);
    std::memcpy(s.reached.data(), words.data(), faces * sizeof(SeedFace));
    std::memcpy(s.open.data(), words.data() + words.size() / 2, faces * sizeof(SeedFace));
  }
  return sides;
}

}  // namespace veduta
