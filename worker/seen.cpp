// Every hit counts as seen. A hit in float that exact arithmetic would give to the neighbour, behind an edge
// by less than a unit in the last place, can name something hidden: the row then errs towards visible.
#include "worker/seen.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "scene/random.h"
#include "scene/ray_scene.h"
#include "worker/seen_eyes.h"

namespace veduta {
namespace {

constexpr size_t eyes_per_cell = 32;
constexpr size_t rays_around = 512;      // from each eye, looking all round
constexpr size_t least_batch = 64;       // rays aimed at once: packets are to be full
constexpr uint32_t triangle_block = 64;  // triangles for each entry of the table of objects
// Half a gigabyte of the tiles that rays of the last cells reached. Too few would be built again for each
// cell.
constexpr uint64_t most_triangles = 1u << 23;
constexpr uint64_t look_seed = 1, aim_seed = 2;

// An azimuth in each of `count` sectors; elevations crowd around the horizon, where a city is. The cube: half
// of the rays within an eighth of the height of the sphere.
void look_around(size_t count, Random& random, std::vector<glm::vec3>& directions) {
  for (size_t i = 0; i < count; ++i) {
    const float side = 2 * random.unit() - 1, z = side * side * side;
    const float azimuth =
        2 * std::numbers::pi_v<float> * (static_cast<float>(i) + random.unit()) / static_cast<float>(count);
    const float radius = std::sqrt(1 - z * z);
    directions.emplace_back(radius * std::cos(azimuth), radius * std::sin(azimuth), z);
  }
}

using Corners = std::array<glm::vec3, 3>;

Corners corners_of(const Scene& scene, uint64_t triangle) {
  const glm::uvec3& t = scene.triangles[triangle];
  return {scene.vertices[t.x], scene.vertices[t.y], scene.vertices[t.z]};
}

// Of four triangles of the object the one that `rank` puts highest: a preference without a table.
template <typename Rank>
Corners best_of_four(const Scene& scene, const Object& object, Random& random, const Rank& rank) {
  Corners best{};
  float highest = -std::numeric_limits<float>::infinity();
  for (int i = 0; i < 4; ++i) {
    const Corners corners =
        corners_of(scene, object.triangle_begin + random.below(object.triangle_end - object.triangle_begin));
    const float value = rank(corners);
    if (value > highest) best = corners, highest = value;
  }
  return best;
}

float area(const Corners& c) {
  return glm::length(glm::cross(c[1] - c[0], c[2] - c[0]));
}

float top(const Corners& c) {
  return std::max({c[0].z, c[1].z, c[2].z});
}

// Where to aim at an object: three times in four at a high triangle, beside its highest corner or along
// its highest edge, since what first shows over a roof are corners and ridges; else anywhere on a large
// one.
glm::vec3 point_of(const Scene& scene, const Object& object, Random& random) {
  Corners corners;
  if (random.below(4) == 0) {
    corners = best_of_four(scene, object, random, area);
  } else {
    corners = best_of_four(scene, object, random, top);
    std::sort(corners.begin(), corners.end(),
              [](const glm::vec3& a, const glm::vec3& b) { return a.z > b.z; });
    // A little inside: what is aimed at an edge itself passes by it half of the time.
    constexpr float inside = 0.02f;
    corners[2] = glm::mix(corners[0], corners[2], inside);
    if (random.below(2) == 0) corners[1] = glm::mix(corners[0], corners[1], inside);
  }
  const float root = std::sqrt(random.unit()), side = random.unit();
  return corners[0] * (1 - root) + corners[1] * (root * (1 - side)) + corners[2] * (root * side);
}

}  // namespace

struct SeenSampler::Tracer {
  Tracer(const City& a_city, const SliceBoxes& a_slices) : city(a_city), slices(a_slices) {
    const std::vector<Object>& objects = city.scene.objects;
    for (uint32_t o = 0; o < objects.size(); ++o) {
      bounds.push_back(city.scene.bounds(o));
      while (first_object.size() * triangle_block < objects[o].triangle_end) first_object.push_back(o);
    }
  }

  uint32_t object_of(uint32_t triangle) const {
    uint32_t object = first_object[triangle / triangle_block];
    while (triangle >= city.scene.objects[object].triangle_end) ++object;
    return object;
  }

  // Shoots `directions` from an eye and marks what they meet.
  void shoot(const glm::vec3& eye, RayOrder order, Seen& seen) {
    hits.resize(directions.size());
    rays->first_hits(eye, directions, hits, order);
    for (size_t i = 0; i < hits.size(); ++i)
      if (hits[i].triangle != Hit::none)
        mark(hits[i].triangle, eye + directions[i] * hits[i].distance_m, seen);
    seen.rays += directions.size();
    directions.clear();
  }

