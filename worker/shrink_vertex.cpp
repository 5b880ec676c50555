// Follows §4.2.1.3 (eq. 4.3) and §4.2.1.4. Departs from them where these are silent or unsafe: buildings that
// share vertices are one mesh; a vertex whose faces leave no way inwards gives no face; a face that turns
// over is removed; and every face is checked against sealed space.
#include "worker/shrink_vertex.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>

#include "worker/swept_prism.h"
#include "worker/welded_mesh.h"
#include "worker/window_sweep.h"

namespace veduta {
namespace {

using Triangle = std::array<glm::dvec3, 3>;

/// sin(alpha / 2) below which a vertex is a spike: it would move a thousand windows.
constexpr double least_sine = 1e-3;

Triangle corners_of(const std::vector<glm::dvec3>& vertices, const glm::uvec3& face) {
  return {vertices[face.x], vertices[face.y], vertices[face.z]};
}

glm::dvec3 normal_of(const Triangle& t) {
  return glm::cross(t[1] - t[0], t[2] - t[0]);
}

/// How a vertex moves, for an epsilon of 1 m; nothing for a spike.
using Motion = std::optional<glm::dvec3>;

std::vector<Motion> motions(const WeldedMesh& mesh) {
  std::vector<glm::dvec3> sum(mesh.vertices.size(), glm::dvec3(0));
  std::vector<double> sine(mesh.vertices.size(), 1);
  const auto each_corner = [&](auto visit) {
    for (const glm::uvec3& face : mesh.faces) {
      const glm::dvec3 normal = glm::normalize(normal_of(corners_of(mesh.vertices, face)));
      for (int n = 0; n < 3; ++n) visit(face[n], normal);
    }
  };
  each_corner([&](uint32_t v, const glm::dvec3& normal) { sum[v] += normal; });
  for (glm::dvec3& s : sum) {
    const double length = glm::length(s);
    s = length > least_sine ? s / length : glm::dvec3(0);
  }
  // sin(alpha / 2) = sin(90 - angle) = cos(angle), the least of all faces.
  each_corner(
      [&](uint32_t v, const glm::dvec3& normal) { sine[v] = std::min(sine[v], glm::dot(sum[v], normal)); });
  std::vector<Motion> result(mesh.vertices.size());
  for (size_t v = 0; v < result.size(); ++v) {
    if (sine[v] < least_sine) continue;
    glm::dvec3 motion = -sum[v] / sine[v];
    if (mesh.on_ground[v] != 0) motion.z = 0;
    result[v] = motion;
  }
  return result;
}

bool neighbours(const glm::uvec3& a, const glm::uvec3& b) {
  for (int n = 0; n < 3; ++n) {
    if (a[n] == b.x || a[n] == b.y || a[n] == b.z) return true;
  }
  return false;
}

/// Marks faces whose prisms intersect another's. Neighbours do not intersect because of common vertices (fig.
/// 4.14 a). Sweeps along x, so that far ones are never compared.
std::vector<uint8_t> intersecting(const std::vector<glm::uvec3>& faces,
                                  const std::vector<SweptPrism>& prisms) {
  std::vector<uint32_t> order(faces.size());
  for (uint32_t n = 0; n < order.size(); ++n) order[n] = n;
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    return std::pair(prisms[a].lower.x, a) < std::pair(prisms[b].lower.x, b);
  });
  std::vector<uint8_t> marked(faces.size(), 0);
  for (size_t n = 0; n < order.size(); ++n) {
    for (size_t m = n + 1; m < order.size() && prisms[order[m]].lower.x < prisms[order[n]].upper.x; ++m) {
      const uint32_t a = order[n], b = order[m];
      if (marked[a] != 0 && marked[b] != 0) continue;
      if (!neighbours(faces[a], faces[b]) && intersect(prisms[a], prisms[b])) marked[a] = marked[b] = 1;
    }
  }
  return marked;
}

/// One building for one window.
class BuildingShrinker {
 public:
  BuildingShrinker(const SealedBlock& block, const WindowSweep& sweep, const WeldedMesh& mesh)
      : block_(block), sweep_(sweep), mesh_(mesh), motions_(motions(mesh)) {}

