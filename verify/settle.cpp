// Ray against triangle by signed volumes (Segura & Feito 2001), in CGAL's exact kernel: floats are rational
// numbers, so nothing is rounded. The kernel works with intervals first and falls back to rationals only
// where a sign is in doubt.
#include "verify/settle.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <glm/common.hpp>

namespace veduta {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Vector = Kernel::Vector_3;
using Number = Kernel::FT;

// The distance along the ray, in lengths of its direction. Corners are relative to the eye.
std::optional<Number> distance(const Vector& direction, const Vector& a, const Vector& b, const Vector& c) {
  const CGAL::Sign ab = CGAL::sign(direction * CGAL::cross_product(a, b));
  const CGAL::Sign bc = CGAL::sign(direction * CGAL::cross_product(b, c));
  if (ab * bc < 0) return {};
  const CGAL::Sign ca = CGAL::sign(direction * CGAL::cross_product(c, a));
  if (bc * ca < 0 || ca * ab < 0) return {};
  const Vector normal = CGAL::cross_product(b - a, c - a);
  const Number along = normal * direction;
  if (CGAL::is_zero(along)) return {};
  const Number result = (normal * a) / along;
  if (!CGAL::is_positive(result)) return {};
  return result;
}

// The sign of direction * (a x b), or 0 where rounding could have changed it. Six products of three factors,
// each rounded at most five times on the way: relative error under 1e-15 a term; the bound is ten times that.
// Products of three floats neither overflow nor underflow in doubles.
int sure_sign(const glm::dvec3& direction, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 plus = direction * glm::dvec3(a.y * b.z, a.z * b.x, a.x * b.y);
  const glm::dvec3 minus = direction * glm::dvec3(a.z * b.y, a.x * b.z, a.y * b.x);
  const double value = (plus.x - minus.x) + (plus.y - minus.y) + (plus.z - minus.z);
  const glm::dvec3 size = glm::abs(plus) + glm::abs(minus);
  const double bound = 1e-14 * (size.x + size.y + size.z);
  return value > bound ? 1 : value < -bound ? -1 : 0;
}

bool surely_missed(const glm::dvec3& direction, const glm::dvec3& a, const glm::dvec3& b,
                   const glm::dvec3& c) {
  const int ab = sure_sign(direction, a, b), bc = sure_sign(direction, b, c), ca = sure_sign(direction, c, a);
  return ab * bc < 0 || bc * ca < 0 || ca * ab < 0;
}

Vector exact(const glm::vec3& v) {
  return {v.x, v.y, v.z};
}

}  // namespace

std::optional<uint32_t> undrawn_met_first(const Scene& scene, const glm::vec3& eye,
                                          const glm::vec3& direction, std::span<const uint32_t> candidates,
                                          const std::vector<uint8_t>& drawn) {
  const Vector origin = exact(eye), along = exact(direction);
  std::optional<uint32_t> first;
  std::optional<Number> nearest_undrawn, nearest_drawn;
  for (const uint32_t triangle : candidates) {
    const glm::uvec3& corner = scene.triangles[triangle];
    const glm::vec3 &a = scene.vertices[corner.x], &b = scene.vertices[corner.y],
                    &c = scene.vertices[corner.z];
    const glm::dvec3 center = eye;
    if (surely_missed(direction, glm::dvec3(a) - center, glm::dvec3(b) - center, glm::dvec3(c) - center))
      continue;
    const std::optional<Number> met =
        distance(along, exact(a) - origin, exact(b) - origin, exact(c) - origin);
    if (!met) continue;
    std::optional<Number>& nearest = drawn[triangle] ? nearest_drawn : nearest_undrawn;
    if (nearest && *nearest <= *met) continue;
    nearest = met;
    if (!drawn[triangle]) first = triangle;
  }
  if (nearest_undrawn && nearest_drawn && *nearest_drawn <= *nearest_undrawn) return {};
  return first;
}

}  // namespace veduta
