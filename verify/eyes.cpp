#include "verify/eyes.h"

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include "pvs/viewer_eyes.h"

namespace veduta {
namespace {

auto blocked_by(const RayScene& rays) {
  return [&rays](const glm::vec3& from, const glm::vec3& to) { return rays.blocked(from, to); };
}

float radical_inverse(uint32_t index, uint32_t base) {
  double result = 0, digit = 1.0 / base;
  for (; index > 0; index /= base, digit /= base) result += digit * (index % base);
  return static_cast<float>(result);
}

constexpr uint32_t eyes_a_face = 1000;

// Of a face, the points of a Halton sequence shifted at random; all six faces.
template <typename Use>
void on_faces(const Box& cell, Random& random, const Use& use) {
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
    const glm::vec2 shift{random.unit(), random.unit()};
    for (uint32_t index = 1; index <= eyes_a_face; ++index) {
      const glm::vec2 at =
          glm::fract(glm::vec2(radical_inverse(index, 2), radical_inverse(index, 3)) + shift);
      glm::vec3 eye{0};
      eye[axis] = face % 2 == 0 ? cell.lower[axis] : cell.upper[axis];
      eye[u] = glm::mix(cell.lower[u], cell.upper[u], at.x);
      eye[v] = glm::mix(cell.lower[v], cell.upper[v], at.y);
      use(eye);
    }
  }
}

}  // namespace

bool viewer_can_be(const glm::vec3& eye, const OctreeForest& free, const RayScene& rays) {
  return viewer_can_be(eye, free, blocked_by(rays));
}

std::vector<glm::vec3> eye_points(const Box& cell, size_t count, const OctreeForest& free,
                                  const RayScene& rays, Random random) {
  std::vector<glm::vec3> faces, eyes;
  if (count >= protocol_eyes) {
    on_faces(cell, random, [&](const glm::vec3& eye) {
      if (viewer_can_be(eye, free, rays)) faces.push_back(eye);
    });
  }
  choose_eyes(cell, count - faces.size(), free, blocked_by(rays), random, eyes);
  eyes.insert(eyes.end(), faces.begin(), faces.end());
  return eyes;
}

}  // namespace veduta
