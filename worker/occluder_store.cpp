#include "worker/occluder_store.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "worker/cube_face.h"

namespace veduta {
namespace {

constexpr size_t cluster_size = 32;  // boxes: small enough to cull well, large enough to draw in few calls

uint64_t spread_bits(uint32_t v) {
  uint64_t x = v;
  for (const auto& [shift, mask] : {std::pair{16, 0x0000ffff0000ffffULL}, std::pair{8, 0x00ff00ff00ff00ffULL}, std::pair{4, 0x0f0f0f0f0f0f0f0fULL},
                                    std::pair{2, 0x3333333333333333ULL}, std::pair{1, 0x5555555555555555ULL}}) {
    x = (x | x << shift) & mask;
  }
  return x;
}

/// Boxes along a Morton curve of their centres, so that neighbours share a cluster.
std::vector<Box> sorted_by_place(const std::vector<Box>& boxes) {
  Box all;
  for (const Box& b : boxes) all.extend(b);
  const glm::vec3 scale = 65535.0f / glm::max(all.upper - all.lower, glm::vec3(1e-3f));
  std::vector<std::pair<uint64_t, uint32_t>> keys;
  for (uint32_t b = 0; b < boxes.size(); ++b) {
    const glm::vec3 p = (boxes[b].center() - all.lower) * scale;
    keys.emplace_back(spread_bits(static_cast<uint32_t>(p.x)) | spread_bits(static_cast<uint32_t>(p.y)) << 1, b);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<Box> sorted;
  for (const auto& key : keys) sorted.push_back(boxes[key.second]);
  return sorted;
}

/// Triangles of a box whose corner n has bit 0, 1, 2 for upper x, y, z; counter-clockwise from outside.
constexpr std::array<uint8_t, 36> box_triangles{0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                                                2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};

}  // namespace

/// The skyline of the boxes chosen so far on a side face, by columns: the highest up / forward that they hide below. Boxes
/// reach down below the eye, so what does not rise above the skyline of nearer ones is hidden by them.
class OccluderStore::Horizon {
 public:
  Horizon() { slope_.fill(-1e30f); }

  /// Does a box (in face coordinates, nearest depth `nearest_m`) rise above it anywhere?
  bool rises_above(const Box& b, float nearest_m) const {
    const float highest = b.upper.y / (b.upper.y > 0 ? nearest_m : b.upper.z);
    const auto [first, last] = columns(b, nearest_m);
    for (int c = first; c <= last; ++c) {
      if (highest > slope_[c]) return true;
    }
    return false;
  }

  void add(const Box& b, float nearest_m) {
    if (b.lower.y > 0) return;  // floats above the eye: hides no ground
    const auto [first, last] = columns(b, nearest_m);
    for (int c = first; c <= last; ++c) {
      // The rays along both edges of the column, cut with the box as seen from above.
      const auto [enter0, leave0] = crossing(b, edge(c));
      const auto [enter1, leave1] = crossing(b, edge(c + 1));
      const float enter = std::max(enter0, enter1), leave = std::min(leave0, leave1);
      if (enter < leave) slope_[c] = std::max(slope_[c], b.upper.y / (b.upper.y > 0 ? enter : leave));
    }
  }

 private:
  static constexpr int count = 512;

  static std::pair<int, int> columns(const Box& b, float nearest_m) {
    const float left = b.lower.x / (b.lower.x < 0 ? nearest_m : b.upper.z);
    const float right = b.upper.x / (b.upper.x > 0 ? nearest_m : b.upper.z);
    const auto column = [](float ratio) {
      return static_cast<int>((std::clamp(ratio, -1.0f, 0.99999f) + 1.0f) * (0.5f * count));
    };
    return {column(left), column(right)};
  }

  static float edge(int column) { return static_cast<float>(column) / (0.5f * count) - 1.0f; }

  /// Depths at which the ray right = ratio * forward enters and leaves the box.
  static std::pair<float, float> crossing(const Box& b, float ratio) {
    float enter = std::max(b.lower.z, 1e-3f), leave = b.upper.z;
    if (ratio == 0) return b.lower.x <= 0 && b.upper.x >= 0 ? std::pair{enter, leave} : std::pair{1.0f, 0.0f};
    const float t0 = b.lower.x / ratio, t1 = b.upper.x / ratio;
    return {std::max(enter, std::min(t0, t1)), std::min(leave, std::max(t0, t1))};
  }

