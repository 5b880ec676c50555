// Collision is against the voxels of the bake (thesis §3.1.4, §3.2): where a viewer can be is exactly where
// rows hold, and no triangle has to be in memory. Two sets are asked. The free voxels lie in view-cells, so
// they reach no lower than the lowest eye: they hold the eye. The voxels that a surface passes stop the rest
// of the body, at fences and parapets below the eye as well.
#include "viewer/window/walk.h"

#include <toml++/toml.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace veduta {
namespace {

constexpr float radius_m = 0.2f;  // of the body: more than half the distance of the eyes, and the near plane
constexpr float step_m = 0.5f;    // as high as this, what lies on the ground is stepped over
constexpr float steepest = 1.5f;  // the eye rises by at most this for a metre on the way
// Ground that is further from the body's own than this is not what it stands on: the height field knows the
// highest ground only, and the body is under a bridge or beside a wall.
constexpr float other_ground_m = 1.0f;
// What push() returns at about a voxel from a straight wall, and the part of a way that has to lead along it:
// whoever walks straighter into it stops.
constexpr float wall_pressure = 0.2f, least_slide = 0.3f;
constexpr size_t most_cells = 4096;  // asked for a place to stand

constexpr std::array<glm::vec2, 9> around{{{0, 0},
                                           {1, 0},
                                           {0.7071f, 0.7071f},
                                           {0, 1},
                                           {-0.7071f, 0.7071f},
                                           {-1, 0},
                                           {-0.7071f, -0.7071f},
                                           {0, -1},
                                           {0.7071f, -0.7071f}}};

glm::vec2 turned(const glm::vec2& v, float degrees) {
  const float angle = glm::radians(degrees), c = std::cos(angle), s = std::sin(angle);
  return {c * v.x - s * v.y, s * v.x + c * v.y};
}

}  // namespace

float baked_eye_height_m(const std::string& config) {
  constexpr double usual_m = 1.7;
  try {
    return static_cast<float>(toml::parse(config)["navigation"]["eye_height"].value_or(usual_m));
  } catch (const toml::parse_error&) {
    return static_cast<float>(usual_m);  // a file of somebody else's making
  }
}

float smooth_ground(const HeightField& ground, float x, float y) {
  const float step = ground.step_m;
  const glm::vec2 at = (glm::vec2(x - ground.lower_x, y - ground.lower_y) / step) - 0.5f;
  const glm::vec2 first = glm::floor(at), part = at - first;
  float sum = 0, weights = 0;
  for (int k = 0; k < 4; ++k) {
    const glm::vec2 corner(static_cast<float>(k & 1), static_cast<float>(k >> 1));
    const glm::vec2 middle = (first + corner + 0.5f) * step;
    const float height = ground.at(ground.lower_x + middle.x, ground.lower_y + middle.y);
    const glm::vec2 share = glm::mix(1.0f - part, part, corner);
    if (std::isnan(height)) continue;
    sum += share.x * share.y * height, weights += share.x * share.y;
  }
  // Beside the last ground its height goes on for half a square, where the field itself has some.
  return weights > 0 ? sum / weights : ground.at(x, y);
}

std::optional<glm::vec3> first_surface(const OctreeForest& surfaces, const glm::vec3& from,
                                       const glm::vec3& direction, float range_m) {
  const glm::vec3 step = glm::normalize(direction) * (surfaces.leaf_size_m / 2);
  const int steps = static_cast<int>(range_m / (surfaces.leaf_size_m / 2));
  for (int i = 1; i <= steps; ++i) {
    const glm::vec3 point = from + static_cast<float>(i) * step;
    if (surfaces.contains(point)) return point;
  }
  return std::nullopt;
}

Walker::Walker(const Navigation& navigation, float eye_height_m)
    : navigation_(navigation), eye_height_m_(eye_height_m) {}

// Of the heights at which surfaces stop the body: above what it steps over. A voxel that holds the ground
// reaches up to its own edge above it.
float Walker::lowest_of_body(const glm::vec3& eye) const {
  return eye.z - std::max(eye_height_m_ - step_m - navigation_.surfaces.leaf_size_m, 0.01f);
}

bool Walker::fits(const glm::vec3& eye) const {
  if (!navigation_.free.contains(eye)) return false;
  const OctreeForest& surfaces = navigation_.surfaces;
  const float leaf = surfaces.leaf_size_m;
  for (float z = eye.z; z > lowest_of_body(eye); z -= leaf) {
    for (const glm::vec2& to : around)
      if (surfaces.contains({glm::vec2(eye) + radius_m * to, z})) return false;
  }
  return true;
}

// One step, shorter than the body's radius; nothing when something is in the way.
std::optional<glm::vec3> Walker::step(const glm::vec3& eye, const glm::vec2& way) const {
  glm::vec3 next(glm::vec2(eye) + way, eye.z);
  const float wanted = smooth_ground(navigation_.ground, next.x, next.y) + eye_height_m_;
  if (std::abs(wanted - eye.z) <= other_ground_m) {  // not where there is no ground either
    const float most = steepest * glm::length(way);
    next.z += std::clamp(wanted - eye.z, -most, most);
  }
  // Where the voxels of the eye's height end lower or higher than it should be, the eye goes along with them.
  const float leaf = navigation_.free.leaf_size_m, level = next.z;
  for (const float off : {0.0f, eye.z - level, 0.5f * leaf, -0.5f * leaf, leaf, -leaf}) {
    next.z = level + std::clamp(off, -step_m, step_m);
    if (fits(next)) return next;
  }
  return std::nullopt;
}

