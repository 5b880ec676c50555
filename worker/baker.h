// Baking cells: the panorama of each part, united, and turned into a row.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gl/egl_context.h"
#include "pvs/city.h"
#include "pvs/shard.h"
#include "worker/panorama.h"
#include "worker/settings.h"
#include "worker/three_bytes.h"

namespace veduta {

class Baker {
 public:
  /// Makes a GL context on the chosen device and loads the city into it.
  Baker(City city, const std::vector<WindowOccluders>& occluders, const Settings& settings,
        const std::string& gpu);

  uint32_t cell_count() const { return static_cast<uint32_t>(city_.cells.size()); }
  std::string renderer() const { return context_.renderer(); }
  const City& city() const { return city_; }

  /// The row of a cell. Parts that no viewer can be in are left out; the same answer whatever was baked
  /// before.
  CellRecord bake(uint32_t cell);

 private:
  City city_;
  Settings settings_;
  EglContext context_;
  TriangleCounts counts_;
  SliceBoxes slice_boxes_;
  std::unique_ptr<Panorama> panorama_;
};

/// The parts of a cell: subdivide x subdivide boxes of its full height.
std::vector<Box> parts_of(const Box& cell, int subdivide);

}  // namespace veduta
