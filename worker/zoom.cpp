#include "worker/zoom.h"

#include <algorithm>
#include <chrono>
#include <glm/vector_relational.hpp>
#include <limits>
#include <map>
#include <optional>
#include <span>

#include "worker/cube_face.h"
#include "worker/occludee_quadtree.h"
#include "worker/zoom_renderer.h"

namespace veduta {
namespace {

// In place of the number of a question.
constexpr uint32_t visible_unasked = UINT32_MAX, hidden_unasked = UINT32_MAX - 1;

static_assert(face_count <= ZoomRenderer::pictures);

double now_ms() {
  const std::chrono::duration<double, std::milli> t = std::chrono::steady_clock::now().time_since_epoch();
  return t.count();
}

/// Does a box (relative to the eye) reach to where no section looks: below 45 degrees?
bool reaches_below(const Box& b) {
  const Box downwards{{b.lower.x, b.lower.y, -b.upper.z}, {b.upper.x, b.upper.y, -b.lower.z}};
  return nearest_depth(downwards) <= downwards.upper.z;
}

}  // namespace

struct Zoom::State {
  State(const std::vector<Box>& boxes, const SliceBoxes& s, const std::vector<WindowOccluders>& w)
      : object_boxes(boxes), slices(s), windows(w), quadtree(make_occludee_quadtree(boxes)) {}

  std::vector<Box> object_boxes;
  const SliceBoxes& slices;
  const std::vector<WindowOccluders>& windows;
  OccludeeQuadtree quadtree;
  ZoomRenderer renderer;
  std::map<const WindowOccluders*, ZoomOccluders> occluders;  // of windows that were needed so far
  Occlusion occlusion;
  std::vector<uint8_t> all_seen;  // [N] 1: nothing of it is hidden, further parts change nothing
  OcclusionCounters counters;
  bool measured = false;

  std::vector<uint32_t> blocks, next_blocks;  // of the level of the quadtree in work
  std::vector<uint32_t> candidates;           // objects of visible leaves
  struct Tested {
    uint32_t object;
    int picture;
    ZoomView view;
    uint32_t question;
  };
  std::vector<Tested> batch;
  std::vector<uint32_t> questions;  // of the blocks of a level, or of the heights of slices

  ZoomOccluders* occluders_for(const glm::dvec3& half_extent_m);
  void see_all(uint32_t object);
  uint32_t ask(const ZoomView& view, const Box& box);
  uint32_t ask_block(int face, const ZoomView& view, const Box& box);
  void collect();
  bool shows(uint32_t question) const;
  void find_candidates(const glm::vec3& eye, ZoomOccluders* shrunk);
  void test_level(const std::array<ZoomView, face_count>& sections);
  void test_objects(std::span<const uint32_t> objects, const glm::vec3& eye, ZoomOccluders* shrunk);
  void ask_slices(uint32_t object, const ZoomView& view);
  void lower_occluded();

  /// Adds the time of a step to a stage, where asked: waits for the renderer then.
  template <class Work>
  void stage(double& stage_ms, Work&& work) {
    if (!measured) return work();
    const double began = now_ms();
    work();
    glFinish();
    stage_ms += now_ms() - began;
  }
};

ZoomOccluders* Zoom::State::occluders_for(const glm::dvec3& half_extent_m) {
  const auto volume = [](const glm::dvec3& e) { return e.x * e.y * e.z; };
  const WindowOccluders* smallest = nullptr;
  for (const WindowOccluders& window : windows) {
    if (window.rings.empty() || glm::any(glm::lessThan(window.half_extent_m, half_extent_m))) continue;
    if (smallest == nullptr || volume(window.half_extent_m) < volume(smallest->half_extent_m))
      smallest = &window;
  }
  if (smallest == nullptr) return nullptr;
  return &occluders.try_emplace(smallest, smallest->rings.front().occluders).first->second;
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

/// The part of a box that reaches into a section.
uint32_t Zoom::State::ask_block(int face, const ZoomView& view, const Box& box) {
  const Box fat = view.fattened(box);
  const Box in_face = to_face(face, {fat.lower - view.eye, fat.upper - view.eye});
  const float nearest_m = nearest_depth(in_face);
  if (nearest_m > in_face.upper.z) return hidden_unasked;
  if (nearest_m < ZoomView::near_m) return visible_unasked;
  return renderer.ask(fat);
}

void Zoom::State::collect() {
  stage(counters.read_back_ms, [&] { renderer.collect(); });
  ++counters.read_backs;
}

bool Zoom::State::shows(uint32_t question) const {
  return question == visible_unasked || (question != hidden_unasked && renderer.shows(question));
}

/// Algorithm 4.1, first half: culls portions of the scene in the 90-degree sections, a level at a time.
void Zoom::State::find_candidates(const glm::vec3& eye, ZoomOccluders* shrunk) {
  candidates.clear();
  if (quadtree.blocks.empty()) return;
  std::array<ZoomView, face_count> sections;
  stage(counters.occluders_ms, [&] {
    for (int face = 0; face < face_count; ++face) {
      sections[face] = section(face, eye);
      counters.occluder_triangles +=
          renderer.draw(face, sections[face], shrunk, std::numeric_limits<float>::max());
    }
  });
  blocks.assign(1, 0);
  while (!blocks.empty()) test_level(sections);
}

void Zoom::State::test_level(const std::array<ZoomView, face_count>& sections) {
  questions.assign(blocks.size() * face_count, hidden_unasked);
  stage(counters.boxes_ms, [&] {
    for (int face = 0; face < face_count; ++face) {
      renderer.look_at(face, sections[face]);
      for (size_t b = 0; b < blocks.size(); ++b)
        questions[b * face_count + face] = ask_block(face, sections[face], quadtree.blocks[blocks[b]].bounds);
    }
  });
  counters.boxes += blocks.size();
  collect();
  const glm::vec3& eye = sections[0].eye;
  next_blocks.clear();
  for (size_t b = 0; b < blocks.size(); ++b) {
    const QuadtreeBlock& block = quadtree.blocks[blocks[b]];
    const auto first = questions.begin() + static_cast<std::ptrdiff_t>(b * face_count);
    if (!reaches_below({block.bounds.lower - eye, block.bounds.upper - eye}) &&
        std::none_of(first, first + face_count, [&](uint32_t question) { return shows(question); }))
      continue;
    for (uint32_t c = 0; c < block.children; ++c) next_blocks.push_back(block.first_child + c);
    if (block.children > 0) continue;
    for (uint32_t n = block.first; n < block.first + block.count; ++n) {
      if (all_seen[quadtree.objects[n]] == 0) candidates.push_back(quadtree.objects[n]);
    }
  }
  blocks.swap(next_blocks);
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

Zoom::Zoom(const std::vector<Box>& object_boxes, const SliceBoxes& slices,
           const std::vector<WindowOccluders>& windows)
    : state_(std::make_unique<State>(object_boxes, slices, windows)) {
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
  const double began = now_ms();
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
  if (s.measured) c.host_ms += now_ms() - began - (in_stages() - stages_before);
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