  void shrink(const glm::dvec3& half, double lowest_eye_m, OccluderMesh& out, VertexCounts& counts) const {
    const double epsilon = glm::length(half);
    VertexCounts here;
    std::vector<uint32_t> number;  // of the mesh's faces, of those left
    std::vector<glm::uvec3> faces;
    std::vector<SweptPrism> prisms;
    std::vector<Triangle> shrunk;
    for (uint32_t f = 0; f < mesh_.faces.size(); ++f) {
      const std::optional<Triangle> after = moved(mesh_.faces[f], epsilon);
      here.faces += owned(f), here.spikes += owned(f) && !after;
      if (!after) continue;
      number.push_back(f), faces.push_back(mesh_.faces[f]), shrunk.push_back(*after);
      prisms.emplace_back(corners_of(mesh_.vertices, mesh_.faces[f]), *after);
    }
    const std::vector<uint8_t> removed = intersecting(faces, prisms);
    std::vector<uint32_t> kept;
    for (uint32_t n = 0; n < faces.size(); ++n) {
      if (!owned(number[n])) continue;
      const glm::dvec3 before = normal_of(corners_of(mesh_.vertices, faces[n])), after = normal_of(shrunk[n]);
      if (removed[n] != 0) {
        ++here.intersecting;
      } else if (!(glm::dot(before, after) > 0)) {
        ++here.turned;
      } else if (!sweep_.sealed(shrunk[n], half)) {
        ++here.unsafe;
      } else {
        kept.push_back(n);
      }
    }
    here.kept = kept.size();
    counts.add(here);
    emit(kept, number, shrunk, lowest_eye_m, kept.size() == mesh_.faces.size(), out);
  }

 private:
  /// The face shrunk, as it will be stored.
  std::optional<Triangle> moved(const glm::uvec3& face, double epsilon) const {
    Triangle after;
    for (int n = 0; n < 3; ++n) {
      const Motion& motion = motions_[face[n]];
      if (!motion) return {};
      after[n] = glm::vec3(mesh_.vertices[face[n]] + epsilon * *motion);
    }
    return after;
  }

  /// Is the face this block's to emit? The one that its middle lies in. Nobody sees a face on the ground.
  bool owned(uint32_t f) const {
    const glm::uvec3& face = mesh_.faces[f];
    if (mesh_.on_ground[face.x] && mesh_.on_ground[face.y] && mesh_.on_ground[face.z]) return false;
    const Triangle t = corners_of(mesh_.vertices, face);
    const GridFrame& frame = block_.region.frame();
    const glm::dvec3 middle = (t[0] + t[1] + t[2]) / 3.0;
    const int i = frame.column_x(middle.x), j = frame.column_y(middle.y);
    return i >= block_.i0 && i < block_.i1 && j >= block_.j0 && j < block_.j1;
  }

  /// Where faces are missing one looks at others from behind, and where they do not agree about the outside
  /// nobody knows it: then both sides are emitted.
  void emit(const std::vector<uint32_t>& kept, const std::vector<uint32_t>& number,
            const std::vector<Triangle>& shrunk, double lowest_eye_m, bool whole, OccluderMesh& out) const {
    double top = -HUGE_VAL;
    for (const uint32_t n : kept) {
      for (const glm::dvec3& corner : shrunk[n]) top = std::max(top, corner.z);
    }
    if (!(top > lowest_eye_m)) return;
    for (const uint32_t n : kept) {
      const Triangle& t = shrunk[n];
      out.add_face({t[0], t[1], t[2]});
      if (!whole || mesh_.oriented[number[n]] == 0) out.add_face({t[0], t[2], t[1]});
    }
    out.end_body();
  }

  const SealedBlock& block_;
  const WindowSweep& sweep_;
  const WeldedMesh& mesh_;
  std::vector<Motion> motions_;
};

}  // namespace

void VertexCounts::add(const VertexCounts& other) {
  faces += other.faces, spikes += other.spikes, turned += other.turned;
  intersecting += other.intersecting, unsafe += other.unsafe, kept += other.kept;
}

std::vector<WindowOccluders> VertexShrinker::shrink(const SealedBlock& block,
                                                    const ShrinkRequest& request) const {
  VertexCounts ignored;
  return shrink(block, request, ignored);
}

std::vector<WindowOccluders> VertexShrinker::shrink(const SealedBlock& block, const ShrinkRequest& request,
                                                    VertexCounts& counts) const {
  const WindowSweep sweep(block);
  const std::vector<WeldedMesh> meshes = weld_buildings(block.triangles);
  std::vector<WindowOccluders> windows;
  for (const glm::dvec3& half_extent : request.half_extents_m) {
    WindowOccluders& window = windows.emplace_back(WindowOccluders{half_extent, {}});
    for (const RingWindow& ring : request.rings(half_extent))
      window.rings.push_back({ring.h_m, static_cast<float>(ring.depth_limit_m), {}});
  }
  for (const WeldedMesh& mesh : meshes) {
    const BuildingShrinker building(block, sweep, mesh);
    for (WindowOccluders& window : windows) {
      for (OccluderRing& ring : window.rings)
        building.shrink(window.half_extent_m + ring.h_m, request.lowest_eye_m, ring.occluders, counts);
    }
  }
  return windows;
}

}  // namespace veduta
