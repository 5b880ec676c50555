#include "worker/occluder_selection.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "worker/cube_face.h"

namespace veduta {
namespace {

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

}  // namespace

OccluderSelection::OccluderSelection(ClusteredOccluders occluders, size_t window)
    : occluders_(std::move(occluders)) {
  float from = 0;
  for (const ClusteredRing& ring : occluders_.windows()[window].rings) {
    rings_.push_back({from, ring.depth_limit_m, ring.first_cluster, ring.bounds});
    from = ring.depth_limit_m;
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
  for (uint32_t c = 0; c < ring.bounds.size(); ++c) {
    if (needed(ring.bounds[c])) clusters_by_depth_.push_back({nearest_m, c});
  }
  std::sort(clusters_by_depth_.begin(), clusters_by_depth_.end());
  for (const Near& near : clusters_by_depth_) {
    if (!needed(ring.bounds[near.index])) continue;  // the horizon has risen since
    const OccluderCluster cluster = occluders_.cluster(ring.first + near.index);
    bodies_by_depth_.clear();
    for (uint32_t b = 0; b < cluster.count(); ++b) {
      if (needed(cluster.bodies[b].bounds)) bodies_by_depth_.push_back({nearest_m, b});
    }
    std::sort(bodies_by_depth_.begin(), bodies_by_depth_.end());
    for (const Near& candidate : bodies_by_depth_) {
      if (needed(cluster.bodies[candidate.index].bounds))
        draw_body(cluster, candidate.index, face, eye, ring.depth_limit_m, view, side ? &horizon : nullptr);
    }
  }
}

/// A polygon that is seen edge on may fall on either side of rounding: drawn, it is a part of the occluder
/// like any other; left out, it covers less than a pixel.
void OccluderSelection::draw_body(const OccluderCluster& cluster, uint32_t body, int face,
                                  const glm::vec3& eye, float depth_limit_m, const FaceView& view,
                                  Horizon* horizon) {
  const glm::mat3 rotation = face_from_world(face);
  const std::span<const OccluderPolygon> polygons = cluster.polygons;
  const uint32_t end = cluster.bodies[body + 1].first_polygon;
  for (uint32_t p = cluster.bodies[body].first_polygon; p < end; ++p) {
    const glm::vec3* corners = cluster.corners + polygons[p].first_corner;
    const glm::vec3 first = corners[0] - eye;
    if (glm::dot(polygons[p].normal, first) >= 0) continue;  // turned away
    const uint32_t count = polygons[p + 1].first_corner - polygons[p].first_corner;
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
