// What a Zoom holds, and the steps it takes: zoom_blocks.cpp has those on blocks of the quadtree, zoom.cpp
// those on objects and slices.
#pragma once

#include <array>
#include <chrono>
#include <map>
#include <span>
#include <vector>

#include "worker/cube_face.h"
#include "worker/occludee_quadtree.h"
#include "worker/zoom.h"
#include "worker/zoom_renderer.h"

namespace veduta {

struct Zoom::State {
  /// In place of the number of a question.
  static constexpr uint32_t visible_unasked = UINT32_MAX, hidden_unasked = UINT32_MAX - 1;

  State(const std::vector<Box>& boxes, const SliceBoxes& s, ClusteredOccluders c)
      : object_boxes(boxes),
        slices(s),
        city_occluders(std::move(c)),
        quadtree(make_occludee_quadtree(boxes)) {}

  std::vector<Box> object_boxes;
  const SliceBoxes& slices;
  ClusteredOccluders city_occluders;
  OccludeeQuadtree quadtree;
  ZoomRenderer renderer;
  std::map<uint32_t, ZoomOccluders> occluders;  // of windows that were needed so far
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

  static double now_ms() {
    const std::chrono::duration<double, std::milli> t = std::chrono::steady_clock::now().time_since_epoch();
    return t.count();
  }
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

}  // namespace veduta
