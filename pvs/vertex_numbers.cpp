#include "pvs/vertex_numbers.h"

#include <algorithm>

namespace veduta {

namespace {

std::vector<VertexRun> runs_of(const std::vector<uint32_t>& ascending) {
  std::vector<VertexRun> runs;
  for (const uint32_t vertex : ascending)
    if (!runs.empty() && runs.back().first + runs.back().count == vertex)
      ++runs.back().count;
    else
      runs.push_back({vertex, 1});
  return runs;
}

}  // namespace

std::vector<VertexRun> number_from_zero(std::vector<glm::uvec3>& triangles) {
  if (triangles.empty()) return {};
  uint32_t lowest = UINT32_MAX, highest = 0;
  for (const glm::uvec3& t : triangles) {
    lowest = std::min({lowest, t.x, t.y, t.z});
    highest = std::max({highest, t.x, t.y, t.z});
  }
  const uint64_t corners = 3 * triangles.size(), span = uint64_t{highest} - lowest + 1;
  std::vector<uint32_t> used;
  if (span <= 4 * corners) {
    // Together, as programs write them: a table.
    std::vector<uint32_t> number(span, 0);
    for (const glm::uvec3& t : triangles)
      for (int corner = 0; corner < 3; ++corner) number[t[corner] - lowest] = 1;
    for (size_t v = 0; v < span; ++v) {
      if (number[v] == 0) continue;
      number[v] = static_cast<uint32_t>(used.size());
      used.push_back(lowest + static_cast<uint32_t>(v));
    }
    for (glm::uvec3& t : triangles)
      for (int corner = 0; corner < 3; ++corner) t[corner] = number[t[corner] - lowest];
  } else {
    used.reserve(corners);
    for (const glm::uvec3& t : triangles) used.insert(used.end(), {t.x, t.y, t.z});
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (glm::uvec3& t : triangles)
      for (int corner = 0; corner < 3; ++corner)
        t[corner] =
            static_cast<uint32_t>(std::lower_bound(used.begin(), used.end(), t[corner]) - used.begin());
  }
  return runs_of(used);
}

}  // namespace veduta
