// Small scenes made in a test, and random numbers that repeat.
#pragma once

#include <cmath>
#include <glm/vec3.hpp>
#include <random>
#include <string>

#include "scene/scene.h"
#include "worker/bit_grid.h"

namespace veduta::test {

class Random {
 public:
  explicit Random(uint32_t seed) : engine_(seed) {}
  double real(double lower, double upper) {
    return std::uniform_real_distribution<double>(lower, upper)(engine_);
  }
  int integer(int lower, int upper) { return std::uniform_int_distribution<int>(lower, upper)(engine_); }
  bool chance(double p) { return real(0, 1) < p; }
  glm::vec3 point(const Box& box) {
    return {static_cast<float>(real(box.lower.x, box.upper.x)),
            static_cast<float>(real(box.lower.y, box.upper.y)),
            static_cast<float>(real(box.lower.z, box.upper.z))};
  }

 private:
  std::mt19937 engine_;
};

/// A scene that grows object by object.
class Mesh {
 public:
  void object(Kind kind = Kind::building) {
    const uint64_t begin = scene.triangles.size();
    scene.objects.push_back({"object" + std::to_string(scene.objects.size()), kind, begin, begin});
  }
  /// Adds to the last object.
  void triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const auto first = static_cast<unsigned>(scene.vertices.size());
    scene.vertices.insert(scene.vertices.end(), {a, b, c});
    scene.triangles.push_back({first, first + 1, first + 2});
    scene.material.push_back(Material::unknown);
    scene.objects.back().triangle_end = scene.triangles.size();
  }
  void quad(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d) {
    triangle(a, b, c), triangle(a, c, d);
  }
  /// The six sides of a box; `roof` says whether it has a top.
  void box(const Box& b, bool roof = true) {
    const glm::vec3 l = b.lower, u = b.upper;
    quad({l.x, l.y, l.z}, {u.x, l.y, l.z}, {u.x, l.y, u.z}, {l.x, l.y, u.z});
    quad({u.x, u.y, l.z}, {l.x, u.y, l.z}, {l.x, u.y, u.z}, {u.x, u.y, u.z});
    quad({l.x, u.y, l.z}, {l.x, l.y, l.z}, {l.x, l.y, u.z}, {l.x, u.y, u.z});
    quad({u.x, l.y, l.z}, {u.x, u.y, l.z}, {u.x, u.y, u.z}, {u.x, l.y, u.z});
    quad({l.x, l.y, l.z}, {l.x, u.y, l.z}, {u.x, u.y, l.z}, {u.x, l.y, l.z});
    if (roof) quad({l.x, l.y, u.z}, {u.x, l.y, u.z}, {u.x, u.y, u.z}, {l.x, u.y, u.z});
  }
  /// A flat terrain.
  void ground(float x0, float y0, float x1, float y1, float z) {
    object(Kind::terrain);
    quad({x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z});
  }

  Scene scene;
};

inline GridFrame small_frame(int nx, int ny, int nz, double size_m = 0.25) {
  GridFrame frame;
  frame.size_m = size_m;
  frame.nx = nx, frame.ny = ny, frame.nz = nz;
  return frame;
}

/// Calls visit(i, j, k) for every voxel.
template <typename Visit>
void each_voxel(const GridFrame& frame, Visit visit) {
  for (int j = 0; j < frame.ny; ++j) {
    for (int i = 0; i < frame.nx; ++i) {
      for (int k = 0; k < frame.nz; ++k) visit(i, j, k);
    }
  }
}

/// How many voxels are set in one grid alone.
inline int differences(const BitGrid& a, const BitGrid& b) {
  int count = 0;
  each_voxel(a.frame(), [&](int i, int j, int k) { count += a.get(i, j, k) != b.get(i, j, k); });
  return count;
}

}  // namespace veduta::test
