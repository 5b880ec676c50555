#include "bench/shrink_volumes.h"

#include <algorithm>
#include <chrono>

#include "worker/reference/exact_erosion.h"
#include "worker/reference/occluder_volume.h"

namespace veduta::bench {
namespace {

constexpr size_t most_exact_facets = 60;

glm::dvec3 nearest_window(const Job& job, size_t window) {
  const glm::dvec3& e = job.request.half_extents_m[window];
  return e + job.request.rings(e).front().h_m;
}

}  // namespace

Volumes::Volumes(size_t windows, size_t methods)
    : eroded(windows), kept(windows, std::vector<Kept>(methods)) {}

void Volumes::add(const Job& job, const SealedBlock& block, const Made& made, uint64_t points) {
  const reference::SealedReference reference(block);
  for (size_t w = 0; w < eroded.size(); ++w) {
    std::vector<const OccluderMesh*> sets;
    for (const auto& windows : made) sets.push_back(&windows[w].rings.front().occluders);
    const reference::OccluderVolume v =
        occluder_volume(block, reference, nearest_window(job, w), sets, points);
    eroded[w].add(v.eroded_m3(), v.eroded_error_m3());
    for (size_t m = 0; m < sets.size(); ++m) {
      kept[w][m].volume.add(v.eroded_m3() * v.kept_share(m), v.eroded_m3() * v.kept_error(m));
      kept[w][m].outside += v.kept[m].outside;
    }
  }
}

void ExactVolumes::add(const Job& job, const SealedBlock& building, const Made& made) {
  ++tried_;
  std::vector<reference::ExactErosion::Triangle> solid;
  for (const PlacedTriangle& t : building.triangles) solid.push_back(t.corner);
  const auto begin = std::chrono::steady_clock::now();
  std::vector<double> volumes;
  try {
    for (size_t w = 0; w < exact_.size(); ++w)
      volumes.push_back(
          reference::ExactErosion({solid}, nearest_window(job, w), most_exact_facets).volume_m3());
  } catch (const std::exception& error) {
    ++refused_[error.what()];
    return;
  }
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
  slowest_s_ = std::max(slowest_s_, elapsed.count());
  most_facets_ = std::max(most_facets_, solid.size());
  ++done_;
  for (size_t w = 0; w < exact_.size(); ++w) exact_[w] += volumes[w];
  sampled_.add(job, building, made, job.points);
}

Json ExactVolumes::json(const Job& job) const {
  Json out = {{"tried", tried_}, {"done", done_}, {"most_facets", most_facets_}, {"slowest_s", slowest_s_}};
  for (const auto& [why, count] : refused_) out["refused"][why] = count;
  for (size_t w = 0; w < exact_.size(); ++w) {
    Json window = {{"exact_m3", exact_[w]},
                   {"sampled_m3", sampled_.eroded[w].m3},
                   {"sampled_error_m3", sampled_.eroded[w].error()}};
    for (size_t m = 0; m < job.methods.size(); ++m)
      window["kept_of_exact"][job.methods[m]] = exact_[w] > 0 ? sampled_.kept[w][m].volume.m3 / exact_[w] : 1;
    out["windows"].push_back(window);
  }
  return out;
}

}  // namespace veduta::bench
