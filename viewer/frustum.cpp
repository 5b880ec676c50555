// Follows thesis §5.2.2, fig. 5.5 (backward_distance = half_interocular_distance / tan(delta)). Where it
// departs: our eyes' frusta are asymmetric, so delta is the wider of an eye's two half-angles; with the
// narrower one, the outer edges would cross beyond the screen distance.
#include "viewer/frustum.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include "viewer/view_state.h"

namespace veduta {

bool Frustum::outside(const Box& box) const {
  const glm::dvec3 lower(box.lower), upper(box.upper);
  return std::any_of(planes.begin(), planes.end(), [&](const Plane& plane) {
    const glm::dvec3 farthest_inside{plane.normal.x > 0 ? upper.x : lower.x,
                                     plane.normal.y > 0 ? upper.y : lower.y,
                                     plane.normal.z > 0 ? upper.z : lower.z};
    return glm::dot(plane.normal, farthest_inside) + plane.offset < 0;
  });
}

bool Frustum::contains(const glm::dvec3& point) const {
  return std::all_of(planes.begin(), planes.end(),
                     [&](const Plane& plane) { return glm::dot(plane.normal, point) + plane.offset >= 0; });
}

Frustum single_location_frustum(const Pose& pose, const Optics& optics) {
  const Axes a = axes(pose);
  const glm::dvec3 right(a.right), up(a.up), forward(a.forward), eye(pose.position_m);
  const double half_iod_m = optics.iod_m / 2.0, distance_m = optics.screen_distance_m;
  const double tan_across = (optics.half_width_m() + half_iod_m) / distance_m;
  const double tan_upright = optics.half_height_m() / distance_m;
  const glm::dvec3 apex = eye - forward * (half_iod_m / tan_across);

  const auto plane = [](const glm::dvec3& normal, const glm::dvec3& through) {
    return Frustum::Plane{normal, -glm::dot(normal, through)};
  };
  // No slack is needed for rounding: what is drawn is sampled at least an eighth of a pixel inside the
  // picture's edge.
  return {{plane(forward, eye + forward * double{optics.near_m}), plane(forward * tan_across + right, apex),
           plane(forward * tan_across - right, apex), plane(forward * tan_upright + up, apex),
           plane(forward * tan_upright - up, apex)}};
}

Frustum eye_frustum(const EyeView& view) {
  // In the picture: |x| <= w, |y| <= w and z <= w in clip space, each a row of the matrix.
  const auto row = [&](int i) {
    const glm::mat4& m = view.clip_from_offset;
    return glm::dvec4(m[0][i], m[1][i], m[2][i], m[3][i]);
  };
  const auto plane = [&](const glm::dvec4& half_space) {
    const glm::dvec3 normal(half_space);
    return Frustum::Plane{normal, half_space.w - glm::dot(normal, glm::dvec3(view.position_m))};
  };
  const glm::dvec4 x = row(0), y = row(1), z = row(2), w = row(3);
  return {{plane(w - z), plane(w + x), plane(w - x), plane(w + y), plane(w - y)}};
}

std::vector<Frustum> frusta(Culling culling, const Pose& pose, const Optics& optics, StereoMode mode) {
  if (culling == Culling::none) return {};
  const std::vector<Eye> drawn = eyes(mode);
  if (drawn.size() > 1 && culling == Culling::single_location) return {single_location_frustum(pose, optics)};
  std::vector<Frustum> each;
  for (Eye eye : drawn) each.push_back(eye_frustum(eye_view(pose, optics, eye)));
  return each;
}

}  // namespace veduta
