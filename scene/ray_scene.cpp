// Two Embree scenes: the triangles, and (made when first asked for) their bounds, through which a ray
// collects all that it might meet without trusting a float intersection.
#include "scene/ray_scene.h"

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <mutex>
#include <optional>

#include "scene/error.h"
#include "scene/ray_tiles.h"

namespace veduta {
namespace {

struct DeviceRelease {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct SceneRelease {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, DeviceRelease>;
using Hierarchy = std::unique_ptr<std::remove_pointer_t<RTCScene>, SceneRelease>;

void check(RTCDevice device, const char* step) {
  const RTCError error = rtcGetDeviceError(device);
  if (error != RTC_ERROR_NONE)
    throw Error(ExitStatus::defect,
                fmt::format("rays: Embree: {} failed with code {}; is there enough memory?", step,
                            static_cast<int>(error)));
}

// Traversal in float may miss a box by a few units in the last place; this margin is some ten times wider.
Box widened(const Box& box) {
  const glm::vec3 reach = glm::max(glm::abs(box.lower), glm::abs(box.upper));
  const float margin = 1e-5f * std::max({reach.x, reach.y, reach.z, 1e-3f});
  return {box.lower - margin, box.upper + margin};
}

Box bounds_of(const Scene& scene, uint32_t triangle) {
  Box box;
  for (int corner = 0; corner < 3; ++corner) box.extend(scene.vertices[scene.triangles[triangle][corner]]);
  return widened(box);
}

// Handed through Embree to collect(): the context must come first.
struct Collection {
  RTCIntersectContext context;
  std::vector<uint32_t>* triangles;
};

void give_bounds(const RTCBoundsFunctionArguments* arguments) {
  const Box box = bounds_of(*static_cast<const Scene*>(arguments->geometryUserPtr), arguments->primID);
  *arguments->bounds_o = {box.lower.x, box.lower.y, box.lower.z, 0, box.upper.x, box.upper.y, box.upper.z, 0};
}

// Called for every box that the ray may meet; never reports a hit, so the ray goes on to its far end.
void collect(const RTCIntersectFunctionNArguments* arguments) {
  reinterpret_cast<Collection*>(arguments->context)->triangles->push_back(arguments->primID);
}

void sort_out(std::vector<uint32_t>& triangles) {
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
}

Hierarchy commit(RTCDevice device, RTCGeometry geometry, RaySpeed speed, const char* step) {
  rtcCommitGeometry(geometry);
  Hierarchy hierarchy(rtcNewScene(device));
  rtcSetSceneFlags(hierarchy.get(), speed == RaySpeed::fast ? RTC_SCENE_FLAG_ROBUST
                                                            : RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_COMPACT);
  rtcAttachGeometry(hierarchy.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(hierarchy.get());
  check(device, step);
  return hierarchy;
}

Hierarchy build_triangles(RTCDevice device, const Scene& scene, RaySpeed speed) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  // Vertices are copied: Embree reads 16 bytes at every one, past the end of a vector of 12-byte ones.
  void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                           sizeof(glm::vec3), scene.vertices.size());
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, scene.triangles.data(), 0,
                             sizeof(glm::uvec3), scene.triangles.size());
  check(device, "making room for the model");
  std::memcpy(vertices, scene.vertices.data(), scene.vertices.size() * sizeof(glm::vec3));
  return commit(device, geometry, speed, "building the hierarchy of triangles");
}

Hierarchy build_bounds(RTCDevice device, const Scene& scene) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(scene.triangles.size()));
  rtcSetGeometryUserData(geometry, const_cast<Scene*>(&scene));
  rtcSetGeometryBoundsFunction(
      geometry, [](const RTCBoundsFunctionArguments* a) { give_bounds(a); }, nullptr);
  rtcSetGeometryIntersectFunction(geometry, collect);
  return commit(device, geometry, RaySpeed::compact, "building the hierarchy of bounds");
}

}  // namespace

struct RayScene::Tracer {
  Tracer(const Scene& city, RaySpeed speed, uint64_t tile_triangles) : scene(city) {
    check(device.get(), "starting");
    if (speed == RaySpeed::on_demand)
      tiles.emplace(device.get(), scene, tile_triangles);
    else
      triangles = build_triangles(device.get(), scene, speed);
  }
  RTCScene hierarchy() const { return tiles ? tiles->hierarchy() : triangles.get(); }
  RTCScene boxes() {
    std::call_once(bounds_made, [this] { bounds = build_bounds(device.get(), scene); });
    return bounds.get();
  }

