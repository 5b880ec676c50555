// The dense grid of bits and its bricks of seeds against OpenVDB, with the same content. JSON in, JSON out:
//
//   echo '{"model": "city.json", "seed_size_m": 0.125, "half_extent_m": 2.5, "repeat": 3}' |
//   veduta-bench-grid
//
// Both run on one thread, one after the other in the same process; of "repeat" runs the least time of each
// step is reported. OpenVDB gets its content from ours, through an accessor, and must find the same free
// and eroded voxels: otherwise the program fails. "flood_seeds": true lets OpenVDB flood the seeds, too.
//
// OpenVDB has no flood fill of a mask. What is closest, "flood": the connected components of the open space
// (a box less what is occupied), of which the one above the scene is free. Beside it, "flood_by_hand": a walk
// from voxel to voxel through accessors.
#include <openvdb/tools/Morphology.h>
#include <openvdb/tools/Prune.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/grid_masks.h"
#include "scene/import.h"
#include "worker/free_space.h"
#include "worker/seed_grid.h"
#include "worker/seed_region.h"

namespace veduta::bench {
namespace {

using Json = nlohmann::ordered_json;
using openvdb::Coord;
using openvdb::CoordBBox;

/// Seconds of named steps, the least of all runs.
class Clock {
 public:
  template <typename Step>
  auto time(const std::string& name, const Step& step) {
    const auto begin = std::chrono::steady_clock::now();
    auto result = step();
    const double s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (!seconds_.contains(name) || s < seconds_[name]) seconds_[name] = s;
    return result;
  }
  const Json& seconds() const { return seconds_; }

 private:
  Json seconds_ = Json::object();
};

struct Job {
  double half_extent_m;
  bool flood_seeds;
  std::vector<PlacedTriangle> triangles;
  GridFrame frame;

