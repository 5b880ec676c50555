// Finding what is hidden from all of a view-cell: the interface of the methods (DESIGN §7).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "pvs/city.h"
#include "worker/clustered_occluders.h"
#include "worker/settings.h"
#include "worker/slices.h"

namespace veduta {

/// What is hidden from all eyes of a cell.
struct Occlusion {
  std::vector<uint32_t> visible;  ///< [N] 0: the object is hidden from everywhere in the cell
  /// [vertical slices] how many of the lowest z-slices are hidden from everywhere in the cell
  std::vector<uint32_t> occluded;
};

/// The answer for one cell.
struct CellOcclusion {
  uint32_t cell = 0;
  Occlusion occlusion;
  /// Objects that rays from points of the cell met: no row can do with fewer. 0 where nobody looked.
  uint32_t seen_objects = 0;
};

/// What a city is baked from; what it refers to outlives the method.
struct OcclusionInput {
  const City& city;
  const SliceBoxes& slices;
  ClusteredOccluders occluders;
  const Settings& settings;
};

/// Bounds of the objects, [N] m: what an object as a whole is tested by.
std::vector<Box> object_boxes(const OcclusionInput& input);

/// What the work was, since the method was made. Times, in ms, are of the stages one after the other, and are
/// only taken where `OcclusionMethod::measure` was called: to tell stages apart the renderer has to finish
/// each.
struct OcclusionCounters {
  uint64_t cells = 0, parts = 0;       ///< parts: views drawn, of whatever size
  uint64_t occluder_triangles = 0;     ///< drawn
  uint64_t pixels = 0;                 ///< fragments of occluders, where measured
  uint64_t boxes = 0, queries = 0;     ///< test boxes asked for; hardware occlusion queries
  uint64_t read_backs = 0, rays = 0;   ///< times that answers were fetched; rays for the lower bound
  double occluders_ms = 0;             ///< drawing, pyramid included
  double boxes_ms = 0, slices_ms = 0;  ///< tests of objects, of slices
  double read_back_ms = 0, rays_ms = 0;
  double host_ms = 0;  ///< choosing what to draw and to test, and uniting answers
};

class OcclusionMethod {
 public:
  virtual ~OcclusionMethod() = default;

  /// Finds what is hidden from each of the cells and hands the answers out in their order. An answer is valid
  /// during the call of `done`. The same for a cell whatever was asked before or beside it.
  virtual void bake(std::span<const uint32_t> cells,
                    const std::function<void(const CellOcclusion&)>& done) = 0;

  virtual const OcclusionCounters& counters() const = 0;
  /// From now on stages are timed, which makes all of it slower.
  virtual void measure() = 0;
};

/// \param name "panorama" or "zoom". Needs a current GL 4.3 context, the same for the whole life of the
/// method. \throw Error(defect) for another name.
std::unique_ptr<OcclusionMethod> make_occlusion_method(const std::string& name, const OcclusionInput& input);

}  // namespace veduta
