#include <algorithm>
#include <limits>

#include "worker/zoom_state.h"

namespace veduta {
namespace {

static_assert(face_count <= ZoomRenderer::pictures);

/// Does a box (relative to the eye) reach to where no section looks: below 45 degrees?
bool reaches_below(const Box& b) {
  const Box downwards{{b.lower.x, b.lower.y, -b.upper.z}, {b.upper.x, b.upper.y, -b.lower.z}};
  return nearest_depth(downwards) <= downwards.upper.z;
}

}  // namespace

/// The part of a box that reaches into a section.
uint32_t Zoom::State::ask_block(int face, const ZoomView& view, const Box& box) {
  const Box fat = view.fattened(box);
  const Box in_face = to_face(face, {fat.lower - view.eye, fat.upper - view.eye});
  const float nearest_m = nearest_depth(in_face);
  if (nearest_m > in_face.upper.z) return hidden_unasked;
  if (nearest_m < ZoomView::near_m) return visible_unasked;
  return renderer.ask(fat);
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

}  // namespace veduta
