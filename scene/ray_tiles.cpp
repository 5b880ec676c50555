#include "scene/ray_tiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "scene/error.h"

namespace veduta {
namespace {

void check(RTCDevice device, const char* step) {
  const RTCError error = rtcGetDeviceError(device);
  if (error != RTC_ERROR_NONE)
    throw Error(ExitStatus::defect,
                fmt::format("rays: Embree: {} failed with code {}; is there enough memory?", step,
                            static_cast<int>(error)));
}

/// Calls intersect16 and so on, by the number of rays.
void intersect_any(unsigned rays, const int* valid, RTCScene scene, RTCIntersectContext* context,
                   RTCRayHitN* rayhit) {
  switch (rays) {
    case 1:
      return rtcIntersect1(scene, context, reinterpret_cast<RTCRayHit*>(rayhit));
    case 4:
      return rtcIntersect4(valid, scene, context, reinterpret_cast<RTCRayHit4*>(rayhit));
    case 8:
      return rtcIntersect8(valid, scene, context, reinterpret_cast<RTCRayHit8*>(rayhit));
    default:
      return rtcIntersect16(valid, scene, context, reinterpret_cast<RTCRayHit16*>(rayhit));
  }
}

}  // namespace

RayTiles::RayTiles(RTCDevice device, const Scene& scene, uint64_t tile_triangles)
    : device_(device), scene_(scene) {
  std::vector<Place> places;
  for (uint32_t o = 0; o < scene.objects.size(); ++o)
    if (triangles_of(o) > 0) places.push_back({o, scene.bounds(o)});
  divide(places.data(), places.data() + places.size(), tile_triangles);

  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(tiles_.size()));
  rtcSetGeometryUserData(geometry, this);
  rtcSetGeometryBoundsFunction(
      geometry,
      [](const RTCBoundsFunctionArguments* a) {
        const Box& box = static_cast<const RayTiles*>(a->geometryUserPtr)->tiles_[a->primID].bounds;
        *a->bounds_o = {box.lower.x, box.lower.y, box.lower.z, 0, box.upper.x, box.upper.y, box.upper.z, 0};
      },
      nullptr);
  rtcSetGeometryIntersectFunction(geometry, intersect);
  rtcSetGeometryOccludedFunction(geometry, occlude);
  rtcCommitGeometry(geometry);
  top_ = rtcNewScene(device);
  rtcSetSceneFlags(top_, RTC_SCENE_FLAG_ROBUST);
  rtcAttachGeometry(top_, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(top_);
  check(device, "building the hierarchy of tiles");
}

RayTiles::~RayTiles() {
  for (const Tile& tile : tiles_)
    if (tile.built != nullptr) rtcReleaseScene(tile.built);
  if (top_ != nullptr) rtcReleaseScene(top_);
}

void RayTiles::rethrow() {
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

uint64_t RayTiles::triangles_of(uint32_t object) const {
  return scene_.objects[object].triangle_end - scene_.objects[object].triangle_begin;
}

/// Halves by number of objects, across the longer side of where their middles lie.
void RayTiles::divide(Place* begin, Place* end, uint64_t tile_triangles) {
  uint64_t triangles = 0;
  Box middles, bounds;
  for (const Place* p = begin; p < end; ++p) {
    triangles += triangles_of(p->object);
    middles.extend(p->bounds.center()), bounds.extend(p->bounds);
  }
  if (triangles > tile_triangles && end - begin > 1) {
    const glm::vec3 size = middles.upper - middles.lower;
    const int axis = size.y > size.x ? 1 : 0;
    Place* const half = begin + (end - begin) / 2;
    std::nth_element(begin, half, end, [&](const Place& a, const Place& b) {
      return std::pair(a.bounds.center()[axis], a.object) < std::pair(b.bounds.center()[axis], b.object);
    });
    divide(begin, half, tile_triangles);
    divide(half, end, tile_triangles);
    return;
  }
  if (begin == end) return;
  Tile& tile = tiles_.emplace_back();
  tile.bounds = bounds, tile.triangles = triangles;
  for (const Place* p = begin; p < end; ++p) tile.objects.push_back(p->object);
  std::sort(tile.objects.begin(), tile.objects.end());
}

RayTiles::Tile* RayTiles::reach(uint32_t number) noexcept {
  Tile& tile = tiles_[number];
  tile.last_use = ++uses_;
  if (tile.built == nullptr) {
    // Not through Embree, whose frames are between here and who asked for the ray.
    try {
      build(tile);
    } catch (...) {
      failure_ = std::current_exception();
      return nullptr;
    }
    triangles_ += tile.triangles;
  }
  return &tile;
}

void RayTiles::build(Tile& tile) const {
  std::vector<uint32_t> numbers, vertices;
  for (const uint32_t o : tile.objects) {
    for (uint64_t t = scene_.objects[o].triangle_begin; t < scene_.objects[o].triangle_end; ++t) {
      numbers.push_back(static_cast<uint32_t>(t));
      for (int corner = 0; corner < 3; ++corner) vertices.push_back(scene_.triangles[t][corner]);
    }
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());

  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* const positions = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), vertices.size()));
  auto* const corners = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), numbers.size()));
  check(device_, "making room for a tile");
  for (size_t v = 0; v < vertices.size(); ++v) positions[v] = scene_.vertices[vertices[v]];
  for (size_t t = 0; t < numbers.size(); ++t) {
    for (int corner = 0; corner < 3; ++corner) {
      const uint32_t vertex = scene_.triangles[numbers[t]][corner];
      corners[t][corner] = static_cast<uint32_t>(std::lower_bound(vertices.begin(), vertices.end(), vertex) -
                                                 vertices.begin());
    }
  }
  rtcCommitGeometry(geometry);
  RTCScene built = rtcNewScene(device_);
  rtcSetSceneFlags(built, RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_COMPACT);
  rtcAttachGeometry(built, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(built);
  check(device_, "building the hierarchy of a tile");
  tile.built = built, tile.numbers = std::move(numbers);
}

