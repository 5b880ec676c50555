#include "worker/three_bytes.h"

#include <algorithm>

namespace veduta {

TriangleCounts::TriangleCounts(const Scene& scene, const std::vector<SliceCounts>& slices,
                               const std::vector<TriangleSlices>& triangle_slices)
    : slices_(slices) {
  for (size_t o = 0; o < scene.objects.size(); ++o) {
    for (int axis = 0; axis < 2; ++axis) {
      // Only rectangles that touch one end of the axis are ever asked for: prefixes by last slice, suffixes
      // by first.
      const int n = axis == 0 ? slices[o].x : slices[o].y, nz = slices[o].z;
      begin_.push_back(counts_.size());
      counts_.resize(counts_.size() + 2 * static_cast<size_t>(n) * nz, 0);
      uint32_t* prefix = &counts_[begin_.back()];
      uint32_t* suffix = prefix + static_cast<size_t>(n) * nz;
      for (uint64_t t = scene.objects[o].triangle_begin; t < scene.objects[o].triangle_end; ++t) {
        const TriangleSlices& s = triangle_slices[t];
        const int first = (axis == 0 ? s.x_first : s.y_first) - 1,
                  last = (axis == 0 ? s.x_last : s.y_last) - 1;
        ++prefix[last * nz + s.z_last - 1];
        ++suffix[first * nz + s.z_last - 1];
      }
      for (int i = 0; i < n; ++i) {
        for (int z = 1; z < nz; ++z)
          prefix[i * nz + z] += prefix[i * nz + z - 1], suffix[i * nz + z] += suffix[i * nz + z - 1];
      }
      for (int z = 0; z < nz; ++z) {
        for (int i = 1; i < n; ++i) prefix[i * nz + z] += prefix[(i - 1) * nz + z];
        for (int i = n - 2; i >= 0; --i) suffix[i * nz + z] += suffix[(i + 1) * nz + z];
      }
    }
  }
}

uint32_t TriangleCounts::inside(uint32_t object, int axis, int first, int last, int z) const {
  if (z == 0 || first > last) return 0;
  const int n = axis == 0 ? slices_[object].x : slices_[object].y, nz = slices_[object].z;
  const uint32_t* prefix = &counts_[begin_[2 * static_cast<size_t>(object) + axis]];
  if (first == 1) return prefix[(last - 1) * nz + z - 1];
  return prefix[static_cast<size_t>(n) * nz + (first - 1) * nz + z - 1];
}

VisibilityIndex TriangleCounts::choose(uint32_t object, const uint32_t* occluded) const {
  const SliceCounts& slices = slices_[object];
  uint32_t best_saved = 0;
  VisibilityIndex best = completely_visible;
  const auto consider = [&](int axis, int first, int last, int z, int end_byte) {
    const uint32_t saved = inside(object, axis, first, last, z);
    if (saved <= best_saved) return;
    best_saved = saved;
    best = {};
    // z-slices above the rectangle; none when it is as high as the object.
    best.z = static_cast<int8_t>(z < slices.z ? z + 1 : 0);
    (axis == 0 ? best.x : best.y) = static_cast<int8_t>(end_byte);
  };
  for (int axis = 0; axis < 2; ++axis) {
    const int n = axis == 0 ? slices.x : slices.y;
    const uint32_t* hidden = occluded + (axis == 0 ? 0 : slices.x);
    uint32_t lowest = slices.z;
    for (int i = n; i >= 1; --i) {  // hidden slices [i, n]: visible are those that begin in a slice <= i - 1
      lowest = std::min(lowest, hidden[i - 1]);
      if (i == 1 && lowest == slices.z) return {};
      consider(axis, i, n, static_cast<int>(lowest), i - 1);
    }
    lowest = slices.z;
    for (int i = 1; i < n; ++i) {  // hidden slices [1, i]: visible are those that reach a slice >= i + 1
      lowest = std::min(lowest, hidden[i - 1]);
      consider(axis, 1, i, static_cast<int>(lowest), -i);
    }
  }
  return best;
}

}  // namespace veduta