  void mark(uint32_t triangle, const glm::vec3& point, Seen& seen) const {
    const uint32_t object = object_of(triangle);
    seen.objects += seen.object[object] == 0;
    seen.object[object] = 1;
    const SliceCounts& n = city.slices[object];
    const TriangleSlices& t = city.triangle_slices[triangle];
    const Box& box = bounds[object];
    // 0-based; the point is a little off, but only slices that its triangle touches come into question.
    const auto slice = [&](int axis, int count, int first, int last) {
      const double step = (static_cast<double>(box.upper[axis]) - box.lower[axis]) / count;
      const double number =
          step > 0 ? std::floor((static_cast<double>(point[axis]) - box.lower[axis]) / step) : 0;
      return static_cast<uint32_t>(std::clamp(number, first - 1.0, last - 1.0));
    };
    const auto height = static_cast<uint8_t>(t.z_last - 1);
    const uint32_t begin = slices.object_slice_begin[object];
    for (const uint32_t vertical :
         {begin + slice(0, n.x, t.x_first, t.x_last), begin + n.x + slice(1, n.y, t.y_first, t.y_last)})
      seen.lowest[vertical] = std::min(seen.lowest[vertical], height);
  }

  const City& city;
  const SliceBoxes& slices;
  std::vector<Box> bounds;             // of each object
  std::vector<uint32_t> first_object;  // of each block of triangles, the object of its first
  std::unique_ptr<RayScene> rays;      // made when first needed
  // Kept for their memory.
  std::vector<glm::vec3> directions;
  std::vector<Hit> hits;
  std::vector<uint32_t> unseen;
};

SeenSampler::SeenSampler(const City& city, const SliceBoxes& slices)
    : tracer_(std::make_unique<Tracer>(city, slices)) {}

SeenSampler::~SeenSampler() = default;

void SeenSampler::look(uint32_t cell, Seen& seen) const {
  Tracer& tracer = *tracer_;
  const City& city = tracer.city;
  seen.eyes.clear();
  seen.object.assign(city.scene.objects.size(), 0);
  seen.lowest.resize(tracer.slices.slices.size());
  for (size_t i = 0; i < seen.lowest.size(); ++i)
    seen.lowest[i] = static_cast<uint8_t>(tracer.slices.slices[i].heights);
  seen.objects = 0, seen.rays = 0;
  if (city.scene.triangles.empty()) return;
  if (!tracer.rays) tracer.rays = std::make_unique<RayScene>(city.scene, RaySpeed::on_demand);
  tracer.rays->keep_within(most_triangles);
  Random random(look_seed, cell);
  choose_eyes(city.navigation.free, *tracer.rays, city.cells[cell], eyes_per_cell, Random(random.bits()),
              seen.eyes);
  for (const glm::vec3& eye : seen.eyes) {
    look_around(rays_around, random, tracer.directions);
    tracer.shoot(eye, RayOrder::ordered, seen);
  }
}

void SeenSampler::aim(std::span<const uint32_t> objects, uint32_t rays_each, Seen& seen) const {
  if (seen.eyes.empty()) return;
  Tracer& tracer = *tracer_;
  const Scene& scene = tracer.city.scene;
  Random random(aim_seed, seen.rays);
  std::vector<uint32_t>& unseen = tracer.unseen;
  unseen.assign(objects.begin(), objects.end());
  // One eye after the other, so that rays go in packets, and what one eye has seen drops out for the next.
  size_t eye = random.below(seen.eyes.size());
  for (uint32_t turn = 0; turn < rays_each; eye = (eye + 1) % seen.eyes.size()) {
    std::erase_if(unseen, [&](uint32_t o) {
      return seen.object[o] != 0 || scene.objects[o].triangle_begin == scene.objects[o].triangle_end;
    });
    if (unseen.empty()) return;
    const auto fill = static_cast<uint32_t>((least_batch + unseen.size() - 1) / unseen.size());
    const uint32_t end = std::min(rays_each, turn + fill);
    for (; turn < end; ++turn) {
      for (const uint32_t o : unseen) {
        const glm::vec3 away = point_of(scene, scene.objects[o], random) - seen.eyes[eye];
        const float distance_m = glm::length(away);
        // An eye on the point itself sees it from anywhere else.
        if (distance_m > 0) tracer.directions.push_back(away / distance_m);
      }
    }
    tracer.shoot(seen.eyes[eye], RayOrder::scattered, seen);
  }
}

}  // namespace veduta
