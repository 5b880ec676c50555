// Baking cells: the panorama of each part, united, and turned into a row.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gl/egl_context.h"
#include "pvs/city.h"
#include "pvs/shard.h"
#include "worker/occlusion_method.h"
#include "worker/settings.h"
#include "worker/three_bytes.h"

namespace veduta {

class Baker {
 public:
  /// Makes a GL context on the chosen device and loads the city into it.
  Baker(City city, const ClusteredOccluders& occluders, const Settings& settings, const std::string& gpu);

  uint32_t cell_count() const { return static_cast<uint32_t>(city_.cells.size()); }
  std::string renderer() const { return context_.renderer(); }
  const City& city() const { return city_; }

  /// The rows of cells, handed out in their order; the same whatever was baked before.
  void bake(std::span<const uint32_t> cells, const std::function<void(const CellRecord&)>& done);

 private:
  City city_;
  Settings settings_;
  EglContext context_;
  TriangleCounts counts_;
  SliceBoxes slice_boxes_;
  std::unique_ptr<OcclusionMethod> method_;
};

}  // namespace veduta
