#include "worker/zoom.h"

#include <algorithm>
#include <optional>

#include "worker/zoom_state.h"

namespace veduta {

ZoomOccluders* Zoom::State::occluders_for(const glm::dvec3& half_extent_m) {
  const auto smallest = smallest_window(city_occluders.half_extents_m(), half_extent_m);
  if (!smallest || city_occluders.windows()[*smallest].rings.empty()) return nullptr;
  const auto known = occluders.find(*smallest);
  if (known != occluders.end()) return &known->second;
  const OccluderMesh mesh = city_occluders.mesh(city_occluders.windows()[*smallest].rings.front());
  return &occluders.try_emplace(*smallest, mesh).first->second;
}

void Zoom::State::see_all(uint32_t object) {
  occlusion.visible[object] = all_seen[object] = 1;
  std::fill(occlusion.occluded.begin() + slices.object_slice_begin[object],
            occlusion.occluded.begin() + slices.object_slice_begin[object + 1], 0u);
}

/// A box within what the view was zoomed onto.
uint32_t Zoom::State::ask(const ZoomView& view, const Box& box) {
  ++counters.boxes;
  const Box fat = view.fattened(box);
  // Clipped at the near plane, a box would have a hole there.
  if (view.depths_m(fat).x < ZoomView::near_m) return visible_unasked;
  return renderer.ask(fat);
}

void Zoom::State::collect() {
  stage(counters.read_back_ms, [&] { renderer.collect(); });
  ++counters.read_backs;
}

bool Zoom::State::shows(uint32_t question) const {
  return question == visible_unasked || (question != hidden_unasked && renderer.shows(question));
}

/// Algorithm 4.1, second half, for as many candidates as there are pictures.
void Zoom::State::test_objects(std::span<const uint32_t> objects, const glm::vec3& eye,
                               ZoomOccluders* shrunk) {
  batch.clear();
  for (const uint32_t object : objects) {
    const std::optional<ZoomView> view = zoom_onto(object_boxes[object], eye);
    if (!view) {
      ++counters.boxes;
      see_all(object);
      continue;
    }
    const auto picture = static_cast<int>(batch.size());
    batch.push_back({object, picture, *view, visible_unasked});
    Tested& tested = batch.back();
    stage(counters.occluders_ms, [&] {
      // What begins behind the box hides nothing of it.
      counters.occluder_triangles +=
          renderer.draw(picture, *view, shrunk, view->depths_m(object_boxes[object]).y);
    });
    stage(counters.boxes_ms, [&] {
      renderer.look_at(picture, *view);
      tested.question = ask(*view, object_boxes[object]);
    });
  }
  collect();
  std::erase_if(batch, [&](const Tested& tested) { return !shows(tested.question); });
  questions.clear();
  stage(counters.slices_ms, [&] {
    for (const Tested& tested : batch) {
      occlusion.visible[tested.object] = 1;
      renderer.look_at(tested.picture, tested.view);
      ask_slices(tested.object, tested.view);
    }
  });
  collect();
  lower_occluded();
}

/// Algorithm 4.2, first half: for each vertical slice, its boxes from the lowest z-slice upwards. Not those
/// that an earlier part saw already.
void Zoom::State::ask_slices(uint32_t object, const ZoomView& view) {
  for (uint32_t s = slices.object_slice_begin[object]; s < slices.object_slice_begin[object + 1]; ++s) {
    for (uint32_t h = 0; h < occlusion.occluded[s]; ++h) {
      const Box& box = slices.boxes[slices.slices[s].first_box + h];
      if (box.empty()) {
        questions.push_back(hidden_unasked);
      } else if (h > 0 && box == slices.boxes[slices.slices[s].first_box + h - 1]) {
        questions.push_back(questions.back());
      } else {
        questions.push_back(ask(view, box));
      }
    }
  }
}

/// Algorithm 4.2, second half: in each slice, the first box that shows ends what is hidden.
void Zoom::State::lower_occluded() {
  size_t first = 0;
  for (const Tested& tested : batch) {
    bool seen = true;
    for (uint32_t s = slices.object_slice_begin[tested.object];
         s < slices.object_slice_begin[tested.object + 1]; ++s) {
      uint32_t& occluded = occlusion.occluded[s];
      const uint32_t asked = occluded;
      for (uint32_t h = 0; h < asked; ++h) {
        if (!shows(questions[first + h])) continue;
        occluded = h;
        break;
      }
      first += asked;
      seen = seen && occluded == 0;
    }
    all_seen[tested.object] = seen ? 1 : 0;
  }
}

Zoom::Zoom(const std::vector<Box>& object_boxes, const SliceBoxes& slices, ClusteredOccluders occluders)
    : state_(std::make_unique<State>(object_boxes, slices, std::move(occluders))) {
  begin_cell();
}

Zoom::~Zoom() = default;

void Zoom::begin_cell() {
  State& s = *state_;
  s.occlusion.visible.assign(s.object_boxes.size(), 0);
  s.occlusion.occluded.clear();
  for (const VerticalSlice& slice : s.slices.slices) s.occlusion.occluded.push_back(slice.heights);
  s.all_seen.assign(s.object_boxes.size(), 0);
}

void Zoom::add_part(const glm::vec3& center, const glm::dvec3& half_extent_m) {
  State& s = *state_;
  OcclusionCounters& c = s.counters;
  const double began = State::now_ms();
  const auto in_stages = [&] { return c.occluders_ms + c.boxes_ms + c.slices_ms + c.read_back_ms; };
  const double stages_before = in_stages();
  {
    ZoomOccluders* shrunk = s.occluders_for(half_extent_m);
    const ZoomRenderer::Session session(s.renderer);
    s.find_candidates(center, shrunk);
    for (size_t first = 0; first < s.candidates.size(); first += ZoomRenderer::pictures) {
      const size_t count = std::min<size_t>(ZoomRenderer::pictures, s.candidates.size() - first);
      s.test_objects({&s.candidates[first], count}, center, shrunk);
    }
  }
  ++c.parts;
  c.queries = s.renderer.queries();
  if (s.measured) c.host_ms += State::now_ms() - began - (in_stages() - stages_before);
}

const Occlusion& Zoom::finish_cell() const {
  return state_->occlusion;
}

const OcclusionCounters& Zoom::counters() const {
  return state_->counters;
}

void Zoom::measure() {
  state_->measured = true;
}

}  // namespace veduta