  int erosion() const { return static_cast<int>(std::ceil(half_extent_m / frame.size_m)); }
};

CoordBBox box_of(const GridFrame& frame) {
  return {Coord(0, 0, 0), Coord(frame.nx - 1, frame.ny - 1, frame.nz - 1)};
}

uint64_t bytes_of(const BitGrid& grid) {
  const GridFrame& frame = grid.frame();
  return static_cast<uint64_t>(plane_bytes(frame.nx, frame.ny, frame.nz));
}

/// With the table of where columns begin.
uint64_t bytes_of(const BrickGrid& grid, const GridFrame& frame) {
  return grid.size() * sizeof(Brick) + (static_cast<uint64_t>(frame.nx) * frame.ny + 1) * sizeof(size_t);
}

uint64_t count_seeds(const BrickGrid& bricks, const BitGrid& occupied) {
  uint64_t count = 0;
  visit_set(occupied,
            [&](int i, int j, int k) { count += static_cast<uint64_t>(std::popcount(bricks.at(i, j, k))); });
  return count;
}

template <typename Tree>
void expect_same(const Tree& theirs, const BitGrid& ours, const std::string& what) {
  bool same = theirs.activeVoxelCount() == ours.count();
  visit_set(ours, [&](int i, int j, int k) { same = same && theirs.isValueOn(Coord(i, j, k)); });
  if (!same)
    throw std::runtime_error("not the same " + what + ": " + std::to_string(ours.count()) + " in our grid, " +
                             std::to_string(theirs.activeVoxelCount()) + " in OpenVDB's");
}

void expect_equal(uint64_t theirs, uint64_t ours, const std::string& what) {
  if (theirs != ours)
    throw std::runtime_error("not as many " + what + ": " + std::to_string(ours) + " in our grid, " +
                             std::to_string(theirs) + " in OpenVDB's");
}

/// One run of both: the steps of make_seed_region, without the floor that it puts below the scene.
Json measure(const Job& job, Clock& our_clock, Clock& their_clock) {
  const GridFrame& frame = job.frame;
  auto occupied = std::make_unique<const BitGrid>(
      our_clock.time("seed_test", [&] { return seed_test(job.triangles, frame); }));
  BrickGrid touched = our_clock.time("seed_bricks", [&] { return seed_bricks(job.triangles, *occupied); });
  BitGrid free = our_clock.time("flood_fill", [&] { return flood_fill(*occupied); });
  const BitGrid free_before_seeds = free;
  BrickGrid reached = our_clock.time("flood_seeds", [&] { return flood_seeds(*occupied, touched, free); });
  const SeedRegion region{std::move(occupied), std::move(touched), std::move(reached), std::move(free)};
  const BitGrid sealed = our_clock.time("sealed_voxels", [&] { return sealed_voxels(region); });
  const int r = job.erosion();
  const BitGrid eroded = our_clock.time("erode", [&] {
    BitGrid grid = sealed;
    erode(grid, r, r, r);
    return grid;
  });

  const Mask vdb_occupied = their_clock.time("fill_occupied", [&] { return mask_of(*region.occupied); });
  const Mask vdb_touched =
      their_clock.time("fill_touched", [&] { return mask_of(region.touched, *region.occupied); });
  const auto vdb_free = their_clock.time("flood", [&] { return flood(vdb_occupied, box_of(frame)); });
  expect_same(*vdb_free, free_before_seeds, "free voxels");
  const Mask by_hand =
      their_clock.time("flood_by_hand", [&] { return flood_by_hand(vdb_occupied, box_of(frame)); });
  expect_same(by_hand, free_before_seeds, "free voxels by hand");
  const Mask vdb_sealed = their_clock.time("fill_sealed", [&] { return sealed_with_floor(sealed, r); });
  Mask vdb_eroded = their_clock.time("erode", [&] {
    Mask mask = vdb_sealed;
    openvdb::tools::erodeActiveValues(mask, r, openvdb::tools::NN_FACE_EDGE_VERTEX,
                                      openvdb::tools::EXPAND_TILES, false);
    openvdb::tools::prune(mask);
    return mask;
  });
  vdb_eroded.clip(box_of(frame));
  expect_same(vdb_eroded, eroded, "eroded voxels");

  const uint64_t free_seeds = 64 * region.free.count() + count_seeds(region.reached, *region.occupied);
  Json theirs = {{"occupied", vdb_occupied.memUsage()},
                 {"touched", vdb_touched.memUsage()},
                 {"reached", mask_of(region.reached, *region.occupied).memUsage()},
                 {"free", by_hand.memUsage()},
                 {"sealed", vdb_sealed.memUsage()},
                 {"eroded", vdb_eroded.memUsage()}};
  if (job.flood_seeds) {
    const auto vdb_seeds =
        their_clock.time("flood_seeds", [&] { return flood(vdb_touched, box_of(region.seed_frame())); });
    expect_equal(vdb_seeds->activeVoxelCount(), free_seeds, "free seeds");
    theirs["free_seeds"] = Mask(*vdb_seeds, false, openvdb::TopologyCopy()).memUsage();
  }
  return {{"voxels", {frame.nx, frame.ny, frame.nz}},
          {"erosion_voxels", r},
          {"occupied_voxels", region.occupied->count()},
          {"touched_seeds", count_seeds(region.touched, *region.occupied)},
          {"free_voxels", free_before_seeds.count()},
          {"free_seeds", free_seeds},
          {"sealed_voxels", sealed.count()},
          {"eroded_voxels", eroded.count()},
          {"our_bytes",
           {{"bit_plane", bytes_of(sealed)},
            {"touched", bytes_of(region.touched, frame)},
            {"reached", bytes_of(region.reached, frame)}}},
          {"openvdb_bytes", theirs}};
}

Json measure(const Json& in) {
  const std::string model = in.at("model").get<std::string>();
  const double seed_size_m = in.at("seed_size_m").get<double>();
  const Scene scene = import_scene({model}).scene;
  const Job job{in.value("half_extent_m", 2.5), in.value("flood_seeds", false), all_triangles(scene),
                make_frame(scene.bounds(), seeds_per_voxel * seed_size_m)};
  Json out = {
      {"model", model}, {"seed_size_m", seed_size_m}, {"openvdb", openvdb::getLibraryVersionString()}};
  Clock ours, theirs;
  for (int run = std::max(1, in.value("repeat", 3)); run > 0; --run) out.update(measure(job, ours, theirs));
  out["our_seconds"] = ours.seconds();
  out["openvdb_seconds"] = theirs.seconds();
  return out;
}

}  // namespace
}  // namespace veduta::bench

int main() {
  try {
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    openvdb::initialize();
    std::cout << veduta::bench::measure(nlohmann::ordered_json::parse(std::cin)).dump(2) << std::endl;
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "veduta-bench-grid: " << error.what()
              << "; give {\"model\": \"FILE\", \"seed_size_m\": 0.125}\n";
    return 2;
  }
}
