#include "verify/eyes.h"

#include "pvs/viewer_eyes.h"

namespace veduta {
namespace {

auto blocked_by(const RayScene& rays) {
  return [&rays](const glm::vec3& from, const glm::vec3& to) { return rays.blocked(from, to); };
}

}  // namespace

bool viewer_can_be(const glm::vec3& eye, const OctreeForest& free, const RayScene& rays) {
  return viewer_can_be(eye, free, blocked_by(rays));
}

std::vector<glm::vec3> eye_points(const Box& cell, size_t count, const OctreeForest& free,
                                  const RayScene& rays, Random random) {
  std::vector<glm::vec3> eyes;
  choose_eyes(cell, count, free, blocked_by(rays), random, eyes);
  return eyes;
}

}  // namespace veduta
