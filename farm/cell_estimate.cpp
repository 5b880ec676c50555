#include "farm/cell_estimate.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <vector>

#include "scene/polygon_contains.h"

namespace veduta {
namespace {

constexpr float nothing = std::numeric_limits<float>::infinity();
constexpr int finest_columns = 8;     // along the edge of a cell
constexpr double most_columns = 1e8;  // of a plan: 100 MB
constexpr double eye_slack_m = 0.25;  // walk cells hold eyes at eye height +- this

bool is_ground(Kind kind) {
  return kind == Kind::terrain || kind == Kind::road || kind == Kind::bridge;
}

/// The squares of the lattice of cells over a part of the scene, and columns in them.
struct Plan {
  double column_m = 1;
  int columns = 1;         ///< along the edge of a square
  int64_t i0 = 0, j0 = 0;  ///< the first square
  int64_t nx = 0, ny = 0;  ///< squares
  int64_t width() const { return nx * columns; }
};

Plan make_plan(const Box& bounds, const Settings& settings, const std::vector<glm::dvec2>& region) {
  glm::dvec2 lower(bounds.lower), upper(bounds.upper);
  if (!region.empty()) {
    glm::dvec2 region_lower = region[0], region_upper = region[0];
    for (const glm::dvec2& corner : region)
      region_lower = glm::min(region_lower, corner), region_upper = glm::max(region_upper, corner);
    lower = glm::max(lower, region_lower), upper = glm::min(upper, region_upper);
  }
  const double size = settings.cells.size_m;
  Plan plan;
  plan.i0 = std::llround(std::floor(lower.x / size)), plan.j0 = std::llround(std::floor(lower.y / size));
  plan.nx = std::max<int64_t>(0, std::llround(std::ceil(upper.x / size)) - plan.i0);
  plan.ny = std::max<int64_t>(0, std::llround(std::ceil(upper.y / size)) - plan.j0);
  const double squares = static_cast<double>(plan.nx) * static_cast<double>(plan.ny);
  plan.columns =
      std::clamp(static_cast<int>(std::sqrt(most_columns / std::max(1.0, squares))), 1, finest_columns);
  plan.column_m = size / plan.columns;
  return plan;
}

/// visit(column, height of the triangle there) for the columns whose middle a triangle lies over.
template <typename Visit>
void columns_under(const Plan& plan, const std::array<glm::vec3, 3>& corners, const Visit& visit) {
  const glm::dvec2 first(static_cast<double>(plan.i0 * plan.columns),
                         static_cast<double>(plan.j0 * plan.columns));
  std::array<glm::dvec2, 3> p;  // in columns, from the middle of the first
  for (size_t c = 0; c < 3; ++c) p[c] = glm::dvec2(corners[c]) / plan.column_m - first - 0.5;
  const auto cross = [](glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; };
  const double area = cross(p[1] - p[0], p[2] - p[0]);
  if (area == 0) return;
  const auto range = [](double a, double b, double c, int64_t count) {
    const double low = std::max(0.0, std::ceil(std::min({a, b, c})));
    const double high = std::min(static_cast<double>(count) - 1, std::floor(std::max({a, b, c})));
    return std::pair(static_cast<int64_t>(low), low <= high ? static_cast<int64_t>(high) : int64_t{-1});
  };
  const auto [j_first, j_last] = range(p[0].y, p[1].y, p[2].y, plan.ny * plan.columns);
  const auto [i_first, i_last] = range(p[0].x, p[1].x, p[2].x, plan.width());
  for (int64_t j = j_first; j <= j_last; ++j)
    for (int64_t i = i_first; i <= i_last; ++i) {
      const glm::dvec2 q(static_cast<double>(i), static_cast<double>(j));
      const double u = cross(p[2] - p[1], q - p[1]) / area, v = cross(p[0] - p[2], q - p[2]) / area;
      if (u < 0 || v < 0 || u + v > 1) continue;
      visit(i, j, static_cast<float>(u * corners[0].z + v * corners[1].z + (1 - u - v) * corners[2].z));
    }
}

/// Of a square.
struct Heights {
  float ground_low = nothing, ground_high = -nothing, top = -nothing;
};

uint64_t boxes_of(const Heights& heights, const Settings& settings) {
  if (heights.ground_low > heights.ground_high) return 0;
  const double height_m = settings.cells.height_m;
  const double range_m = heights.ground_high - heights.ground_low;
  if (settings.navigation.mode == "walk")
    return static_cast<uint64_t>(std::ceil((range_m + 2 * eye_slack_m) / height_m));
  const double from_m = heights.ground_low + settings.navigation.fly_lowest_m;
  const double to_m = heights.ground_high + settings.navigation.fly_highest_m;
  const double open_from_m = std::clamp(static_cast<double>(heights.top), from_m, to_m);
  // Where all is free, larger cells take the place of small ones.
  const double united = std::pow(settings.cells.largest, 3);
  return static_cast<uint64_t>(
      std::ceil((open_from_m - from_m) / height_m + (to_m - open_from_m) / height_m / united));
}

}  // namespace

uint64_t estimate_cells(const Scene& scene, const Settings& settings) {
  std::vector<glm::dvec2> region;
  for (const auto& corner : settings.cells.region)
    region.push_back({corner[0] - scene.origin[0], corner[1] - scene.origin[1]});
  const Box bounds = scene.bounds();
  const Plan plan = make_plan(bounds, settings, region);
  std::vector<Heights> squares(static_cast<size_t>(plan.nx * plan.ny));
  std::vector<bool> taken(squares.size() * static_cast<size_t>(plan.columns * plan.columns), false);
  const auto square = [&](int64_t i, int64_t j) -> Heights& {
    return squares[static_cast<size_t>(j / plan.columns * plan.nx + i / plan.columns)];
  };
  const auto column = [&](int64_t i, int64_t j) { return static_cast<size_t>(j * plan.width() + i); };
  const auto add_ground = [&](int64_t i, int64_t j, float z) {
    if (taken[column(i, j)]) return;
    Heights& heights = square(i, j);
    heights.ground_low = std::min(heights.ground_low, z);
    heights.ground_high = std::max(heights.ground_high, z);
  };
  bool has_ground = false;
  for (size_t o = 0; o < scene.objects.size(); ++o) {
    const Kind kind = scene.objects[o].kind;
    has_ground = has_ground || kind == Kind::terrain || kind == Kind::road;
    if (is_ground(kind) || kind == Kind::water) continue;
    visit_triangles(scene, o, [&](uint64_t, const std::array<glm::vec3, 3>& corners) {
      columns_under(plan, corners, [&](int64_t i, int64_t j, float z) {
        taken[column(i, j)] = true;
        square(i, j).top = std::max(square(i, j).top, z);
      });
    });
  }
  if (has_ground) {
    for (size_t o = 0; o < scene.objects.size(); ++o)
      if (is_ground(scene.objects[o].kind))
        visit_triangles(scene, o, [&](uint64_t, const std::array<glm::vec3, 3>& corners) {
          columns_under(plan, corners, add_ground);
        });
  } else {
    for (int64_t j = 0; j < plan.ny * plan.columns; ++j)
      for (int64_t i = 0; i < plan.width(); ++i) add_ground(i, j, bounds.lower.z);
  }
  uint64_t cells = 0;
  for (int64_t j = 0; j < plan.ny; ++j)
    for (int64_t i = 0; i < plan.nx; ++i) {
      const glm::dvec2 middle((static_cast<double>(plan.i0 + i) + 0.5) * settings.cells.size_m,
                              (static_cast<double>(plan.j0 + j) + 0.5) * settings.cells.size_m);
      if (!region.empty() && !polygon_contains(region, middle)) continue;
      cells += boxes_of(squares[static_cast<size_t>(j * plan.nx + i)], settings);
    }
  return cells;
}

}  // namespace veduta
