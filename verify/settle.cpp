// Ray against triangle by signed volumes (Segura & Feito 2001), in CGAL's exact kernel: floats are rational
// numbers, so nothing is rounded. The kernel works with intervals first and falls back to rationals only
// where a sign is in doubt.
#include "verify/settle.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

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
    const std::optional<Number> met =
        distance(along, exact(scene.vertices[corner.x]) - origin, exact(scene.vertices[corner.y]) - origin,
                 exact(scene.vertices[corner.z]) - origin);
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
