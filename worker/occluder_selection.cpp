#include "worker/occluder_selection.h"

#include <algorithm>

#include "worker/cube_face.h"

namespace veduta {
namespace {

constexpr size_t cluster_size = 32;  // boxes: small enough to cull well, large enough to be worth a test

/// The bits of v, each followed by a 0.
uint64_t spread_bits(uint32_t v) {
  uint64_t x = v;
  x = (x | x << 16) & 0x0000ffff0000ffffULL;
  x = (x | x << 8) & 0x00ff00ff00ff00ffULL;
  x = (x | x << 4) & 0x0f0f0f0f0f0f0f0fULL;
  x = (x | x << 2) & 0x3333333333333333ULL;
  return (x | x << 1) & 0x5555555555555555ULL;
}

/// Boxes along a Morton curve of their centres, so that neighbours share a cluster.
std::vector<Box> sorted_by_place(const std::vector<Box>& boxes) {
  Box all;
  for (const Box& b : boxes) all.extend(b);
  const glm::vec3 scale = 65535.0f / glm::max(all.upper - all.lower, glm::vec3(1e-3f));
  std::vector<std::pair<uint64_t, uint32_t>> keys;
  for (uint32_t b = 0; b < boxes.size(); ++b) {
    const glm::vec3 p = (boxes[b].center() - all.lower) * scale;
    keys.emplace_back(spread_bits(static_cast<uint32_t>(p.x)) | spread_bits(static_cast<uint32_t>(p.y)) << 1,
                      b);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<Box> sorted;
  for (const auto& key : keys) sorted.push_back(boxes[key.second]);
  return sorted;
}

Box relative_to(const Box& box, const glm::vec3& eye) {
  return {box.lower - eye, box.upper - eye};
}

}  // namespace

OccluderSelection::OccluderSelection(const std::vector<Ring>& rings) {
  float from = 0;
  for (const Ring& ring : rings) {
    RingClusters clusters{from, ring.depth_limit_m, {}};
    from = ring.depth_limit_m;
    const std::vector<Box> sorted = sorted_by_place(ring.boxes);
    for (size_t b = 0; b < sorted.size(); b += cluster_size) {
      Cluster cluster{{},
                      static_cast<uint32_t>(boxes_.size()),
                      static_cast<uint32_t>(std::min(cluster_size, sorted.size() - b))};
      for (size_t n = b; n < b + cluster.count; ++n)
        cluster.bounds.extend(sorted[n]), boxes_.push_back(sorted[n]);
      clusters.clusters.push_back(cluster);
    }
    rings_.push_back(std::move(clusters));
  }
  vertices_.reserve(capacity());
  clusters_by_depth_.reserve(boxes_.size()), boxes_by_depth_.reserve(boxes_.size());
}

const std::vector<OccluderVertex>& OccluderSelection::select(int face, const glm::vec3& eye) {
  vertices_.clear();
  Horizon horizon;
  for (const RingClusters& ring : rings_) select_ring(ring, face, eye, horizon);
  return vertices_;
}

void OccluderSelection::select_ring(const RingClusters& ring, int face, const glm::vec3& eye,
                                    Horizon& horizon) {
  const bool side = face < 4;  // the top face has no horizon; few boxes reach it
  Box box;                     // in face coordinates
  float nearest_m = 0;
  const auto needed = [&](const Box& world) {
    box = to_face(face, relative_to(world, eye));
    nearest_m = std::max(nearest_depth(box), 1e-3f);  // not 0: depths are divided by
    return box.upper.z >= nearest_m && nearest_m <= ring.depth_limit_m && box.upper.z >= ring.depth_from_m &&
           (!side || Horizon::highest(box, nearest_m) > horizon.hidden_below(box, nearest_m));
  };
  clusters_by_depth_.clear();
  for (uint32_t c = 0; c < ring.clusters.size(); ++c) {
    if (needed(ring.clusters[c].bounds)) clusters_by_depth_.push_back({nearest_m, c});
  }
  std::sort(clusters_by_depth_.begin(), clusters_by_depth_.end());
  for (const Near& near : clusters_by_depth_) {
    const Cluster& cluster = ring.clusters[near.index];
    if (!needed(cluster.bounds)) continue;  // the horizon has risen since
    boxes_by_depth_.clear();
    for (uint32_t b = cluster.first; b < cluster.first + cluster.count; ++b) {
      if (needed(boxes_[b])) boxes_by_depth_.push_back({nearest_m, b});
    }
    std::sort(boxes_by_depth_.begin(), boxes_by_depth_.end());
    for (const Near& candidate : boxes_by_depth_) {
      const Box& world = boxes_[candidate.index];
      if (!needed(world)) continue;
      if (side) horizon.add(box, nearest_m);
      add_sides(relative_to(world, eye), ring.depth_limit_m);
    }
  }
}

void OccluderSelection::add_sides(const Box& relative, float depth_limit_m) {
  for (int axis = 0; axis < 3; ++axis) {
    const bool below = relative.lower[axis] > 0;
    if (!below && relative.upper[axis] >= 0) continue;  // the eye is between the two sides: neither faces it
    const float plane = below ? relative.lower[axis] : relative.upper[axis];
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    for (const auto& [upper_a, upper_b] :
         {std::pair{false, false}, {true, false}, {true, true}, {false, true}}) {
      OccluderVertex corner(0, 0, 0, depth_limit_m);
      corner[axis] = plane;
      corner[a] = upper_a ? relative.upper[a] : relative.lower[a];
      corner[b] = upper_b ? relative.upper[b] : relative.lower[b];
      vertices_.push_back(corner);
    }
  }
}

}  // namespace veduta
