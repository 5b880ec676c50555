#include "worker/panorama_method.h"

namespace veduta {

PanoramaMethod::PanoramaMethod(const OcclusionInput& input)
    : bounds_(object_boxes(input)),
      sampler_(input.city, input.slices),
      panorama_(bounds_, input.slices, input.occluders) {
  for (int slot = 0; slot < Panorama::slots; ++slot)
    flights_.push_back({CellBracket(input, sampler_, bounds_), false});
}

void PanoramaMethod::go_on(size_t slot) {
  Flight& flight = flights_[slot];
  flight.asked = flight.bracket.next(batch_);
  if (flight.asked) panorama_.ask(batch_, static_cast<int>(slot));
}

void PanoramaMethod::take(size_t slot) {
  const std::vector<uint32_t>& answers = panorama_.answers(static_cast<int>(slot));
  flights_[slot].bracket.take(answers);
  go_on(slot);
}

void PanoramaMethod::bake(std::span<const uint32_t> cells,
                          const std::function<void(const CellOcclusion&)>& done) {
  // Cells [emitted, begun) are under way, cell n in slot n % slots; answers go out in their order.
  size_t begun = 0, emitted = 0;
  const auto begin = [&](size_t slot) {
    flights_[slot].bracket.begin(cells[begun++]);
    go_on(slot);
  };
  while (emitted < cells.size()) {
    while (begun < cells.size() && begun - emitted < flights_.size()) begin(begun % flights_.size());
    for (size_t n = emitted; n < begun; ++n) {
      if (flights_[n % flights_.size()].asked) take(n % flights_.size());
    }
    while (emitted < begun && !flights_[emitted % flights_.size()].asked) {
      CellBracket& bracket = flights_[emitted % flights_.size()].bracket;
      OcclusionCounters& counters = panorama_.counters();
      counters.cells += 1, counters.rays += bracket.rays();
      if (measuring_) counters.rays_ms += bracket.rays_ms(), counters.host_ms += bracket.host_ms();
      done(bracket.result());
      ++emitted;
    }
  }
}

}  // namespace veduta
