#include "worker/occluder_selection.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "worker/cube_face.h"

namespace veduta {
namespace {

constexpr size_t cluster_size = 32;  // bodies: small enough to cull well, large enough to be worth a test

/// The bits of v, each followed by a 0.
uint64_t spread_bits(uint32_t v) {
  uint64_t x = v;
  x = (x | x << 16) & 0x0000ffff0000ffffULL;
  x = (x | x << 8) & 0x00ff00ff00ff00ffULL;
  x = (x | x << 4) & 0x0f0f0f0f0f0f0f0fULL;
  x = (x | x << 2) & 0x3333333333333333ULL;
  return (x | x << 1) & 0x5555555555555555ULL;
}

/// Bodies along a Morton curve of the centres of their bounds, so that neighbours share a cluster.
std::vector<uint32_t> sorted_by_place(const std::vector<Box>& bounds) {
  Box all;
  for (const Box& b : bounds) all.extend(b);
  const glm::vec3 scale = 65535.0f / glm::max(all.upper - all.lower, glm::vec3(1e-3f));
  std::vector<std::pair<uint64_t, uint32_t>> keys;
  for (uint32_t b = 0; b < bounds.size(); ++b) {
    const glm::vec3 p = (bounds[b].center() - all.lower) * scale;
    keys.emplace_back(spread_bits(static_cast<uint32_t>(p.x)) | spread_bits(static_cast<uint32_t>(p.y)) << 1,
                      b);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<uint32_t> sorted;
  for (const auto& key : keys) sorted.push_back(key.second);
  return sorted;
}

Box relative_to(const Box& box, const glm::vec3& eye) {
  return {box.lower - eye, box.upper - eye};
}

/// May a box (in face coordinates, nearest depth > 0) be seen in the view?
bool reaches(const FaceView& view, const Box& b, float nearest_m) {
  return b.lower.x <= view.right * (b.lower.x > 0 ? b.upper.z : nearest_m) &&
         b.upper.x >= view.left * (b.upper.x < 0 ? b.upper.z : nearest_m) &&
         b.lower.y <= view.top * (b.lower.y > 0 ? b.upper.z : nearest_m) &&
         b.upper.y >= view.bottom * (b.upper.y < 0 ? b.upper.z : nearest_m);
}

/// Twice the area of a polygon along its normal.
glm::dvec3 area_vector(const glm::vec3* corners, uint32_t count) {
  glm::dvec3 sum(0);
  const glm::dvec3 origin(corners[0]);
  for (uint32_t c = 1; c + 1 < count; ++c)
    sum += glm::cross(glm::dvec3(corners[c]) - origin, glm::dvec3(corners[c + 1]) - origin);
  return sum;
}

}  // namespace

OccluderSelection::OccluderSelection(const std::vector<OccluderRing>& rings) {
  float from = 0;
  for (const OccluderRing& ring : rings) {
    RingClusters clusters{from, ring.depth_limit_m, {}};
    from = ring.depth_limit_m;
    std::vector<Box> bounds;
    for (size_t b = 0; b < ring.occluders.bodies(); ++b) bounds.push_back(ring.occluders.bounds(b));
    const std::vector<uint32_t> sorted = sorted_by_place(bounds);
    for (size_t b = 0; b < sorted.size(); b += cluster_size) {
      Cluster cluster{{},
                      static_cast<uint32_t>(bodies_.size()),
                      static_cast<uint32_t>(std::min(cluster_size, sorted.size() - b))};
      for (size_t n = b; n < b + cluster.count; ++n) {
        cluster.bounds.extend(bounds[sorted[n]]);
        bodies_.push_back({bounds[sorted[n]], static_cast<uint32_t>(polygons_.size())});
        add_body(ring.occluders, sorted[n]);
      }
      clusters.clusters.push_back(cluster);
    }
    rings_.push_back(std::move(clusters));
  }
  bodies_.push_back({{}, static_cast<uint32_t>(polygons_.size())});
  polygons_.push_back({{}, static_cast<uint32_t>(corners_.size())});
}

/// Faces without an area face nobody.
void OccluderSelection::add_body(const OccluderMesh& mesh, size_t body) {
  for (uint32_t f = mesh.body_begin[body]; f < mesh.body_begin[body + 1]; ++f) {
    const glm::vec3* corners = &mesh.corners[mesh.face_begin[f]];
    const uint32_t count = mesh.face_begin[f + 1] - mesh.face_begin[f];
    const glm::dvec3 area = area_vector(corners, count);
    const double length = glm::length(area);
    if (!(length > 1e-12)) continue;
    polygons_.push_back({glm::vec3(area / length), static_cast<uint32_t>(corners_.size())});
    corners_.insert(corners_.end(), corners, corners + count);
  }
}

const std::vector<OccluderVertex>& OccluderSelection::select(int face, const glm::vec3& eye,
                                                             const FaceView& view) {
  vertices_.clear();
  Horizon horizon;
  for (const RingClusters& ring : rings_) select_ring(ring, face, eye, view, horizon);
  return vertices_;
}

void OccluderSelection::select_ring(const RingClusters& ring, int face, const glm::vec3& eye,
                                    const FaceView& view, Horizon& horizon) {
  const bool side = face < 4;  // the top face has no horizon; few bodies reach it
  float nearest_m = 0;
  const auto needed = [&](const Box& world) {
    const Box box = to_face(face, relative_to(world, eye));
    nearest_m = std::max(nearest_depth(box), 1e-3f);  // not 0: depths are divided by
    return box.upper.z >= nearest_m && nearest_m <= ring.depth_limit_m && box.upper.z >= ring.depth_from_m &&
           reaches(view, box, nearest_m) &&
           (!side || std::min(Horizon::highest(box, nearest_m), view.top) >
                         horizon.hidden_below(box, nearest_m, view.left, view.right));
  };
  clusters_by_depth_.clear();
  for (uint32_t c = 0; c < ring.clusters.size(); ++c) {
    if (needed(ring.clusters[c].bounds)) clusters_by_depth_.push_back({nearest_m, c});
  }
  std::sort(clusters_by_depth_.begin(), clusters_by_depth_.end());
  for (const Near& near : clusters_by_depth_) {
    const Cluster& cluster = ring.clusters[near.index];
    if (!needed(cluster.bounds)) continue;  // the horizon has risen since
    bodies_by_depth_.clear();
    for (uint32_t b = cluster.first; b < cluster.first + cluster.count; ++b) {
      if (needed(bodies_[b].bounds)) bodies_by_depth_.push_back({nearest_m, b});
    }
    std::sort(bodies_by_depth_.begin(), bodies_by_depth_.end());
    for (const Near& candidate : bodies_by_depth_) {
      const Body& body = bodies_[candidate.index];
      if (needed(body.bounds))
        draw_body(body, face, eye, ring.depth_limit_m, view, side ? &horizon : nullptr);
    }
  }
}

/// A polygon that is seen edge on may fall on either side of rounding: drawn, it is a part of the occluder
/// like any other; left out, it covers less than a pixel.
void OccluderSelection::draw_body(const Body& body, int face, const glm::vec3& eye, float depth_limit_m,
                                  const FaceView& view, Horizon* horizon) {
  const glm::mat3 rotation = face_from_world(face);
  const uint32_t end = (&body)[1].first;
  for (uint32_t p = body.first; p < end; ++p) {
    const glm::vec3* corners = &corners_[polygons_[p].first];
    const glm::vec3 first = corners[0] - eye;
    if (glm::dot(polygons_[p].normal, first) >= 0) continue;  // turned away
    const uint32_t count = polygons_[p + 1].first - polygons_[p].first;
    turned_.clear();
    FaceView around{1e30f, -1e30f, 1e30f, -1e30f};
    float nearest_m = 1e30f;
    for (uint32_t c = 0; c < count; ++c) {
      const glm::vec3 corner = rotation * (corners[c] - eye);
      turned_.push_back(corner);
      nearest_m = std::min(nearest_m, corner.z);
      const float x = corner.x / corner.z, y = corner.y / corner.z;
      around = {std::min(around.left, x), std::max(around.right, x), std::min(around.bottom, y),
                std::max(around.top, y)};
    }
    if (nearest_m > depth_limit_m) continue;
    if (nearest_m > 0) {
      if (around.right < view.left || around.left > view.right || around.top < view.bottom ||
          around.bottom > view.top)
        continue;
      if (horizon != nullptr &&
          std::min(around.top, view.top) <=
              horizon->hidden_between(std::max(around.left, view.left), std::min(around.right, view.right)))
        continue;
    }
    for (uint32_t c = 1; c + 1 < count; c += 2) {
      vertices_.emplace_back(first, depth_limit_m);
      for (uint32_t n = c; n < c + 3; ++n)
        vertices_.emplace_back(corners[std::min(n, count - 1)] - eye, depth_limit_m);
    }
    if (horizon != nullptr) {
      for (uint32_t c = 0; c < count; ++c)
        horizon->add_edge(turned_[c == 0 ? count - 1 : c - 1], turned_[c], depth_limit_m);
    }
  }
  if (horizon != nullptr) horizon->end_body();
}

}  // namespace veduta
