// Whether the faces of a mesh share their edges, so that no rounding of its vertices can open it.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "scene/city/city_model.h"

namespace veduta::city {

struct EdgeBalance {
  int open = 0;       ///< edges that faces do not run along as often one way as the other
  std::string first;  ///< where one of those is
};

inline EdgeBalance edge_balance(const Mesh& mesh) {
  std::map<std::pair<uint32_t, uint32_t>, int> sums;
  for (const Face& face : mesh.faces) {
    const size_t count = face.is_quad() ? 4 : 3;
    for (size_t i = 0; i < count; ++i) {
      const uint32_t a = face.corner[i], b = face.corner[(i + 1) % count];
      sums[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  }
  EdgeBalance balance;
  for (const auto& [edge, sum] : sums) {
    if (sum == 0) continue;
    if (balance.open++ > 0) continue;
    for (const uint32_t vertex : {edge.first, edge.second}) {
      const glm::dvec3& p = mesh.vertices[vertex];
      balance.first +=
          "(" + std::to_string(p.x) + ", " + std::to_string(p.y) + ", " + std::to_string(p.z) + ") ";
    }
  }
  return balance;
}

}  // namespace veduta::city
