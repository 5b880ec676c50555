#include "bench/bare_rays.h"

#include <embree3/rtcore.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <limits>
#include <stdexcept>

#include "bench/processor_time.h"
#include "verify/directions.h"

namespace veduta::bench {
namespace {

/// The triangles of a scene, as fast as Embree has them.
class BareScene {
 public:
  explicit BareScene(const Scene& city) : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    copy(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, city.vertices);
    copy(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, city.triangles);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(scene_);
    if (rtcGetDeviceError(device_) != RTC_ERROR_NONE) throw std::runtime_error("Embree failed");
  }
  ~BareScene() { rtcReleaseScene(scene_), rtcReleaseDevice(device_); }
  BareScene(const BareScene&) = delete;
  BareScene& operator=(const BareScene&) = delete;

  void one_by_one(const std::vector<Ray>& rays, RTCIntersectContextFlags flags) const {
    RTCIntersectContext context = context_of(flags);
    for (const Ray& ray : rays) {
      RTCRayHit query{};
      query.ray.org_x = ray.eye.x, query.ray.org_y = ray.eye.y, query.ray.org_z = ray.eye.z;
      query.ray.dir_x = ray.direction.x, query.ray.dir_y = ray.direction.y, query.ray.dir_z = ray.direction.z;
      query.ray.tfar = std::numeric_limits<float>::infinity(), query.ray.mask = ~0u;
      query.hit.geomID = query.hit.primID = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(scene_, &context, &query);
    }
  }

  // Whole packets only: of a million rays, at most 15 are left out.
  template <typename Packet, size_t width, typename Trace>
  void in_packets(const std::vector<Ray>& rays, RTCIntersectContextFlags flags, const Trace& trace) const {
    RTCIntersectContext context = context_of(flags);
    alignas(64) Packet packet;
    alignas(64) int valid[width];
    std::fill(valid, valid + width, -1);
    for (size_t begin = 0; begin + width <= rays.size(); begin += width) {
      for (size_t i = 0; i < width; ++i) {
        const Ray& ray = rays[begin + i];
        packet.ray.org_x[i] = ray.eye.x, packet.ray.org_y[i] = ray.eye.y, packet.ray.org_z[i] = ray.eye.z;
        packet.ray.dir_x[i] = ray.direction.x, packet.ray.dir_y[i] = ray.direction.y,
        packet.ray.dir_z[i] = ray.direction.z;
        packet.ray.tnear[i] = packet.ray.time[i] = 0;
        packet.ray.tfar[i] = std::numeric_limits<float>::infinity(), packet.ray.mask[i] = ~0u;
        packet.ray.id[i] = packet.ray.flags[i] = 0;
        packet.hit.geomID[i] = packet.hit.primID[i] = RTC_INVALID_GEOMETRY_ID;
      }
      trace(valid, scene_, &context, &packet);
    }
  }

 private:
  template <typename Element>
  static void copy(RTCGeometry geometry, RTCBufferType type, RTCFormat format,
                   const std::vector<Element>& from) {
    void* to = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(Element), from.size());
    std::memcpy(to, from.data(), from.size() * sizeof(Element));
  }
  static RTCIntersectContext context_of(RTCIntersectContextFlags flags) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = flags;
    return context;
  }

  RTCDevice device_;
  RTCScene scene_;
};

std::vector<Ray> sorted(const std::vector<Ray>& rays) {
  std::vector<std::pair<uint32_t, uint32_t>> keys;
  for (const Ray& ray : rays) keys.emplace_back(curve_key(ray.direction), keys.size());
  std::sort(keys.begin(), keys.end());
  std::vector<Ray> result;
  for (const auto& [key, ray] : keys) result.push_back(rays[ray]);
  return result;
}

}  // namespace

nlohmann::ordered_json bare_rates(const Scene& scene, const std::vector<std::vector<Ray>>& lists, int threads,
                                  int repeats) {
  const BareScene bare(scene);
  tbb::task_arena arena(threads);
  nlohmann::ordered_json rates;
  using List = std::vector<Ray>;
  const auto time = [&](const std::string& name, const std::vector<List>& of,
                        const std::function<void(const List&)>& trace) {
    double least_s = std::numeric_limits<double>::infinity(), rays = 0;
    for (const List& list : of) rays += static_cast<double>(list.size());
    for (int i = 0; i < repeats; ++i) {
      const double begin_s = processor_s();
      arena.execute([&] { tbb::parallel_for(size_t{0}, of.size(), [&](size_t l) { trace(of[l]); }); });
      least_s = std::min(least_s, processor_s() - begin_s);
    }
    rates[name] = rays / least_s;
  };
  constexpr auto coherent = RTC_INTERSECT_CONTEXT_FLAG_COHERENT,
                 incoherent = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  const auto by_16 = [&](RTCIntersectContextFlags flags) {
    return
        [&bare, flags](const List& list) { bare.in_packets<RTCRayHit16, 16>(list, flags, rtcIntersect16); };
  };
  time("one by one", lists, [&](const List& list) { bare.one_by_one(list, incoherent); });
  time("packets of 8, coherent", lists,
       [&](const List& list) { bare.in_packets<RTCRayHit8, 8>(list, coherent, rtcIntersect8); });
  time("packets of 8", lists,
       [&](const List& list) { bare.in_packets<RTCRayHit8, 8>(list, incoherent, rtcIntersect8); });
  time("packets of 16, coherent", lists, by_16(coherent));
  time("packets of 16", lists, by_16(incoherent));
  std::vector<List> in_order;
  for (const List& list : lists) in_order.push_back(sorted(list));
  time("packets of 16, coherent, sorted", in_order, by_16(coherent));
  return rates;
}

}  // namespace veduta::bench
