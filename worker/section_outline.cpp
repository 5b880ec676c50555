#include "worker/section_outline.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

namespace veduta {
namespace {

struct Segment {
  glm::vec3 from, to;
};

/// Where the edge crosses the plane; the same whichever way round the edge is given.
glm::vec3 crossing(glm::vec3 a, glm::vec3 b, int axis, float at_m) {
  if (a[axis] > b[axis]) std::swap(a, b);
  return a + (b - a) * ((at_m - a[axis]) / (b[axis] - a[axis]));
}

/// What a face leaves in the plane: from where its outline comes up through it to where it goes down. The
/// face beyond that edge begins there.
std::vector<Segment> cut_faces(const OccluderMesh& mesh, size_t body, int axis, float at_m) {
  std::vector<Segment> segments;
  for (uint32_t f = mesh.body_begin[body]; f < mesh.body_begin[body + 1]; ++f) {
    const uint32_t begin = mesh.face_begin[f], end = mesh.face_begin[f + 1];
    bool up = false, down = false;
    Segment segment{};
    for (uint32_t c = begin; c < end; ++c) {
      const glm::vec3 &a = mesh.corners[c], &b = mesh.corners[c + 1 < end ? c + 1 : begin];
      if (a[axis] < at_m && b[axis] >= at_m) segment.from = crossing(a, b, axis, at_m), up = true;
      if (a[axis] >= at_m && b[axis] < at_m) segment.to = crossing(a, b, axis, at_m), down = true;
    }
    if (up && down) segments.push_back(segment);
  }
  return segments;
}

}  // namespace

std::vector<std::vector<glm::vec3>> cut_body(const OccluderMesh& mesh, size_t body, int axis, float at_m) {
  std::vector<Segment> segments = cut_faces(mesh, body, axis, at_m);
  std::vector<std::vector<glm::vec3>> outlines;
  while (!segments.empty()) {
    std::vector<glm::vec3> outline;
    Segment segment = segments.back();
    segments.pop_back();
    for (;;) {
      outline.push_back(segment.from);
      const auto next = std::find_if(segments.begin(), segments.end(), [&](const Segment& other) {
        return glm::distance(other.from, segment.to) < 1e-3f;
      });
      if (next == segments.end()) break;
      segment = *next;
      segments.erase(next);
    }
    if (outline.size() > 2) outlines.push_back(std::move(outline));
  }
  return outlines;
}

}  // namespace veduta
