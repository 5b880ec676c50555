#include "worker/slices.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "worker/clip.h"

namespace veduta {
namespace {

/// The planes between the slices of one axis of an object. Triangles are assigned and clipped by the same
/// planes.
struct Planes {
  double lower, step;
  int count;
  Planes(double lower_m, double upper_m, int n) : lower(lower_m), step((upper_m - lower_m) / n), count(n) {}
  int slice(double value) const {
    return step > 0 ? std::clamp(static_cast<int>(std::floor((value - lower) / step)), 0, count - 1) : 0;
  }
  double plane(int i) const { return lower + i * step; }
};

/// From where to where a triangle is along an axis.
struct Reach {
  double low, high;
};

constexpr double coarsest_slice_m = 8;
constexpr double cost_of_a_slice = 1;  // triangles

/// The triangles that are drawn for nothing in the mean, when what is visible of the object ends anywhere
/// along the axis: the parts of the axis where a triangle is beyond the end and one of its slices is not. A
/// row's end may lie on either side, along z on the upper one alone.
double drawn_for_nothing(const std::vector<Reach>& triangles, const Planes& planes, bool both_sides) {
  double beyond = 0;
  for (const Reach& t : triangles) {
    beyond += planes.plane(planes.slice(t.high) + 1) - t.high;
    if (both_sides) beyond += t.low - planes.plane(planes.slice(t.low));
  }
  return beyond / (planes.step * planes.count);
}

uint8_t choose_count(const std::vector<Reach>& triangles, double lower, double upper, int most,
                     bool both_sides) {
  if (!(upper > lower)) return 1;
  const int least = static_cast<int>(
      std::clamp(std::round((upper - lower) / coarsest_slice_m), 1.0, static_cast<double>(most)));
  int best = least;
  double best_cost = INFINITY;
  for (int n = least; n <= most; ++n) {
    const double cost =
        drawn_for_nothing(triangles, Planes(lower, upper, n), both_sides) + cost_of_a_slice * n;
    // Sums in another order, of the same object elsewhere, must not choose another count.
    if (cost < best_cost - 1e-6) best_cost = cost, best = n;
  }
  return static_cast<uint8_t>(best);
}

/// The part of the polygon in a slice of an axis. The slab is a little thicker than the slice, so that
/// rounding makes test boxes larger, never smaller: an occludee that is too large errs towards visible.
ClippedTriangle clip_slice(const ClippedTriangle& in, int axis, const Planes& planes, int i) {
  const double margin = 1e-4 * planes.step + 1e-6;
  return clip_slab(in, axis, planes.plane(i) - margin, planes.plane(i + 1) + margin);
}

void extend(Box& box, const ClippedTriangle& polygon) {
  for (int n = 0; n < polygon.count; ++n) {
    glm::vec3 lower, upper;  // float boxes around double corners: outwards
    for (int k = 0; k < 3; ++k) {
      const float value = static_cast<float>(polygon.corner[n][k]);
      lower[k] = std::nextafter(value, -INFINITY), upper[k] = std::nextafter(value, INFINITY);
    }
    box.extend(lower), box.extend(upper);
  }
}

std::array<Planes, 3> planes_of(const Scene& scene, size_t object, const SliceCounts& n) {
  const Box b = scene.bounds(object);
  return {Planes(b.lower.x, b.upper.x, n.x), Planes(b.lower.y, b.upper.y, n.y),
          Planes(b.lower.z, b.upper.z, n.z)};
}

/// Fills the boxes of one object: for each vertical slice the box of what ends at each level, then cumulated
/// upwards.
void fill_boxes(const Scene& scene, uint32_t o, const SliceCounts& n,
                const std::vector<TriangleSlices>& touched, const VerticalSlice* slice, Box* all) {
  const std::array<Planes, 3> planes = planes_of(scene, o, n);
  visit_triangles(scene, o, [&](uint64_t t, const std::array<glm::vec3, 3>& corners) {
    const ClippedTriangle triangle = uncut(corners);
    const TriangleSlices& s = touched[t];
    for (int axis = 0; axis < 2; ++axis) {
      const int first = (axis == 0 ? s.x_first : s.y_first) - 1, last = (axis == 0 ? s.x_last : s.y_last) - 1;
      for (int i = first; i <= last; ++i) {
        // Whole along z: a row draws a triangle that ends higher, so what hides it need not hide this one.
        const VerticalSlice& vertical = slice[axis == 0 ? i : n.x + i];
        extend(all[vertical.first_box + s.z_last - 1], clip_slice(triangle, axis, planes[axis], i));
      }
    }
  });
  for (int i = 0; i < n.x + n.y; ++i) {
    for (uint32_t h = 1; h < slice[i].heights; ++h)
      all[slice[i].first_box + h].extend(all[slice[i].first_box + h - 1]);
  }
}

}  // namespace

std::vector<SliceCounts> choose_slices(const Scene& scene, int most) {
  std::vector<SliceCounts> slices(scene.objects.size());
  tbb::parallel_for(size_t{0}, scene.objects.size(), [&](size_t o) {
    const Box b = scene.bounds(o);
    std::array<std::vector<Reach>, 3> triangles;
    visit_triangles(scene, o, [&](uint64_t, const std::array<glm::vec3, 3>& corners) {
      for (int axis = 0; axis < 3; ++axis) {
        const auto [low, high] = std::minmax({corners[0][axis], corners[1][axis], corners[2][axis]});
        triangles[axis].push_back({low, high});
      }
    });
    slices[o] = {choose_count(triangles[0], b.lower.x, b.upper.x, most, true),
                 choose_count(triangles[1], b.lower.y, b.upper.y, most, true),
                 choose_count(triangles[2], b.lower.z, b.upper.z, most, false)};
  });
  return slices;
}

std::vector<TriangleSlices> slice_triangles(const Scene& scene, const std::vector<SliceCounts>& slices) {
  std::vector<TriangleSlices> touched(scene.triangle_count());
  tbb::parallel_for(size_t{0}, scene.objects.size(), [&](size_t o) {
    const std::array<Planes, 3> planes = planes_of(scene, o, slices[o]);
    visit_triangles(scene, o, [&](uint64_t t, const std::array<glm::vec3, 3>& corners) {
      std::array<uint8_t, 6> range{};
      for (int axis = 0; axis < 3; ++axis) {
        const auto [low, high] = std::minmax({corners[0][axis], corners[1][axis], corners[2][axis]});
        range[2 * axis] = static_cast<uint8_t>(planes[axis].slice(low) + 1);
        range[2 * axis + 1] = static_cast<uint8_t>(planes[axis].slice(high) + 1);
      }
      touched[t] = {range[0], range[1], range[2], range[3], range[4], range[5]};
    });
  });
  return touched;
}

SliceBoxes slice_boxes(const Scene& scene, const std::vector<SliceCounts>& slices,
                       const std::vector<TriangleSlices>& triangle_slices) {
  SliceBoxes result;
  result.object_slice_begin.push_back(0);
  uint64_t boxes = 0;
  for (uint32_t o = 0; o < scene.objects.size(); ++o) {
    for (int i = 0; i < slices[o].x + slices[o].y; ++i) {
      result.slices.push_back({o, static_cast<uint32_t>(boxes), slices[o].z});
      boxes += slices[o].z;
    }
    result.object_slice_begin.push_back(static_cast<uint32_t>(result.slices.size()));
  }
  if (boxes > UINT32_MAX) throw std::length_error("more than 2^32 slice boxes");
  result.boxes.resize(boxes);
  tbb::parallel_for(uint32_t{0}, static_cast<uint32_t>(scene.objects.size()), [&](uint32_t o) {
    fill_boxes(scene, o, slices[o], triangle_slices, &result.slices[result.object_slice_begin[o]],
               result.boxes.data());
  });
  return result;
}

}  // namespace veduta
