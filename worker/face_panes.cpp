#include "worker/face_panes.h"

#include <cmath>

namespace veduta {

PixelBounds pixel_bounds(const Box& relative, int face, int resolution, float near_m) {
  PixelBounds bounds;
  const Box box = to_face(face, relative);
  const float nearest = nearest_depth(box);
  if (nearest > box.upper.z * 1.00001f + 1e-6f) return bounds;
  bounds.reaches = true;
  if (face >= face_count || nearest < near_m) {
    bounds.at_eye = true;
    return bounds;
  }
  const auto pixel = [&](float ratio) {
    return static_cast<int>(
        std::floor((std::clamp(ratio, -1.0f, 1.0f) + 1) * 0.5f * static_cast<float>(resolution)));
  };
  const auto inside = [&](int value) { return std::clamp(value, 0, resolution - 1); };
  const auto [lower, upper] = box;
  bounds.x0 = inside(pixel(lower.x / (lower.x < 0 ? nearest : upper.z)) - 1);
  bounds.x1 = inside(pixel(upper.x / (upper.x > 0 ? nearest : upper.z)) + 1);
  bounds.y0 = inside(pixel(lower.y / (lower.y < 0 ? nearest : upper.z)) - 1);
  bounds.y1 = inside(pixel(upper.y / (upper.y > 0 ? nearest : upper.z)) + 1);
  return bounds;
}

void FacePanes::clear() {
  for (auto& face : rows_) face.fill({resolution_, 0});
}

void FacePanes::add_all() {
  for (auto& face : rows_) {
    for (int s = 0; s < strips; ++s)
      face[s] = {0, s * strip_width(resolution_) < resolution_ ? resolution_ : 0};
  }
}

void FacePanes::add(const Box& relative, float near_m) {
  const int width = strip_width(resolution_);
  for (int face = 0; face < face_count; ++face) {
    const PixelBounds b = pixel_bounds(relative, face, resolution_, near_m);
    if (!b.reaches || b.at_eye) continue;
    // One pixel more: the renderer may round otherwise.
    const int first = std::max(b.x0 - 1, 0) / width, last = std::min(b.x1 + 1, resolution_ - 1) / width;
    for (int s = first; s <= last; ++s) {
      auto& [lower, upper] = rows_[face][s];
      lower = std::min(lower, std::max(b.y0 - 1, 0)),
      upper = std::max(upper, std::min(b.y1 + 2, resolution_));
    }
  }
}

const std::vector<Pane>& FacePanes::make() {
  panes_.clear();
  const int width = strip_width(resolution_);
  for (int face = 0; face < face_count; ++face) {
    bool open = false;  // does the last pane end where this strip begins?
    int asked = 0;      // pixels of the strips of the last pane
    for (int s = 0; s * width < resolution_; ++s) {
      auto& [lower, upper] = rows_[face][s];
      if (lower >= upper) {
        open = false;
        continue;
      }
      lower = lower / alignment * alignment, upper = (upper + alignment - 1) / alignment * alignment;
      const int pixels = width * (upper - lower);
      if (open) {
        // A pane costs about as much as some pixels more.
        Pane& pane = panes_.back();
        const Pane both{face, pane.x0, pane.x1 + width, std::min(pane.y0, lower), std::max(pane.y1, upper)};
        if (both.pixels() <= (asked + pixels) * 3 / 2 + 4096) {
          pane = both, asked += pixels;
          continue;
        }
      }
      panes_.push_back({face, s * width, (s + 1) * width, lower, upper});
      open = true, asked = pixels;
    }
  }
  for (const Pane& pane : panes_) {
    for (int s = pane.x0 / width; s * width < pane.x1; ++s) rows_[pane.face][s] = {pane.y0, pane.y1};
  }
  return panes_;
}

}  // namespace veduta
