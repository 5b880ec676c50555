// What the occluders of a city entitle a method to hide from a cell: the slow, obvious kernel against which
// every OcclusionMethod is held, cell by cell. No pixels, no pyramid, no choice of what to draw: segments
// against all polygons of all occluders, in double.
//
// Two statements, one for each side of the truth.
//
// (a) What is hidden is hidden by occluders. Let a method cut a cell into parts as it likes and take for each
// part any window that holds it. It hides x from an eye when a pixel of the picture from the part's centre
// holds an occluder of a ring: by T3 the ray through x meets the occluder grown by h, and by T1 and T2 the
// segment from the eye to x then meets the occluder grown by e + h. So, whatever the parts, windows, rings
// and centres were: *every segment from an eye of the cell to a point of what is hidden meets the body of an
// occluder grown by the box [-(e + h), e + h] of its window and ring*. A segment that meets none is a
// witness against the answer. (Each grown body lies in sealed space, by the contract of Shrinker, so this
// is no weaker than it has to be: that space is all that a method knows to be solid.)
//
// (b) What could be hidden mostly is. From the centre of a part, a box taken smaller by e (T2) counts as
// hidden when no segment from the centre to a lattice of points of the taken-smaller box passes all occluders
// of the part's window: of every ring, at every distance. No method with pixels hides more from that part;
// since a lattice of points is not all points, this hides a little too much. A method that is within a share
// of it throws away little.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "worker/occlusion_method.h"
#include "worker/reference/grown_polygons.h"

namespace veduta::reference {

/// A segment from an eye of a cell to what an answer calls hidden, which no occluder stops.
struct Witness {
  uint32_t object = 0;
  std::optional<uint32_t> slice;  ///< the vertical slice, when not all of the object is hidden
  glm::dvec3 eye{0}, point{0};
};

class CellReference {
 public:
  /// \param input `occluders` are those that were shrunk, whatever the method was given. All of it
  /// outlives this.
  explicit CellReference(const OcclusionInput& input);

  /// (a) Segments from each eye to corners, middles and inner points of each box that the answer hides: of
  /// objects, and of visible objects' slices up to their occluded height. A box that is seen is no witness
  /// where all of the object's slices along one axis are hidden from that eye: so is the object, then, and
  /// what is seen of the box is empty. At most one witness a box.
  /// \param eyes points of the cell at which a viewer can be, m.
  std::vector<Witness> wrongly_hidden(const CellOcclusion& answer, std::span<const glm::vec3> eyes) const;

  /// (b) What is hidden from every one of the parts, for the smallest parts of the settings; `visible` and
  /// `occluded` as a method's. Slices of visible objects alone are looked at.
  Occlusion ideal(uint32_t cell) const;

 private:
  struct Part {
    glm::dvec3 center, half_extent_m;
    const GrownPolygons* occluders;
  };
  std::vector<Part> parts(uint32_t cell) const;

  OcclusionInput input_;
  std::vector<Box> objects_;
  GrownPolygons solid_;                   ///< occluders of all windows, grown to what they stand for
  std::vector<GrownPolygons> occluders_;  ///< [windows] as they are
};

}  // namespace veduta::reference
