// Occlusion method "zoom" (DESIGN §7): the thesis's own.
#pragma once

#include "worker/occlusion_method.h"
#include "worker/zoom.h"

namespace veduta {

class ZoomMethod final : public OcclusionMethod {
 public:
  explicit ZoomMethod(const OcclusionInput& input);
  void bake(std::span<const uint32_t> cells, const std::function<void(const CellOcclusion&)>& done) override;
  const OcclusionCounters& counters() const override { return counters_; }
  void measure() override { zoom_.measure(); }

 private:
  OcclusionInput input_;
  Zoom zoom_;
  OcclusionCounters counters_;
};

}  // namespace veduta