  std::array<float, count> slope_;
};

OccluderStore::OccluderStore(const std::vector<Ring>& rings) {
  float from = 0;
  size_t most = 1;
  for (const Ring& ring : rings) {
    RingClusters clusters{from, ring.depth_limit_m, {}};
    from = ring.depth_limit_m;
    const std::vector<Box> sorted = sorted_by_place(ring.boxes);
    for (size_t b = 0; b < sorted.size(); b += cluster_size) {
      Cluster cluster{{}, static_cast<uint32_t>(boxes_.size()), static_cast<uint32_t>(std::min(cluster_size, sorted.size() - b))};
      for (size_t n = b; n < b + cluster.count; ++n) cluster.bounds.extend(sorted[n]), boxes_.push_back(sorted[n]);
      clusters.clusters.push_back(cluster);
    }
    rings_.push_back(std::move(clusters));
    most += ring.boxes.size();
  }
  selected_.reserve(most);
  draws_.resize(rings_.size());
  static_assert(sizeof(Box) == 6 * sizeof(float));
  glBindVertexArray(vertex_array_.id());
  glBindBuffer(GL_ARRAY_BUFFER, instances_.id());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(most * sizeof(Box)), nullptr, GL_STREAM_DRAW);
  for (GLuint attribute = 0; attribute < 2; ++attribute) {
    glEnableVertexAttribArray(attribute);
    glVertexAttribPointer(attribute, 3, GL_FLOAT, GL_FALSE, sizeof(Box), reinterpret_cast<const void*>(attribute * sizeof(glm::vec3)));
    glVertexAttribDivisor(attribute, 1);
  }
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.id());
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, sizeof(box_triangles), box_triangles.data(), GL_STATIC_DRAW);
}

const std::vector<RingDraw>& OccluderStore::select(int face, const glm::vec3& eye) {
  const bool side = face < 4;  // the top face has no horizon; few boxes reach it
  Horizon horizon;
  selected_.clear();
  const auto by_depth = [](const Near& a, const Near& b) { return a.depth_m < b.depth_m || (a.depth_m == b.depth_m && a.index < b.index); };
  for (size_t r = 0; r < rings_.size(); ++r) {
    const RingClusters& ring = rings_[r];
    const auto first = static_cast<uint32_t>(selected_.size());
    // In face coordinates, or nothing when the ring does not need it.
    const auto needed = [&](const Box& world, Box& box, float& nearest_m) {
      box = to_face(face, {world.lower - eye, world.upper - eye});
      const FaceTouch touch = touch_face(box);
      nearest_m = std::max(touch.nearest_m, 1e-3f);
      return touch.touches && nearest_m <= ring.depth_limit_m && box.upper.z >= ring.depth_from_m &&
             (!side || horizon.rises_above(box, nearest_m));
    };
    Box box;
    float nearest_m = 0;
    clusters_by_depth_.clear();
    for (uint32_t c = 0; c < ring.clusters.size(); ++c) {
      if (needed(ring.clusters[c].bounds, box, nearest_m)) clusters_by_depth_.push_back({nearest_m, c});
    }
    std::sort(clusters_by_depth_.begin(), clusters_by_depth_.end(), by_depth);
    for (const Near& near : clusters_by_depth_) {
      const Cluster& cluster = ring.clusters[near.index];
      if (!needed(cluster.bounds, box, nearest_m)) continue;  // the horizon has risen since
      boxes_by_depth_.clear();
      for (uint32_t b = cluster.first; b < cluster.first + cluster.count; ++b) {
        if (needed(boxes_[b], box, nearest_m)) boxes_by_depth_.push_back({nearest_m, b});
      }
      std::sort(boxes_by_depth_.begin(), boxes_by_depth_.end(), by_depth);
      for (const Near& candidate : boxes_by_depth_) {
        if (!needed(boxes_[candidate.index], box, nearest_m)) continue;
        if (side) horizon.add(box, nearest_m);
        selected_.push_back(boxes_[candidate.index]);
      }
    }
    draws_[r] = {ring.depth_limit_m, first, static_cast<uint32_t>(selected_.size()) - first};
  }
  glBindBuffer(GL_ARRAY_BUFFER, instances_.id());
  glBufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(selected_.size() * sizeof(Box)), selected_.data());
  return draws_;
}

void OccluderStore::draw(const RingDraw& ring) const {
  if (ring.count == 0) return;
  glBindVertexArray(vertex_array_.id());
  glDrawElementsInstancedBaseInstance(GL_TRIANGLES, box_triangles.size(), GL_UNSIGNED_BYTE, nullptr, static_cast<GLsizei>(ring.count),
                                      ring.first);
}

}  // namespace veduta
