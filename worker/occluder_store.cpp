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

OccluderStore::OccluderStore(const std::vector<Ring>& rings) {
  std::vector<Box> all;
  float from = 0;
  for (const Ring& ring : rings) {
    RingClusters clusters{from, ring.depth_limit_m, {}};
    from = ring.depth_limit_m;
    const std::vector<Box> boxes = sorted_by_place(ring.boxes);
    for (size_t b = 0; b < boxes.size(); b += cluster_size) {
      Cluster cluster{{}, static_cast<uint32_t>(all.size()), static_cast<uint32_t>(std::min(cluster_size, boxes.size() - b))};
      for (size_t n = b; n < b + cluster.count; ++n) cluster.bounds.extend(boxes[n]), all.push_back(boxes[n]);
      clusters.clusters.push_back(cluster);
    }
    rings_.push_back(std::move(clusters));
  }
  static_assert(sizeof(Box) == 6 * sizeof(float));
  glBindVertexArray(vertex_array_.id());
  glBindBuffer(GL_ARRAY_BUFFER, boxes_.id());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(std::max<size_t>(all.size(), 1) * sizeof(Box)), nullptr, GL_STATIC_DRAW);
  glBufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(all.size() * sizeof(Box)), all.data());
  for (GLuint attribute = 0; attribute < 2; ++attribute) {
    glEnableVertexAttribArray(attribute);
    glVertexAttribPointer(attribute, 3, GL_FLOAT, GL_FALSE, sizeof(Box), reinterpret_cast<const void*>(attribute * sizeof(glm::vec3)));
    glVertexAttribDivisor(attribute, 1);
  }
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.id());
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, sizeof(box_triangles), box_triangles.data(), GL_STATIC_DRAW);
}

void OccluderStore::draw(size_t ring, int face, const glm::vec3& eye) const {
  const RingClusters& r = rings_[ring];
  glBindVertexArray(vertex_array_.id());
  uint32_t first = 0, count = 0;
  const auto flush = [&] {
    if (count > 0) {
      glDrawElementsInstancedBaseInstance(GL_TRIANGLES, box_triangles.size(), GL_UNSIGNED_BYTE, nullptr, static_cast<GLsizei>(count), first);
    }
  };
  for (const Cluster& cluster : r.clusters) {
    const Box box = to_face(face, {cluster.bounds.lower - eye, cluster.bounds.upper - eye});
    const FaceTouch touch = touch_face(box);
    if (!touch.touches || touch.nearest_m > r.depth_limit_m || box.upper.z < r.depth_from_m) continue;
    if (first + count != cluster.first) flush(), first = cluster.first, count = 0;
    count += cluster.count;
  }
  flush();
}

}  // namespace veduta
