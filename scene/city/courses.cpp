#include "scene/city/courses.h"

#include <glm/geometric.hpp>

#include "scene/city/roof.h"

namespace veduta::city {
namespace {

// Of an edge, in depths of the band: on shorter ones the band is flush, so that mitres do not cross.
constexpr double least_edge = 4;

}  // namespace

std::vector<Band> course_bands(const RuleSet& rules, const std::vector<double>& levels_m) {
  std::vector<Band> bands;
  const size_t floors = levels_m.size() - 1;
  for (size_t floor = 0; floor < floors; ++floor) {
    const size_t level = floor == 0 ? 0 : floor + 1 == floors ? 2 : 1;
    double bottom = levels_m[floor], top = levels_m[floor + 1];
    const size_t first = bands.size();
    for (const Course& course : rules.courses) {
      if (!course.levels[level]) continue;
      Band band{static_cast<int>(floor), course.at_bottom, 0, 0, course.depth_m, course.layer};
      if (course.at_bottom) {
        band.bottom_m = bottom;
        band.top_m = bottom += course.height_m;
      } else {
        band.top_m = top;
        band.bottom_m = top -= course.height_m;
      }
      bands.push_back(band);
    }
    if (top - bottom < 0.5 * (levels_m[floor + 1] - levels_m[floor])) bands.resize(first);
  }
  return bands;
}

void add_course(MeshBuilder& mesh, const Ring& ring, const std::vector<bool>& behind_neighbour,
                const Band& band) {
  const size_t count = ring.size();
  std::vector<double> depths;
  for (size_t i = 0; i < count; ++i) {
    const double length = glm::length(ring[(i + 1) % count] - ring[i]);
    depths.push_back(behind_neighbour[i] || length < least_edge * band.depth_m ? 0 : band.depth_m);
  }
  const std::vector<OffsetCorner> corners = offset_ring(ring, depths);
  const auto upright = [&](const glm::dvec2& a, const glm::dvec2& b) {
    mesh.quad(glm::dvec3(a, band.bottom_m), glm::dvec3(b, band.bottom_m), glm::dvec3(b, band.top_m),
              glm::dvec3(a, band.top_m), band.layer);
  };
  for (size_t i = 0; i < count; ++i) {
    const size_t next = (i + 1) % count;
    const glm::dvec2 &a = ring[i], &b = ring[next], &from = corners[i].after, &to = corners[next].before;
    if (corners[i].before != corners[i].after) upright(corners[i].before, corners[i].after);
    if (!behind_neighbour[i]) {
      upright(from, to);
      continue;
    }
    // The wall is there already; a band that comes around the corner ends in its plane, before the wall's
    // ends or, at a corner that turns inwards, on the wall.
    upright(from, a);
    upright(b, to);
  }
  add_ledge(mesh, ring, corners, band.bottom_m, false, band.layer);
  add_ledge(mesh, ring, corners, band.top_m, true, band.layer);
}

}  // namespace veduta::city
