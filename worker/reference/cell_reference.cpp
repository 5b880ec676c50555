#include "worker/reference/cell_reference.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "scene/error.h"
#include "worker/cell_parts.h"
#include "worker/cell_windows.h"
#include "worker/view_cells.h"

namespace veduta::reference {
namespace {

/// Calls visit(point) for a lattice of points of a box until it says true: along each axis one point where
/// the box is flat, both ends where it is shorter than a metre, else `most`. \return whether it did.
template <typename Visit>
bool any_of_lattice(const glm::dvec3& lower, const glm::dvec3& upper, int most, const Visit& visit) {
  std::array<int, 3> n;
  for (int axis = 0; axis < 3; ++axis) {
    const double length = upper[axis] - lower[axis];
    n[axis] = length > 1 ? most : length > 0 ? 2 : 1;
  }
  for (int k = 0; k < n[0] * n[1] * n[2]; ++k) {
    const glm::dvec3 at(k % n[0], k / n[0] % n[1], k / n[0] / n[1]);
    const glm::dvec3 last(std::max(n[0] - 1, 1), std::max(n[1] - 1, 1), std::max(n[2] - 1, 1));
    if (visit(glm::mix(lower, upper, at / last))) return true;
  }
  return false;
}

}  // namespace

CellReference::CellReference(const OcclusionInput& input) : input_(input) {
  for (size_t o = 0; o < input.city.scene.objects.size(); ++o) objects_.push_back(input.city.scene.bounds(o));
  for (const WindowOccluders& window : input.occluders.meshes()) {
    GrownPolygons& as_they_are = occluders_.emplace_back();
    for (const OccluderRing& ring : window.rings) {
      as_they_are.add(ring.occluders, glm::dvec3(0));
      solid_.add(ring.occluders, window.half_extent_m + ring.h_m);
    }
    as_they_are.build();
  }
  solid_.build();
}

std::vector<Witness> CellReference::wrongly_hidden(const CellOcclusion& answer,
                                                   std::span<const glm::vec3> eyes) const {
  std::vector<Witness> witnesses;
  const SliceBoxes& slices = input_.slices;
  const auto seen_from = [&](const glm::vec3& eye, const Box& box, glm::dvec3& seen_point) {
    return !box.empty() && any_of_lattice(box.lower, box.upper, 3, [&](const glm::dvec3& point) {
      seen_point = point;
      return !solid_.meet(eye, point);
    });
  };
  const auto slice_box = [&](uint32_t s, uint32_t height) -> const Box& {
    return slices.boxes[slices.slices[s].first_box + height - 1];
  };
  // Are all slices along one axis hidden from the eye to their tops? Then all of the object is, whatever the
  // boxes along the other axis reach beyond it.
  const auto hidden_by_slices = [&](const glm::vec3& eye, uint32_t o) {
    const uint32_t begin = slices.object_slice_begin[o], end = slices.object_slice_begin[o + 1];
    const uint32_t middle = begin == end ? end : begin + input_.city.slices[o].x;
    const auto all_hidden = [&](uint32_t first, uint32_t last) {
      glm::dvec3 ignored;
      for (uint32_t s = first; s < last; ++s)
        if (seen_from(eye, slice_box(s, slices.slices[s].heights), ignored)) return false;
      return first < last;
    };
    return all_hidden(begin, middle) || all_hidden(middle, end);
  };
  const auto look = [&](uint32_t object, std::optional<uint32_t> slice,
                        const Box& box) -> std::optional<Witness> {
    glm::dvec3 point;
    for (const glm::vec3& eye : eyes)
      if (seen_from(eye, box, point) && !hidden_by_slices(eye, object))
        return Witness{object, slice, eye, point};
    return {};
  };
  const auto keep = [&](const std::optional<Witness>& witness) {
    if (witness) witnesses.push_back(*witness);
  };
  for (uint32_t o = 0; o < objects_.size(); ++o) {
    const uint32_t begin = slices.object_slice_begin[o], end = slices.object_slice_begin[o + 1];
    if (answer.occlusion.visible[o] == 0) {
      keep(look(o, {}, objects_[o]));
      continue;
    }
    for (uint32_t s = begin; s < end; ++s)
      if (const uint32_t height = answer.occlusion.occluded[s]; height > 0)
        keep(look(o, s, slice_box(s, height)));
  }
  return witnesses;
}

std::vector<CellReference::Part> CellReference::parts(uint32_t cell) const {
  const Box& box = input_.city.cells[cell];
  const Settings& settings = input_.settings;
  const int count = settings.occlusion.subdivide;
  const glm::dvec3 half_extent_m = part_half_extent(settings, size_class_of(settings, box), count);
  const std::vector<glm::dvec3>& windows_m = input_.occluders.half_extents_m();
  const auto window = std::find_if(windows_m.begin(), windows_m.end(), [&](const glm::dvec3& w) {
    return glm::all(glm::greaterThanEqual(w, half_extent_m));
  });  // the smallest comes first
  if (window == windows_m.end())
    throw Error(ExitStatus::defect, "occlusion: there are no occluders for the smallest parts");
  std::vector<Part> all;
  const float margin_m = input_.city.navigation.free.leaf_size_m;
  for (const Box& part : parts_of(box, count)) {
    const Box eyes = navigable_part(input_.city.navigation.free, part, margin_m);
    if (!eyes.empty()) all.push_back({eyes.center(), half_extent_m, &occluders_[window - windows_m.begin()]});
  }
  return all;
}

Occlusion CellReference::ideal(uint32_t cell) const {
  const std::vector<Part> all = parts(cell);
  const auto hidden = [&](const Box& box) {
    return box.empty() || std::all_of(all.begin(), all.end(), [&](const Part& part) {
             const glm::dvec3 center = 0.5 * (glm::dvec3(box.lower) + glm::dvec3(box.upper));
             const glm::dvec3 half = glm::max(
                 0.5 * (glm::dvec3(box.upper) - glm::dvec3(box.lower)) - part.half_extent_m, glm::dvec3(0));
             return !any_of_lattice(center - half, center + half, 5, [&](const glm::dvec3& point) {
               return !part.occluders->meet(part.center, point);
             });
           });
  };
  Occlusion occlusion;
  const SliceBoxes& slices = input_.slices;
  for (uint32_t o = 0; o < objects_.size(); ++o) {
    const bool all_hidden = hidden(objects_[o]);
    occlusion.visible.push_back(all_hidden ? 0 : 1);
    for (uint32_t s = slices.object_slice_begin[o]; s < slices.object_slice_begin[o + 1]; ++s) {
      const VerticalSlice& slice = slices.slices[s];
      uint32_t height = all_hidden ? slice.heights : 0;
      while (height < slice.heights && hidden(slices.boxes[slice.first_box + height])) ++height;
      occlusion.occluded.push_back(height);
    }
  }
  return occlusion;
}

}  // namespace veduta::reference
