#include "scene/terrain_skirt.h"

#include <algorithm>
#include <unordered_map>

namespace veduta {
namespace {

uint64_t key(uint32_t a, uint32_t b) {
  return uint64_t{std::min(a, b)} << 32 | std::max(a, b);
}

}  // namespace

std::vector<Draft> terrain_skirt(const std::vector<Draft>& terrain, const std::vector<glm::vec3>& vertices,
                                 VertexPool& pool, float bottom) {
  std::unordered_map<uint64_t, uint32_t> uses;
  for (const Draft& t : terrain) {
    for (int n = 0; n < 3; ++n) ++uses[key(t.corners[n], t.corners[(n + 1) % 3])];
  }
  std::vector<Draft> walls;
  const auto add = [&](const Draft& from, uint32_t a, uint32_t b, uint32_t c) {
    if (degenerate(vertices[a], vertices[b], vertices[c])) return;
    walls.push_back({{a, b, c}, Material::terrain, from.patch, from.polygon});
  };
  for (const Draft& t : terrain) {
    for (int n = 0; n < 3; ++n) {
      uint32_t a = t.corners[n], b = t.corners[(n + 1) % 3];
      if (uses[key(a, b)] != 1) continue;
      const glm::vec3 pa = vertices[a], pb = vertices[b], pc = vertices[t.corners[(n + 2) % 3]];
      // Seen from above, the sheet must lie to the left of a -> b, so that the wall faces away from it.
      const bool left = (pb.x - pa.x) * (pc.y - pa.y) - (pb.y - pa.y) * (pc.x - pa.x) > 0;
      if (!left) std::swap(a, b);
      const glm::vec3 top_a = vertices[a], top_b = vertices[b];  // copies: the pool may move the vertices
      const uint32_t low_a = pool.index_of({top_a.x, top_a.y, bottom}),
                     low_b = pool.index_of({top_b.x, top_b.y, bottom});
      add(t, a, low_a, low_b);
      add(t, a, low_b, b);
    }
  }
  return walls;
}

}  // namespace veduta