// Away from the surfaces around the body, on the level; zero where there are none near. Voxels of a wall that
// is not along an axis are stairs: a body that felt them one by one would stick in their corners, so all
// within three voxels push, the nearer the more. \return a vector of length 1, times how near they are.
glm::vec2 Walker::push(const glm::vec3& eye) const {
  const OctreeForest& surfaces = navigation_.surfaces;
  const float leaf = surfaces.leaf_size_m, range = 3 * leaf;
  const glm::vec2 own = (glm::floor((glm::vec2(eye) - glm::vec2(surfaces.lower)) / leaf) + 0.5f) * leaf +
                        glm::vec2(surfaces.lower);
  glm::vec2 sum(0);
  float pressure = 0;
  for (int k = 0; k < 49; ++k) {
    const glm::vec2 voxel = own + glm::vec2(k % 7 - 3, k / 7 - 3) * leaf;
    const glm::vec2 away = glm::vec2(eye) - voxel;
    const float distance = glm::length(away), near = 1 - distance / range;
    if (near <= 0 || distance <= 0) continue;
    bool surface = false;
    for (float z = eye.z; !surface && z > lowest_of_body(eye); z -= leaf)
      surface = surfaces.contains({voxel, z});
    if (surface) sum += near / distance * away, pressure += near * near;
  }
  const float length = glm::length(sum);
  return length > 0 ? pressure / length * sum : glm::vec2(0);
}

// The step along what is near, at what speed is left in its direction, or straight on.
std::optional<glm::vec3> Walker::slide(const glm::vec3& eye, const glm::vec2& way) const {
  const glm::vec2 pushed = push(eye);
  const float pressure = glm::length(pushed), length = glm::length(way);
  const glm::vec2 away = pressure > 0 ? pushed / pressure : glm::vec2(0);
  const glm::vec2 along = way - std::min(0.0f, glm::dot(way, away)) * away;
  const bool slides = along != way && glm::length(along) > least_slide * length;
  // The nearer a wall, the more the way leads off it, so that the body keeps its distance.
  const float off = std::clamp(pressure - wall_pressure, 0.0f, 1.0f);
  if (slides && off > 0)
    if (const auto next = step(eye, along + off * length * away)) return next;
  if (const auto straight = step(eye, way)) return straight;
  for (const float more : {0.3f, 0.6f, 1.0f})
    if (slides)
      if (const auto next = step(eye, along + more * length * away)) return next;
  // Around what stands alone.
  for (const float degrees : {20.0f, -20.0f, 40.0f, -40.0f, 60.0f, -60.0f})
    if (const auto next = step(eye, std::cos(glm::radians(degrees)) * turned(way, degrees))) return next;
  return std::nullopt;
}

glm::vec3 Walker::walk(const glm::vec3& eye, const glm::vec2& way) const {
  const float length = glm::length(way);
  if (!(length > 0) || !std::isfinite(length) || !fits(eye)) return eye;
  // No step passes a wall, whose voxels are as wide as a leaf at least.
  const float longest = std::min(radius_m, navigation_.surfaces.leaf_size_m) / 2;
  const int steps = static_cast<int>(std::ceil(length / longest));
  glm::vec3 at = eye;
  for (int i = 0; i < steps; ++i) {
    const std::optional<glm::vec3> next = slide(at, way / static_cast<float>(steps));
    if (!next) break;
    at = *next;
  }
  return at;
}

// The nearest of 9 x 9 places in a cell.
std::optional<glm::vec3> Walker::stand_in(const Box& cell, const glm::vec3& point) const {
  constexpr int places = 9;
  std::optional<glm::vec3> best;
  for (int k = 0; k < places * places; ++k) {
    const glm::vec2 part = (glm::vec2(k % places, k / places) + 0.5f) / static_cast<float>(places);
    const glm::vec2 at = glm::mix(glm::vec2(cell.lower), glm::vec2(cell.upper), part);
    const float eye = smooth_ground(navigation_.ground, at.x, at.y) + eye_height_m_;
    const bool level = eye >= cell.lower.z && eye <= cell.upper.z;  // false without ground
    const glm::vec3 place(at, level ? eye : cell.center().z);
    const bool nearer =
        !best || glm::distance(glm::vec2(point), at) < glm::distance(glm::vec2(point), glm::vec2(*best));
    if (nearer && fits(place)) best = place;
  }
  return best;
}

std::optional<glm::vec3> Walker::nearest(const glm::vec3& point, const std::vector<Box>& cells) const {
  if (fits(point)) return point;
  // Over the ground first, then upwards: whoever flies comes down where he is.
  std::vector<std::pair<float, const Box*>> near;
  near.reserve(cells.size());
  for (const Box& cell : cells) {
    const glm::vec3 away = glm::abs(glm::clamp(point, cell.lower, cell.upper) - point);
    near.emplace_back(glm::length(glm::vec2(away)) + 1e-3f * away.z, &cell);
  }
  const size_t asked = std::min(near.size(), most_cells);
  std::partial_sort(near.begin(), near.begin() + static_cast<ptrdiff_t>(asked), near.end());
  for (size_t i = 0; i < asked; ++i)
    if (const auto place = stand_in(*near[i].second, point)) return place;
  return std::nullopt;
}

}  // namespace veduta
