#include "worker/seen_eyes.h"

#include "pvs/viewer_eyes.h"
#include "worker/view_cells.h"

namespace veduta {

void choose_eyes(const OctreeForest& free, const RayScene& rays, const Box& cell, size_t count, Random random,
                 std::vector<glm::vec3>& eyes) {
  eyes.clear();
  const Box part = navigable_part(free, cell, free.leaf_size_m);
  if (part.empty()) return;
  const auto blocked = [&](const glm::vec3& from, const glm::vec3& to) { return rays.blocked(from, to); };
  choose_eyes(part, count, free, blocked, random, eyes);
}

}  // namespace veduta
