#include "worker/zoom_view.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "worker/cube_face.h"

namespace veduta {
namespace {

/// Wider than 83 degrees to a side, most of a picture shows next to nothing, hugely: such a box is at the
/// eye.
constexpr float widest = 8.0f;

constexpr float depth_rounding = 1e-5f;

/// Pixels around the box, so that what is fattened by one is not cut off.
constexpr int margin_pixels = 2;

glm::mat3 looking_along(const glm::vec3& forward) {
  const glm::vec3 sky = std::abs(forward.z) < 0.9f ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
  const glm::vec3 right = glm::normalize(glm::cross(forward, sky));
  return glm::transpose(glm::mat3(right, glm::cross(right, forward), forward));
}

glm::vec3 row(const glm::mat3& m, int r) {
  return {m[0][r], m[1][r], m[2][r]};
}

}  // namespace

float ZoomView::pixel_m(float depth_m) const {
  const glm::vec2 tangents =
      (upper - lower) / glm::vec2(static_cast<float>(width), static_cast<float>(height));
  return std::max(tangents.x, tangents.y) * depth_m;
}

glm::vec2 ZoomView::depths_m(const Box& box) const {
  const glm::vec3 forward = row(view_from_world, 2);
  const float middle = glm::dot(forward, box.center() - eye),
              reach = glm::dot(glm::abs(forward), box.half_extent());
  return {middle - reach, middle + reach};
}

Box ZoomView::fattened(const Box& box) const {
  const float far_m = std::max(depths_m(box).y, 0.0f);
  const float by_m = std::max(pixel_m(far_m), depth_rounding * far_m);
  return {box.lower - by_m, box.upper + by_m};
}

std::optional<ZoomView> zoom_onto(const Box& box, const glm::vec3& eye) {
  const glm::vec3 to_box = box.center() - eye;
  const float distance_m = glm::length(to_box);
  if (!(distance_m > ZoomView::near_m)) return std::nullopt;
  ZoomView view;
  view.eye = eye;
  view.view_from_world = looking_along(to_box / distance_m);
  view.lower = glm::vec2(std::numeric_limits<float>::max()), view.upper = -view.lower;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::vec3 p = view.view_from_world * (glm::vec3((corner & 1 ? box.upper : box.lower).x,
                                                          (corner & 2 ? box.upper : box.lower).y,
                                                          (corner & 4 ? box.upper : box.lower).z) -
                                                eye);
    if (p.z < ZoomView::near_m || std::max(std::abs(p.x), std::abs(p.y)) > widest * p.z) return std::nullopt;
    const glm::vec2 place = glm::vec2(p) / p.z;
    view.lower = glm::min(view.lower, place), view.upper = glm::max(view.upper, place);
  }
  // Square pixels, as many as the picture has along one axis. A point is a pixel of a millionth.
  const glm::vec2 extent = view.upper - view.lower;
  const float pixel = std::max({extent.x / (ZoomView::most_width - 2 * margin_pixels),
                                extent.y / (ZoomView::most_height - 2 * margin_pixels), 1e-6f});
  const auto pixels = [&](float length, int most) {
    return std::min(static_cast<int>(std::ceil(length / pixel)) + 2 * margin_pixels, most);
  };
  view.width = pixels(extent.x, ZoomView::most_width);
  view.height = pixels(extent.y, ZoomView::most_height);
  const glm::vec2 middle = 0.5f * (view.lower + view.upper);
  const glm::vec2 half =
      0.5f * pixel * glm::vec2(static_cast<float>(view.width), static_cast<float>(view.height));
  view.lower = middle - half, view.upper = middle + half;
  return view;
}

ZoomView section(int face, const glm::vec3& eye) {
  // The faces of the cube are seen from outside: mirrored.
  const glm::mat3 mirror(-1, 0, 0, 0, 1, 0, 0, 0, 1);
  ZoomView view;
  view.eye = eye;
  view.view_from_world = mirror * face_from_world(face);
  view.lower = glm::vec2(-1), view.upper = glm::vec2(1);
  view.width = ZoomView::most_width, view.height = ZoomView::most_height;
  return view;
}

ZoomFrustum::ZoomFrustum(const ZoomView& view, float depth_limit_m) : eye_(view.eye) {
  const glm::vec3 right = row(view.view_from_world, 0), up = row(view.view_from_world, 1),
                  forward = row(view.view_from_world, 2);
  planes_ = {{{right - view.lower.x * forward, 0},
              {view.upper.x * forward - right, 0},
              {up - view.lower.y * forward, 0},
              {view.upper.y * forward - up, 0},
              {forward, -ZoomView::near_m},
              {-forward, depth_limit_m}}};
}

bool ZoomFrustum::reached_by(const Box& box) const {
  const glm::vec3 center = box.center() - eye_, half = box.half_extent();
  return std::all_of(planes_.begin(), planes_.end(), [&](const Plane& plane) {
    return glm::dot(plane.normal, center) + glm::dot(glm::abs(plane.normal), half) + plane.offset >= 0;
  });
}

}  // namespace veduta
