// Occlusion method "panorama" (DESIGN §7): bracketed cells, several under way at a time.
#pragma once

#include <array>

#include "worker/cell_bracket.h"
#include "worker/occlusion_method.h"
#include "worker/panorama.h"

namespace veduta {

class PanoramaMethod final : public OcclusionMethod {
 public:
  explicit PanoramaMethod(const OcclusionInput& input);
  void bake(std::span<const uint32_t> cells, const std::function<void(const CellOcclusion&)>& done) override;
  const OcclusionCounters& counters() const override { return panorama_.counters(); }
  void measure() override { panorama_.measure(), measuring_ = true; }

 private:
  /// A cell under way. While the renderer works for one, answers of another are taken.
  struct Flight {
    CellBracket bracket;
    bool asked = false;
  };
  void go_on(size_t slot);
  /// The answers of a slot to its cell, and the next questions.
  void take(size_t slot);

  std::vector<Box> bounds_;  // of the objects
  SeenSampler sampler_;
  Panorama panorama_;
  std::vector<Flight> flights_;
  QuestionBatch batch_;
  bool measuring_ = false;
};

}  // namespace veduta
