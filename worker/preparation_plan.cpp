#include "worker/preparation_plan.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "scene/atomic_file.h"
#include "scene/error.h"
#include "worker/brick_grid.h"
#include "worker/cell_windows.h"
#include "worker/tile_cells.h"

namespace veduta {
namespace {

using nlohmann::json;

constexpr double most_blocks = 1 << 18;

int floor_div(int a, int b) {
  return a / b - (a % b < 0 ? 1 : 0);
}

/// Blocks or tiles along an axis of the lattice: of `edge` voxels, from number `first` on.
struct Squares {
  int first = 0, count = 0, edge = 1;
};

Squares squares_x(const PreparationPlan& plan, int blocks) {
  const int first = floor_div(plan.frame.i0, plan.block_voxels);
  const int last = floor_div(plan.frame.i0 + plan.frame.nx - 1, plan.block_voxels);
  return {first * plan.block_voxels, (last - first) / blocks + 1, blocks * plan.block_voxels};
}

Squares squares_y(const PreparationPlan& plan, int blocks) {
  const int first = floor_div(plan.frame.j0, plan.block_voxels);
  const int last = floor_div(plan.frame.j0 + plan.frame.ny - 1, plan.block_voxels);
  return {first * plan.block_voxels, (last - first) / blocks + 1, blocks * plan.block_voxels};
}

LatticeRect square(const PreparationPlan& plan, int blocks, uint32_t number) {
  const Squares x = squares_x(plan, blocks), y = squares_y(plan, blocks);
  const int i = x.first + static_cast<int>(number % static_cast<uint32_t>(x.count)) * x.edge;
  const int j = y.first + static_cast<int>(number / static_cast<uint32_t>(x.count)) * y.edge;
  const GridFrame& f = plan.frame;
  return {std::max(i, f.i0), std::min(i + x.edge, f.i0 + f.nx), std::max(j, f.j0),
          std::min(j + y.edge, f.j0 + f.ny)};
}

uint32_t square_count(const PreparationPlan& plan, int blocks) {
  return static_cast<uint32_t>(squares_x(plan, blocks).count) *
         static_cast<uint32_t>(squares_y(plan, blocks).count);
}

/// The number of the tile that has a column of the lattice.
uint32_t tile_at(const PreparationPlan& plan, int i, int j) {
  const Squares x = squares_x(plan, plan.tile_blocks), y = squares_y(plan, plan.tile_blocks);
  return static_cast<uint32_t>((j - y.first) / y.edge * x.count + (i - x.first) / x.edge);
}

int voxels(double metres, double voxel_m) {
  return static_cast<int>(std::min(std::ceil(metres / voxel_m), 1e8));
}

}  // namespace

PreparationPlan make_plan(const Scene& scene, const Settings& settings, const PartSizes& sizes) {
  PreparationPlan plan;
  plan.axes = choose_axes(scene);
  plan.bounds = plan.axes.to_canonical(scene.bounds());
  plan.origin = scene.origin, plan.crs = scene.crs;
  plan.objects = scene.objects.size(), plan.triangles = scene.triangle_count();
  plan.has_ground = std::any_of(scene.objects.begin(), scene.objects.end(), [](const Object& o) {
    return o.kind == Kind::terrain || o.kind == Kind::road;
  });
  plan.lowest_eye_m = plan.bounds.lower.z;
  if (settings.navigation.mode == "walk") plan.lowest_eye_m += settings.navigation.eye_height_m - 0.25;

  const double voxel_m = seeds_per_voxel * settings.navigation.seed_size_m;
  double widest = 0;
  for (const glm::dvec3& e : window_half_extents(settings)) widest = std::max({widest, e.x, e.y, e.z});
  plan.block_voxels = sizes.block_voxels;
  const auto halo = [&](double size) {
    return std::min(voxels(std::max(24.0, 2 * widest + 8), size), plan.block_voxels);
  };
  plan.frame = make_frame(plan.bounds, voxel_m, [&](double nx, double ny, double nz) {
    const double edge = plan.block_voxels + 2.0 * halo(voxel_m);
    return plane_bytes(std::min(nx, edge), std::min(ny, edge), nz) <= 1e9 &&
           (nx / plan.block_voxels + 1) * (ny / plan.block_voxels + 1) <= most_blocks;
  });
  plan.halo_voxels = halo(voxel_m);
  // View-cells look as far around a tile as a cell goes.
  const CellOptions cells =
      cell_options(settings, plan.origin, plan.frame, plan.bounds.lower.z, plan.has_ground);
  plan.triangle_voxels = std::max(plan.halo_voxels, cell_halo_columns(cells));
  plan.tile_blocks = std::max(1, sizes.tile_blocks);
  while (sizes.tile_blocks == 0) {
    const double edge = 2.0 * plan.tile_blocks * plan.block_voxels;
    if (plane_bytes(edge, edge, plan.frame.nz) > static_cast<double>(sizes.tile_plane_bytes)) break;
    plan.tile_blocks *= 2;
  }
  return plan;
}

double PreparationPlan::reach_m() const {
  const glm::dvec3 extent = glm::dvec3(bounds.upper) - glm::dvec3(bounds.lower);
  return std::sqrt(extent.x * extent.x + extent.y * extent.y + extent.z * extent.z);
}

uint32_t PreparationPlan::blocks() const {
  return square_count(*this, 1);
}

uint32_t PreparationPlan::tiles() const {
  return square_count(*this, tile_blocks);
}

LatticeRect PreparationPlan::block(uint32_t number) const {
  return square(*this, 1, number);
}

LatticeRect PreparationPlan::tile(uint32_t number) const {
  return square(*this, tile_blocks, number);
}

uint32_t PreparationPlan::tile_of_block(uint32_t number) const {
  const LatticeRect rect = block(number);
  return tile_at(*this, rect.i0, rect.j0);
}

std::array<std::optional<uint32_t>, 4> PreparationPlan::neighbours(uint32_t tile_number) const {
  const LatticeRect r = tile(tile_number);
  const auto at = [&](int i, int j) -> std::optional<uint32_t> {
    if (i < frame.i0 || j < frame.j0 || i >= frame.i0 + frame.nx || j >= frame.j0 + frame.ny) return {};
    return tile_at(*this, i, j);
  };
  return {at(r.i0 - 1, r.j0), at(r.i1, r.j0), at(r.i0, r.j0 - 1), at(r.i0, r.j1)};
}

std::vector<uint32_t> PreparationPlan::tiles_of(const LatticeRect& rect) const {
  const auto across = static_cast<uint32_t>(squares_x(*this, tile_blocks).count);
  const uint32_t first = tile_at(*this, rect.i0, rect.j0), last = tile_at(*this, rect.i1 - 1, rect.j1 - 1);
  std::vector<uint32_t> all;
  for (uint32_t y = first / across; y <= last / across; ++y) {
    for (uint32_t x = first % across; x <= last % across; ++x) all.push_back(y * across + x);
  }
  return all;
}

LatticeRect PreparationPlan::grown(const LatticeRect& r, int by) const {
  return {std::max(r.i0 - by, frame.i0), std::min(r.i1 + by, frame.i0 + frame.nx),
          std::max(r.j0 - by, frame.j0), std::min(r.j1 + by, frame.j0 + frame.ny)};
}

GridFrame PreparationPlan::frame_of(const LatticeRect& r) const {
  GridFrame part = frame;
  part.i0 = r.i0, part.nx = r.i1 - r.i0, part.j0 = r.j0, part.ny = r.j1 - r.j0;
  return part;
}

std::filesystem::path preparation_folder(const RunPaths& run) {
  return run.directory / "prepared.tmp";
}

std::filesystem::path plan_file(const RunPaths& run) {
  return preparation_folder(run) / "plan.json";
}

std::filesystem::path part_file(const RunPaths& run, const char* what, uint32_t part) {
  return preparation_folder(run) / what / std::to_string(part);
}

std::filesystem::path scene_file(const RunPaths& run) {
  return preparation_folder(run) / "scene.h5";
}

void clear_preparation(const RunPaths& run) {
  const std::filesystem::path folder = preparation_folder(run);
  std::error_code error;
  std::filesystem::remove_all(folder, error);
  for (const char* what : {"triangles", "surface", "space", "sides", "cells", "occluders"}) {
    if (!error) std::filesystem::create_directories(folder / what, error);
  }
  if (error)
    throw Error(ExitStatus::input_output, folder.string() + ": cannot be made anew: " + error.message());
}

void write_plan(const RunPaths& run, const PreparationPlan& plan) {
  const GridFrame& f = plan.frame;
  const Box& b = plan.bounds;
  const json text = {
      {"frame", {f.size_m, f.aside_m}},
      {"voxels", {f.i0, f.j0, f.k0, f.nx, f.ny, f.nz}},
      {"axes", {plan.axes.negate_x, plan.axes.negate_y, plan.axes.swap}},
      {"bounds", {b.lower.x, b.lower.y, b.lower.z, b.upper.x, b.upper.y, b.upper.z}},
      {"origin", plan.origin},
      {"crs", plan.crs},
      {"has_ground", plan.has_ground},
      {"lowest_eye_m", plan.lowest_eye_m},
      {"block_voxels", plan.block_voxels},
      {"halo_voxels", plan.halo_voxels},
      {"triangle_voxels", plan.triangle_voxels},
      {"tile_blocks", plan.tile_blocks},
      {"tile_triangles", plan.tile_triangles},
      {"notes", plan.notes},
      {"objects", plan.objects},
      {"triangles", plan.triangles},
  };
  write_atomically(plan_file(run), [&](const std::filesystem::path& file) {
    std::ofstream out(file, std::ios::binary);
    out << text.dump(-1, ' ', false, json::error_handler_t::replace) << '\n';
    out.close();
    if (!out) throw Error(ExitStatus::input_output, file.string() + ": cannot be written; is the disk full?");
  });
}

PreparationPlan read_plan(const RunPaths& run) {
  const std::filesystem::path file = plan_file(run);
  std::ifstream in(file, std::ios::binary);
  const json text = json::parse(in, nullptr, false);
  try {
    PreparationPlan plan;
    GridFrame& f = plan.frame;
    const auto size = text.at("frame").get<std::array<double, 2>>();
    f.size_m = size[0], f.aside_m = size[1];
    const auto v = text.at("voxels").get<std::array<int, 6>>();
    f.i0 = v[0], f.j0 = v[1], f.k0 = v[2], f.nx = v[3], f.ny = v[4], f.nz = v[5];
    const auto axes = text.at("axes").get<std::array<bool, 3>>();
    plan.axes = {axes[0], axes[1], axes[2]};
    const auto b = text.at("bounds").get<std::array<float, 6>>();
    plan.bounds = {{b[0], b[1], b[2]}, {b[3], b[4], b[5]}};
    f.lowest_m = plan.bounds.lower.z;
    text.at("origin").get_to(plan.origin), text.at("crs").get_to(plan.crs);
    text.at("has_ground").get_to(plan.has_ground), text.at("lowest_eye_m").get_to(plan.lowest_eye_m);
    text.at("block_voxels").get_to(plan.block_voxels), text.at("halo_voxels").get_to(plan.halo_voxels);
    text.at("triangle_voxels").get_to(plan.triangle_voxels);
    text.at("tile_blocks").get_to(plan.tile_blocks), text.at("tile_triangles").get_to(plan.tile_triangles);
    text.at("notes").get_to(plan.notes);
    text.at("objects").get_to(plan.objects), text.at("triangles").get_to(plan.triangles);
    return plan;
  } catch (const json::exception&) {
    throw Error(ExitStatus::bad_input, file.string() + ": missing or damaged; bake again");
  }
}

}  // namespace veduta
