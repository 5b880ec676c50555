#include "worker/tile_state.h"

#include <algorithm>
#include <bit>
#include <span>

#include "scene/error.h"
#include "worker/packed_file.h"

namespace veduta {
namespace {

constexpr int square_edge = 64;  // columns along the squares that files are packed in

/// Columns [i0, i1) x [j0, j1) of a tile's frame.
struct ColumnSquare {
  int i0 = 0, i1 = 0, j0 = 0, j1 = 0;
};

/// The squares of a tile of nx x ny columns, row by row.
std::vector<ColumnSquare> column_squares(int nx, int ny) {
  std::vector<ColumnSquare> squares;
  for (int j = 0; j < ny; j += square_edge) {
    for (int i = 0; i < nx; i += square_edge)
      squares.push_back({i, std::min(i + square_edge, nx), j, std::min(j + square_edge, ny)});
  }
  return squares;
}

/// Bits of the square's columns, then bricks of the same.
std::vector<uint64_t> pack(const ColumnSquare& square, const BitGrid& bits, const BrickGrid& bricks) {
  std::vector<uint64_t> words;
  const auto each = [&](auto&& visit) {
    for (int j = square.j0; j < square.j1; ++j) {
      for (int i = square.i0; i < square.i1; ++i) visit(i, j);
    }
  };
  each([&](int i, int j) { words.insert(words.end(), bits.column(i, j), bits.column(i, j) + bits.words()); });
  each([&](int i, int j) {
    const std::span<const Brick> column = bricks.column(i, j);
    words.insert(words.end(), column.begin(), column.end());
  });
  return words;
}

void write_grids(const std::filesystem::path& file, const BitGrid& bits, const BrickGrid& bricks) {
  const std::vector<ColumnSquare> squares = column_squares(bits.frame().nx, bits.frame().ny);
  write_packed(file, squares.size(), [&](size_t s) { return pack(squares[s], bits, bricks); });
}

/// One square of a tile, where it lies in the region that is being put together.
struct Piece {
  int di = 0, dj = 0;  // from columns of the tile to those of the region
  ColumnSquare square;
  std::vector<uint64_t> surface, space;
};

class RegionLoader {
 public:
  RegionLoader(const RunPaths& run, const PreparationPlan& plan, const LatticeRect& rect)
      : run_(run), plan_(plan), rect_(rect), frame_(plan.frame_of(rect)), words_((frame_.nz + 63) / 64) {}

  SeedRegion load() {
    for (const uint32_t tile : plan_.tiles_of(rect_)) read_tile(tile);
    auto occupied = std::make_unique<BitGrid>(frame_);
    BitGrid free(frame_);
    for (const Piece& piece : pieces_) {
      copy_bits(piece, piece.surface, *occupied);
      copy_bits(piece, piece.space, free);
    }
    BrickGrid touched(*occupied, 0), reached(*occupied, 0);
    for (const Piece& piece : pieces_) {
      copy_bricks(piece, piece.surface, touched);
      copy_bricks(piece, piece.space, reached);
    }
    return {std::move(occupied), std::move(touched), std::move(reached), std::move(free)};
  }

 private:
  void read_tile(uint32_t tile) {
    const LatticeRect own = plan_.tile(tile);
    const int di = own.i0 - rect_.i0, dj = own.j0 - rect_.j0;
    const std::vector<ColumnSquare> squares = column_squares(own.i1 - own.i0, own.j1 - own.j0);
    PackedFile surface(part_file(run_, "surface", tile), squares.size());
    PackedFile space(part_file(run_, "space", tile), squares.size());
    for (size_t s = 0; s < squares.size(); ++s) {
      const ColumnSquare& q = squares[s];
      if (q.i1 + di <= 0 || q.j1 + dj <= 0 || q.i0 + di >= frame_.nx || q.j0 + dj >= frame_.ny) continue;
      pieces_.push_back({di, dj, q, surface.read(s), space.read(s)});
      check(pieces_.back(), tile);
    }
  }

  void check(const Piece& piece, uint32_t tile) const {
    const ColumnSquare& q = piece.square;
    const size_t bits = static_cast<size_t>(q.i1 - q.i0) * (q.j1 - q.j0) * words_;
    size_t bricks = 0;
    if (piece.surface.size() >= bits) {
      for (size_t w = 0; w < bits; ++w) bricks += static_cast<size_t>(std::popcount(piece.surface[w]));
    }
    if (piece.surface.size() != bits + bricks || piece.space.size() != bits + bricks)
      throw Error(ExitStatus::bad_input, part_file(run_, "space", tile).string() +
                                             ": damaged; remove the folder it is in and bake again");
  }

  /// Calls visit(i, j, words) for each column of a piece, inside of the region or not.
  template <typename Visit>
  void each_column(const Piece& piece, Visit visit) const {
    const uint64_t* occupied = piece.surface.data();
    for (int j = piece.square.j0 + piece.dj; j < piece.square.j1 + piece.dj; ++j) {
      for (int i = piece.square.i0 + piece.di; i < piece.square.i1 + piece.di; ++i, occupied += words_) {
        const bool inside = i >= 0 && j >= 0 && i < frame_.nx && j < frame_.ny;
        visit(i, j, inside, occupied);
      }
    }
  }

  void copy_bits(const Piece& piece, const std::vector<uint64_t>& from, BitGrid& to) const {
    each_column(piece, [&](int i, int j, bool inside, const uint64_t* occupied) {
      if (inside) std::copy_n(from.data() + (occupied - piece.surface.data()), words_, to.column(i, j));
    });
  }

  void copy_bricks(const Piece& piece, const std::vector<uint64_t>& from, BrickGrid& to) const {
    const ColumnSquare& q = piece.square;
    const Brick* bricks = from.data() + static_cast<size_t>(q.i1 - q.i0) * (q.j1 - q.j0) * words_;
    each_column(piece, [&](int i, int j, bool inside, const uint64_t* occupied) {
      size_t count = 0;
      for (int w = 0; w < words_; ++w) count += static_cast<size_t>(std::popcount(occupied[w]));
      if (inside) std::copy_n(bricks, count, to.column(i, j).data());
      bricks += count;
    });
  }

  const RunPaths& run_;
  const PreparationPlan& plan_;
  const LatticeRect rect_;
  const GridFrame frame_;
  const int words_;
  std::vector<Piece> pieces_;
};

}  // namespace

void write_tile_surface(const RunPaths& run, uint32_t tile, const SeedRegion& region) {
  write_grids(part_file(run, "surface", tile), *region.occupied, region.touched);
}

void write_tile_space(const RunPaths& run, uint32_t tile, const SeedRegion& region) {
  write_grids(part_file(run, "space", tile), region.free, region.reached);
}

bool has_tile_space(const RunPaths& run, uint32_t tile) {
  std::error_code error;
  return std::filesystem::exists(part_file(run, "space", tile), error);
}

SeedRegion load_region(const RunPaths& run, const PreparationPlan& plan, const LatticeRect& rect) {
  return RegionLoader(run, plan, rect).load();
}

}  // namespace veduta