/// A hit of the tile has its number of the triangle; it becomes the scene's.
void RayTiles::intersect(const RTCIntersectFunctionNArguments* a) {
  const Tile* tile = static_cast<RayTiles*>(a->geometryUserPtr)->reach(a->primID);
  if (tile == nullptr) return;
  RTCHitN* hits = RTCRayHitN_HitN(a->rayhit, a->N);
  std::array<unsigned, 16> before;
  for (unsigned i = 0; i < a->N; ++i) {
    before[i] = RTCHitN_geomID(hits, a->N, i);
    if (a->valid[i] != 0) RTCHitN_geomID(hits, a->N, i) = RTC_INVALID_GEOMETRY_ID;
  }
  intersect_any(a->N, a->valid, tile->built, a->context, a->rayhit);
  for (unsigned i = 0; i < a->N; ++i) {
    if (a->valid[i] == 0) continue;
    if (RTCHitN_geomID(hits, a->N, i) == RTC_INVALID_GEOMETRY_ID)
      RTCHitN_geomID(hits, a->N, i) = before[i];
    else
      RTCHitN_primID(hits, a->N, i) = tile->numbers[RTCHitN_primID(hits, a->N, i)];
  }
}

void RayTiles::occlude(const RTCOccludedFunctionNArguments* a) {
  const Tile* tile = static_cast<RayTiles*>(a->geometryUserPtr)->reach(a->primID);
  // RayScene asks for single rays only.
  if (tile != nullptr && a->N == 1) rtcOccluded1(tile->built, a->context, reinterpret_cast<RTCRay*>(a->ray));
}

void RayTiles::keep_within(uint64_t triangles) {
  if (triangles_ <= triangles) return;
  std::vector<Tile*> oldest_first;
  for (Tile& tile : tiles_)
    if (tile.built != nullptr) oldest_first.push_back(&tile);
  std::sort(oldest_first.begin(), oldest_first.end(),
            [](const Tile* a, const Tile* b) { return a->last_use < b->last_use; });
  for (Tile* tile : oldest_first) {
    if (triangles_ <= triangles) return;
    rtcReleaseScene(tile->built);
    tile->built = nullptr, tile->numbers = {};
    triangles_ -= tile->triangles;
  }
}

}  // namespace veduta
