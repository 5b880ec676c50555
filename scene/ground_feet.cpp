#include "scene/ground_feet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec4.hpp>
#include <limits>
#include <tuple>

#include "scene/ground_surface.h"

namespace veduta {
namespace {

constexpr double foot_m = 0.3;     // the lowest storey's corners are seldom digitised to better than this
constexpr double square_m = 1.0;   // thins the feet
constexpr double level_m = 0.5;    // a city within this is flat
constexpr double margin_m = 20.0;  // room to walk around the outermost buildings

// Calls visit(point) for each corner of the object, placed; a corner that polygons share, for each of them.
template <class Visit>
void visit_corners(const RawModel& model, const RawObject& object, Visit visit) {
  for (const RawPatch& patch : object.patches) {
    if (patch.polygon_begin == patch.polygon_end) continue;
    const uint64_t first = model.corners_before(model.rings_before(patch.polygon_begin));
    const uint64_t last = model.corners_before(model.rings_before(patch.polygon_end));
    for (uint64_t i = first; i < last; ++i) {
      const glm::dvec3& p = model.vertices[model.ring_vertex[i]];
      visit(object.placement == RawObject::unplaced ? p
                                                    : model.placements[object.placement] * glm::dvec4(p, 1));
    }
  }
}

void thin(std::vector<glm::dvec3>& points) {
  const auto square = [](const glm::dvec3& p) {
    return std::array{std::floor(p.x / square_m), std::floor(p.y / square_m)};
  };
  std::sort(points.begin(), points.end(), [&](const glm::dvec3& a, const glm::dvec3& b) {
    return std::tuple(square(a), a.z, a.x, a.y) < std::tuple(square(b), b.z, b.x, b.y);
  });
  points.erase(std::unique(points.begin(), points.end(),
                           [&](const glm::dvec3& a, const glm::dvec3& b) { return square(a) == square(b); }),
               points.end());
}

bool is_ground(Kind kind) {
  return kind == Kind::terrain || kind == Kind::road || kind == Kind::water;
}

bool level(const std::vector<glm::dvec3>& feet) {
  const auto [lowest, highest] = std::minmax_element(
      feet.begin(), feet.end(), [](const glm::dvec3& a, const glm::dvec3& b) { return a.z < b.z; });
  return highest->z - lowest->z <= level_m;
}

RawModel ground_model(const std::vector<glm::dvec3>& feet) {
  RawModel ground;
  ground.file = "ground";
  ground.format = "made ground";
  for (const std::array<glm::dvec3, 3>& triangle : ground_surface(feet, margin_m)) {
    for (const glm::dvec3& corner : triangle) {
      ground.ring_vertex.push_back(static_cast<uint32_t>(ground.vertices.size()));
      ground.vertices.push_back(corner);
    }
    ground.ring_end.push_back(ground.ring_vertex.size());
    ground.polygons.push_back({ground.ring_end.size(), 0, Material::terrain});
  }
  RawObject object;
  object.name = "ground";
  object.kind = Kind::terrain;
  object.place = "made ground";
  object.patches.push_back({"", "made ground", 0, ground.polygons.size()});
  ground.objects.push_back(std::move(object));
  return ground;
}

}  // namespace

std::vector<glm::dvec3> building_feet(const std::vector<RawModel>& models) {
  std::vector<glm::dvec3> feet;
  for (const RawModel& model : models)
    for (const RawObject& object : model.objects) {
      if (object.kind != Kind::building) continue;
      double lowest = std::numeric_limits<double>::infinity();
      visit_corners(model, object, [&](const glm::dvec3& p) { lowest = std::min(lowest, p.z); });
      visit_corners(model, object, [&](const glm::dvec3& p) {
        if (p.z <= lowest + foot_m) feet.push_back(p);
      });
    }
  thin(feet);
  return feet;
}

std::optional<RawModel> missing_ground(const std::vector<RawModel>& models) {
  for (const RawModel& model : models)
    for (const RawObject& object : model.objects)
      if (is_ground(object.kind) && !object.patches.empty()) return std::nullopt;
  const std::vector<glm::dvec3> feet = building_feet(models);
  if (feet.empty() || level(feet)) return std::nullopt;
  return ground_model(feet);
}

}  // namespace veduta
