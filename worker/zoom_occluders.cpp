#include "worker/zoom_occluders.h"

#include <algorithm>

#include "worker/occludee_quadtree.h"

namespace veduta {
namespace {

constexpr uint32_t cluster_bodies = 32;

}  // namespace

ZoomOccluders::ZoomOccluders(const OccluderMesh& mesh) {
  std::vector<Box> bounds;
  for (size_t b = 0; b < mesh.bodies(); ++b) bounds.push_back(mesh.bounds(b));
  std::vector<uint32_t> indices;
  // Leaves of a quadtree are clusters of neighbours.
  const OccludeeQuadtree tree = make_occludee_quadtree(bounds, cluster_bodies);
  for (const QuadtreeBlock& block : tree.blocks) {
    if (block.children > 0) continue;
    clusters_.push_back({block.bounds, static_cast<uint32_t>(bodies_.size()), block.count});
    for (uint32_t n = block.first; n < block.first + block.count; ++n) {
      const uint32_t body = tree.objects[n];
      bodies_.push_back({bounds[body], static_cast<uint32_t>(indices.size())});
      for (uint32_t f = mesh.body_begin[body]; f < mesh.body_begin[body + 1]; ++f) {
        const uint32_t first = mesh.face_begin[f];
        for (uint32_t c = first + 1; c + 1 < mesh.face_begin[f + 1]; ++c)
          indices.insert(indices.end(), {first, c, c + 1});
      }
    }
  }
  bodies_.push_back({{}, static_cast<uint32_t>(indices.size())});

  glBindVertexArray(vertices_.id());
  glBindBuffer(GL_ARRAY_BUFFER, corners_.id());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.corners.size() * sizeof(glm::vec3)),
               mesh.corners.data(), GL_STATIC_DRAW);
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(glm::vec3), nullptr);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.id());
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(uint32_t)),
               indices.data(), GL_STATIC_DRAW);
}

void ZoomOccluders::add_range(uint32_t first_index, uint32_t end_index) {
  if (counts_.empty() || end_of_last_ != first_index) {
    begins_.push_back(reinterpret_cast<const void*>(uintptr_t{first_index} * sizeof(uint32_t)));
    counts_.push_back(0);
  }
  counts_.back() += static_cast<GLsizei>(end_index - first_index);
  end_of_last_ = end_index;
}

uint64_t ZoomOccluders::draw(const ZoomFrustum& frustum) {
  counts_.clear(), begins_.clear();
  for (const Cluster& cluster : clusters_) {
    if (!frustum.reached_by(cluster.bounds)) continue;
    for (uint32_t b = cluster.first; b < cluster.first + cluster.count; ++b) {
      if (frustum.reached_by(bodies_[b].bounds))
        add_range(bodies_[b].first_index, bodies_[b + 1].first_index);
    }
  }
  if (counts_.empty()) return 0;
  glBindVertexArray(vertices_.id());
  glMultiDrawElements(GL_TRIANGLES, counts_.data(), GL_UNSIGNED_INT, begins_.data(),
                      static_cast<GLsizei>(counts_.size()));
  uint64_t indices = 0;
  for (const GLsizei count : counts_) indices += static_cast<uint64_t>(count);
  return indices / 3;
}

}  // namespace veduta
