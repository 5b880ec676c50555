// Objects of random triangles, and slices of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "pvs/visibility.h"
#include "tests/worker/mesh.h"

namespace veduta::test {

/// Objects of random triangles, some large and some small, at coordinates of a kilometre.
inline Mesh random_objects(Random& random, int objects) {
  Mesh mesh;
  for (int o = 0; o < objects; ++o) {
    const glm::vec3 lower = random.point({{-1000, -1000, -20}, {1000, 1000, 20}});
    const Box room{lower, lower + random.point({{5, 5, 3}, {60, 40, 30}})};
    mesh.object();
    const int triangles = random.integer(1, 30);
    for (int t = 0; t < triangles; ++t) {
      const glm::vec3 a = random.point(room);
      const auto near = static_cast<float>(random.chance(0.5) ? 1.0 : 0.1);
      mesh.triangle(a, glm::mix(a, random.point(room), near), glm::mix(a, random.point(room), near));
    }
  }
  return mesh;
}

inline std::vector<SliceCounts> random_slice_counts(Random& random, const Scene& scene, int most) {
  std::vector<SliceCounts> counts;
  const auto count = [&] { return static_cast<uint8_t>(random.integer(1, most)); };
  for (size_t o = 0; o < scene.objects.size(); ++o) counts.push_back({count(), count(), count()});
  return counts;
}

/// The slice, 1-based, of a value, by the definition: n equal parts of the object's bounds.
inline int slice_of(double value, double lower, double upper, int n) {
  return upper > lower
             ? std::clamp(static_cast<int>(std::floor((value - lower) * n / (upper - lower))) + 1, 1, n)
             : 1;
}

}  // namespace veduta::test