  // ray_at(i) is ray number i of `count`.
  template <typename RayAt>
  void trace(size_t count, const RayAt& ray_at, std::span<Hit> hits, RayOrder order) {
    constexpr size_t width = 16;
    alignas(64) RTCRayHit16 packet;
    alignas(64) int valid[width];
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = order == RayOrder::ordered ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                               : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    for (size_t begin = 0; begin < count; begin += width) {
      const size_t in_packet = std::min(width, count - begin);
      for (size_t i = 0; i < width; ++i) {
        const Ray ray = ray_at(begin + std::min(i, in_packet - 1));
        valid[i] = i < in_packet ? -1 : 0;
        packet.ray.org_x[i] = ray.eye.x, packet.ray.org_y[i] = ray.eye.y, packet.ray.org_z[i] = ray.eye.z;
        packet.ray.dir_x[i] = ray.direction.x, packet.ray.dir_y[i] = ray.direction.y,
        packet.ray.dir_z[i] = ray.direction.z;
        packet.ray.tnear[i] = 0, packet.ray.tfar[i] = std::numeric_limits<float>::infinity();
        packet.ray.time[i] = 0, packet.ray.mask[i] = ~0u, packet.ray.id[i] = 0, packet.ray.flags[i] = 0;
        packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID, packet.hit.primID[i] = RTC_INVALID_GEOMETRY_ID;
      }
      rtcIntersect16(valid, hierarchy(), &context, &packet);
      if (tiles) tiles->rethrow();
      for (size_t i = 0; i < in_packet; ++i) {
        const bool met = packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
        hits[begin + i] = {met ? packet.hit.primID[i] : Hit::none, packet.ray.tfar[i]};
      }
    }
  }

  const Scene& scene;
  // One thread builds: among coincident triangles the hierarchy's order decides which is hit, and it must not
  // vary. While a device of one thread is the only one, Embree holds the whole process to one thread (through
  // TBB); the other device lifts that.
  Device device{rtcNewDevice("threads=1")}, many_threads{rtcNewDevice(nullptr)};
  Hierarchy triangles, bounds;
  std::optional<RayTiles> tiles;  // in place of `triangles`
  std::once_flag bounds_made;
};

RayScene::RayScene(const Scene& scene, RaySpeed speed, uint64_t tile_triangles) {
  if (scene.triangles.empty() || scene.triangles.size() >= Hit::none)
    throw Error(ExitStatus::bad_input,
                fmt::format("rays: the scene has {} triangles; from 1 to 2^32 - 2 can be traced",
                            scene.triangles.size()));
  tracer_ = std::make_unique<Tracer>(scene, speed, tile_triangles);
}

RayScene::~RayScene() = default;

void RayScene::first_hits(const glm::vec3& eye, std::span<const glm::vec3> directions, std::span<Hit> hits,
                          RayOrder order) const {
  tracer_->trace(
      directions.size(),
      [&](size_t i) {
        return Ray{eye, directions[i]};
      },
      hits, order);
}

void RayScene::first_hits(std::span<const Ray> rays, std::span<Hit> hits, RayOrder order) const {
  tracer_->trace(
      rays.size(), [&](size_t i) { return rays[i]; }, hits, order);
}

bool RayScene::blocked(const glm::vec3& from, const glm::vec3& to) const {
  const glm::vec3 step = to - from;
  RTCRay ray{};
  ray.org_x = from.x, ray.org_y = from.y, ray.org_z = from.z;
  ray.dir_x = step.x, ray.dir_y = step.y, ray.dir_z = step.z;
  ray.tfar = 1.001f, ray.mask = ~0u;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(tracer_->hierarchy(), &context, &ray);
  if (tracer_->tiles) tracer_->tiles->rethrow();
  return ray.tfar < 0;
}

void RayScene::keep_within(uint64_t triangles) {
  if (tracer_->tiles) tracer_->tiles->keep_within(triangles);
}

uint64_t RayScene::triangles_held() const {
  return tracer_->tiles ? tracer_->tiles->triangles() : tracer_->scene.triangles.size();
}

std::vector<uint32_t> RayScene::triangles_near(const glm::vec3& eye, const glm::vec3& direction,
                                               float distance_m) const {
  std::vector<uint32_t> found;
  Collection collection{{}, &found};
  rtcInitIntersectContext(&collection.context);
  RTCRayHit ray{};
  ray.ray.org_x = eye.x, ray.ray.org_y = eye.y, ray.ray.org_z = eye.z;
  ray.ray.dir_x = direction.x, ray.ray.dir_y = direction.y, ray.ray.dir_z = direction.z;
  ray.ray.tfar = distance_m * 1.0001f + 1e-3f, ray.ray.mask = ~0u;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(tracer_->boxes(), &collection.context, &ray);
  sort_out(found);
  return found;
}

std::vector<uint32_t> RayScene::triangles_around(const glm::vec3& center, float radius_m) const {
  std::vector<uint32_t> found;
  RTCPointQuery ball{center.x, center.y, center.z, 0, radius_m};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  const auto keep = [](RTCPointQueryFunctionArguments* arguments) {
    static_cast<std::vector<uint32_t>*>(arguments->userPtr)->push_back(arguments->primID);
    return false;  // the ball stays as it is
  };
  rtcPointQuery(tracer_->boxes(), &ball, &context, keep, &found);
  sort_out(found);
  return found;
}

}  // namespace veduta
