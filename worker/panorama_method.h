// Occlusion method "panorama" (DESIGN §7).
#pragma once

#include "worker/occlusion_method.h"
#include "worker/panorama.h"

namespace veduta {

class PanoramaMethod final : public OcclusionMethod {
 public:
  explicit PanoramaMethod(const OcclusionInput& input);
  void bake(std::span<const uint32_t> cells, const std::function<void(const CellOcclusion&)>& done) override;
  const OcclusionCounters& counters() const override { return counters_; }
  void measure() override {}

 private:
  OcclusionInput input_;
  Panorama panorama_;
  OcclusionCounters counters_;
};

}  // namespace veduta
