// What can certainly be seen from a cell: rays from points of it into the full model (DESIGN §4, bracket and
// refine). A lower bound of every row.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "pvs/city.h"
#include "worker/slices.h"

namespace veduta {

/// What the rays from one cell met so far.
struct Seen {
  std::vector<glm::vec3> eyes;  ///< where the rays come from
  std::vector<uint8_t> object;  ///< [N] 1: a ray met it
  std::vector<uint8_t> lowest;  ///< [vertical slices] of the triangles that a ray met in this slice, the
                                ///< lowest last z-slice (from 0): the first box (SliceBoxes) that is seen;
                                ///< the object's count of z-slices: none is
  uint32_t objects = 0;         ///< how many ones `object` has
  uint64_t rays = 0;
};

/// Looks for what can be seen. Deterministic for a city, on one machine; the answer for a cell does not
/// depend on what was asked before. Single-threaded.
class SeenSampler {
 public:
  SeenSampler(const City& city, const SliceBoxes& slices);
  ~SeenSampler();

  /// Forgets `seen`, chooses eye points where a viewer can be in the cell (corners, edges and faces of its
  /// navigable part first, then Halton points inside) and looks all round from each.
  void look(uint32_t cell, Seen& seen) const;

  /// Aims rays at objects that nobody saw so far, from the eyes of `seen`, `rays_each` at each: at points of
  /// their triangles.
  void aim(std::span<const uint32_t> objects, uint32_t rays_each, Seen& seen) const;

 private:
  struct Tracer;
  std::unique_ptr<Tracer> tracer_;
};

}  // namespace veduta
