#include "worker/city_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>

#include "scene/error.h"
#include "worker/cell_windows.h"
#include "worker/import_options.h"
#include "worker/shrinker.h"
#include "worker/tile_cells.h"

namespace veduta {
namespace {

constexpr float below_m = 3, above_m = 3;  // of what the section shows
constexpr double surroundings_m = 24;      // looked at around the square, besides a cell and a window

glm::dvec2 middle_of(const Settings& settings, const SectionRequest& request, const Scene& scene) {
  const glm::dvec2 origin(scene.origin[0], scene.origin[1]);
  if (request.at) return glm::dvec2((*request.at)[0], (*request.at)[1]) - origin;
  if (settings.cells.region.empty()) return glm::dvec2(scene.bounds().center());
  glm::dvec2 lower(settings.cells.region[0][0], settings.cells.region[0][1]), upper = lower;
  for (const auto& corner : settings.cells.region) {
    const glm::dvec2 p(corner[0], corner[1]);
    lower = glm::min(lower, p), upper = glm::max(upper, p);
  }
  return 0.5 * (lower + upper) - origin;
}

/// The columns of the city's frame within `half_m` of a place, by number in it.
struct Columns {
  int i0, i1, j0, j1;
};
Columns columns_around(const GridFrame& city, const glm::dvec2& middle, double half_m) {
  return {city.column_x(middle.x - half_m), city.column_x(middle.x + half_m) + 1,
          city.column_y(middle.y - half_m), city.column_y(middle.y + half_m) + 1};
}

bool has_ground(const Scene& scene) {
  return std::any_of(scene.objects.begin(), scene.objects.end(),
                     [](const Object& o) { return o.kind == Kind::terrain || o.kind == Kind::road; });
}

void add_leaves(const OctreeForest& forest, uint32_t node, const Box& bounds, const Box& square,
                std::vector<Box>& leaves) {
  uint32_t mixed = 0;
  for (uint32_t k = 0; k < 8; ++k) {
    const uint32_t state = forest.states[node] >> 2 * k & 3;
    Box child = bounds;
    for (int a = 0; a < 3; ++a) ((k >> a & 1) != 0 ? child.lower : child.upper)[a] = bounds.center()[a];
    const bool shown = child.lower.x < square.upper.x && child.upper.x > square.lower.x &&
                       child.lower.y < square.upper.y && child.upper.y > square.lower.y;
    if (state == 1 && shown) leaves.push_back(child);
    if (state == 2 && shown) add_leaves(forest, forest.first_child[node] + mixed, child, square, leaves);
    mixed += state == 2;
  }
}

std::vector<Box> leaves_of(const OctreeForest& forest, const Box& square) {
  std::vector<Box> leaves;
  for (uint32_t r = 0; r < forest.roots.size(); ++r) {
    const glm::vec3 lower = forest.lower + forest.root_edge_m() * glm::vec3(forest.roots[r]);
    add_leaves(forest, r, {lower, lower + forest.root_edge_m()}, square, leaves);
  }
  return leaves;
}

std::vector<PlacedTriangle> triangles_in(const Scene& scene, const Box& box) {
  std::vector<PlacedTriangle> triangles;
  visit_placed_triangles(scene, [&](const PlacedTriangle& triangle) {
    const Box b = bounds(triangle);
    if (b.lower.x <= box.upper.x && b.upper.x >= box.lower.x && b.lower.y <= box.upper.y &&
        b.upper.y >= box.lower.y)
      triangles.push_back(triangle);
  });
  return triangles;
}

/// The height of what is shown: from below the ground to above what stands on the line of the section.
void set_heights(SectionContent& content, float ground_m, const std::vector<PlacedTriangle>& triangles) {
  float lowest = ground_m, highest = ground_m;
  for (const PlacedTriangle& triangle : triangles) {
    const Box b = bounds(triangle);
    if (b.lower.y > content.cut.y || b.upper.y < content.cut.y || b.lower.x > content.square.upper.x ||
        b.upper.x < content.square.lower.x)
      continue;
    highest = std::max(highest, b.upper.z);
    if (triangle.kind == Kind::terrain) lowest = std::min(lowest, b.upper.z);
  }
  content.square.lower.z = lowest - below_m, content.square.upper.z = highest + above_m;
}

}  // namespace

SectionContent city_section(const Settings& settings, const SectionRequest& request) {
  const Scene scene =
      import_scene({settings.scene.model.begin(), settings.scene.model.end()}, import_options(settings))
          .scene;
  const Box all = scene.bounds();
  const glm::dvec2 middle = middle_of(settings, request, scene);
  if (middle.x < all.lower.x || middle.y < all.lower.y || middle.x > all.upper.x || middle.y > all.upper.y) {
    throw Error(
        ExitStatus::usage,
        fmt::format(
            "section: {:.1f}, {:.1f} is not in the scene, which is {:.1f} to {:.1f} by {:.1f} to {:.1f}",
            middle.x + scene.origin[0], middle.y + scene.origin[1], all.lower.x + scene.origin[0],
            all.upper.x + scene.origin[0], all.lower.y + scene.origin[1], all.upper.y + scene.origin[1]));
  }

  const GridFrame city = make_frame(all, seeds_per_voxel * settings.navigation.seed_size_m,
                                    std::numeric_limits<uint64_t>::max());
  const CellOptions cells = cell_options(settings, scene.origin, city, all.lower.z, has_ground(scene));
  const glm::dvec3 half_extent_m = part_half_extent(settings, 0, settings.occlusion.subdivide);
  const double around_m = surroundings_m + half_extent_m.x + 2 * cell_halo_columns(cells) * city.size_m;
  const Columns seen = columns_around(city, middle, request.size_m / 2),
                known = columns_around(city, middle, request.size_m / 2 + around_m);
  GridFrame frame = city;
  frame.i0 += known.i0, frame.nx = known.i1 - known.i0;
  frame.j0 += known.j0, frame.ny = known.j1 - known.j0;
  const Columns core{seen.i0 - known.i0, seen.i1 - known.i0, seen.j0 - known.j0, seen.j1 - known.j0};

  const Box surroundings = frame.box(0, frame.nx - 1, 0, frame.ny - 1, 0, frame.nz - 1);
  SealedBlock block{
      make_seed_region(scene, frame), triangles_in(scene, surroundings), core.i0, core.i1, core.j0, core.j1};
  const Columns placed =  // cells that reach into the square
      columns_around(frame, middle, request.size_m / 2 + cell_halo_columns(cells) * city.size_m);
  CellGatherer gatherer(cells);
  gatherer.add(
      make_tile_cells(block.region, block.triangles, placed.i0, placed.i1, placed.j0, placed.j1, cells));
  Navigation navigation;
  std::vector<Box> view_cells = gatherer.finish(navigation);
  const auto x = static_cast<float>(middle.x), y = static_cast<float>(middle.y);
  const float found_m = navigation.ground.at(x, y), ground_m = std::isnan(found_m) ? all.lower.z : found_m;

  ShrinkRequest shrinking;
  shrinking.half_extents_m = {half_extent_m};
  shrinking.resolution = settings.occlusion.resolution;
  shrinking.reach_m = glm::distance(all.lower, all.upper);
  shrinking.lowest_eye_m = ground_m;
  std::vector<WindowOccluders> occluders = make_shrinker(settings.shrink.method)->shrink(block, shrinking);

  const Box square = frame.box(core.i0, core.i1 - 1, core.j0, core.j1 - 1, 0, 0);
  const std::string model = std::filesystem::path(settings.scene.model[0]).filename().string();
  SectionContent content{
      std::move(block.region),
      fmt::format(
          "{}: {:.0f} m around {:.1f}, {:.1f}; shrink.method {} for parts of e = {:.2f} x {:.2f} x {:.2f} m",
          model, request.size_m, middle.x + scene.origin[0], middle.y + scene.origin[1],
          settings.shrink.method, half_extent_m.x, half_extent_m.y, half_extent_m.z),
      square,
      {x, y, ground_m + static_cast<float>(settings.navigation.eye_height_m)},
      std::move(view_cells),
      leaves_of(navigation.free, square),
      leaves_of(navigation.surfaces, square),
      std::move(occluders.front())};
  set_heights(content, ground_m, block.triangles);
  return content;
}

}  // namespace veduta
