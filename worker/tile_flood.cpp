#include "worker/tile_flood.h"

#include "worker/tile_sides.h"
#include "worker/tile_state.h"
#include "worker/tile_triangles.h"

namespace veduta {
namespace {

constexpr int opposite(int side) {
  return side ^ 1;
}

class TileFlood {
 public:
  TileFlood(const RunPaths& run, const PreparationPlan& plan, uint32_t tile)
      : run_(run), plan_(plan), tile_(tile), neighbours_(plan.neighbours(tile)) {}

  std::vector<uint32_t> run() {
    read_neighbours();
    // Named for nothing, as happens while neighbours are flooded at the same time. Also after a death between
    // space and sides this holds: sides that are too old let more in.
    const std::optional<TileSides> known = read_tile_sides(run_, plan_, tile_);
    if (known && !more_flows_in(*known)) return growing(*known);
    bool changed = !has_tile_space(run_, tile_);
    SeedRegion region = changed ? start() : load_region(run_, plan_, plan_.tile(tile_));
    TileSides own = sides_of(region);
    for (;;) {
      changed |= let_in(region, own);
      if (changed) {
        write_tile_space(run_, tile_, region);
        own = sides_of(region);
      }
      write_tile_sides(run_, tile_, own);
      read_neighbours();
      changed = false;
      if (!more_flows_in(own)) return growing(own);
    }
  }

 private:
  SeedRegion start() {
    SeedRegion region =
        make_seed_region(read_tile_triangles(run_, plan_, tile_), plan_.frame_of(plan_.tile(tile_)));
    write_tile_surface(run_, tile_, region);
    return region;
  }

  void read_neighbours() {
    for (int side = 0; side < 4; ++side) {
      if (const auto& neighbour = neighbours_[side]) others_[side] = read_tile_sides(run_, plan_, *neighbour);
    }
  }

  /// \return whether anything flowed in.
  bool let_in(SeedRegion& region, const TileSides& own) const {
    bool any = false;
    for (int side = 0; side < 4; ++side) {
      if (!others_[side]) continue;
      const std::vector<Inflow> in =
          inflow(region.frame(), side, own[side], (*others_[side])[opposite(side)]);
      if (in.empty()) continue;
      flood_more(*region.occupied, region.touched, in, region.free, region.reached);
      any = true;
    }
    return any;
  }

  bool more_flows_in(const TileSides& own) const {
    for (int side = 0; side < 4; ++side) {
      if (others_[side] && more_flows((*others_[side])[opposite(side)], own[side])) return true;
    }
    return false;
  }

  /// The neighbours that have not let in all that flows now. One without sides is being flooded for the first
  /// time, or will be: whether it saw ours is not known.
  std::vector<uint32_t> growing(const TileSides& own) const {
    std::vector<uint32_t> all;
    for (int side = 0; side < 4; ++side) {
      if (neighbours_[side] && (!others_[side] || more_flows(own[side], (*others_[side])[opposite(side)])))
        all.push_back(*neighbours_[side]);
    }
    return all;
  }

  const RunPaths& run_;
  const PreparationPlan& plan_;
  uint32_t tile_;
  std::array<std::optional<uint32_t>, 4> neighbours_;
  std::array<std::optional<TileSides>, 4> others_;
};

}  // namespace

std::vector<uint32_t> flood_tile(const RunPaths& run, const PreparationPlan& plan, uint32_t tile) {
  return TileFlood(run, plan, tile).run();
}

}  // namespace veduta
