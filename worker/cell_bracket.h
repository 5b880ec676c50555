// Bracket and refine (DESIGN §4): which parts of a cell are asked which questions, and what the answers come
// to. No GL.
#pragma once

#include <span>
#include <vector>

#include "worker/occlusion_method.h"
#include "worker/panorama.h"
#include "worker/seen.h"

namespace veduta {

/// One cell on its way from all objects in doubt to an answer. Rays give a lower bound of what is seen;
/// questions to the whole cell give an upper one; what lies between is asked of its four parts, with the
/// occluders of the smaller size, and so on: until the bounds are as close as occlusion.max_overestimate, or
/// the parts as small as occlusion.subdivide. A part asks only for what its whole saw (PVS(part) is within
/// PVS(whole)), and where a slice was hidden from the whole it is hidden from the part.
class CellBracket {
 public:
  /// \param bounds of the objects, [N] m (object_boxes). It and `sampler` outlive this.
  CellBracket(const OcclusionInput& input, const SeenSampler& sampler, const std::vector<Box>& bounds);

  /// Begins with another cell; what was found of the last is forgotten.
  void begin(uint32_t cell);
  /// Replaces the batch by the next questions. \return false when there are none: the result is there.
  bool next(QuestionBatch& batch);
  /// The answers to the last batch, as Panorama::answers has them.
  void take(std::span<const uint32_t> answers);

  const CellOcclusion& result() const { return result_; }
  uint64_t rays() const { return seen_.rays; }
  /// What the cell took outside of the renderer: its rays, and all else.
  double rays_ms() const { return rays_ms_; }
  double host_ms() const { return host_ms_ - rays_ms_; }

 private:
  static constexpr uint32_t none = ~uint32_t{0};

  /// A part of the cell.
  struct Node {
    int parts = 1, i = 0, j = 0;  ///< part (i, j) of parts x parts
    glm::vec3 center{0};
    uint32_t window = 0;
    bool smallest = false;  ///< no smaller window would do better
    uint32_t first_item = 0, items = 0;
  };
  /// An object that a part may see.
  struct Item {
    uint32_t object = 0;
    uint32_t heights =
        0;  ///< where the occluded heights of its vertical slices are: `heights` of a generation
    uint32_t question = none;     ///< number of its question in the batch
    uint32_t first_slice = none;  ///< number of the question of the first of its slices
  };
  /// The parts of one size.
  struct Generation {
    std::vector<Node> nodes;
    std::vector<Item> items;
    std::vector<uint8_t> heights;
    void clear() { nodes.clear(), items.clear(), heights.clear(); }
  };

  void start_generation();
  void add_node(int parts, int i, int j, Generation& generation) const;
  bool looks_small(uint32_t object, const glm::vec3& center) const;
  bool certain(uint32_t object) const;
  void ask(Node& node, QuestionBatch& batch);
  void ask_slices(Item& item, QuestionBatch& batch) const;
  void take_node(const Node& node, std::span<const uint32_t> answers, uint32_t first_slice);
  bool all_hidden(const Item& item) const;
  void settle(const Item& item);
  void divide();
  void finish();

  uint32_t slices_begin(uint32_t object) const { return input_.slices.object_slice_begin[object]; }
  uint32_t slices_end(uint32_t object) const { return input_.slices.object_slice_begin[object + 1]; }

  static constexpr size_t parts_at_a_time = 16;
  static constexpr float small_angle = 0.25f;
  static constexpr uint32_t aimed_rays = 64;  // at each object in doubt, after every size of parts

  OcclusionInput input_;
  int slice_parts_;  // slices are asked of parts this small
  const SeenSampler& sampler_;
  const std::vector<Box>& bounds_;
  Box cell_;
  Seen seen_;
  bool close_enough_ = false;  // the bounds are: nothing is in doubt any more
  Generation now_, next_;
  size_t first_asked_ = 0, asked_ = 0;  // nodes of now_ that the last batch asked for
  uint32_t first_slice_answer_ = 0;
  std::vector<Item> kept_;            // items of now_ that smaller parts may do better with, by node
  std::vector<uint32_t> kept_begin_;  // [nodes so far + 1]
  std::vector<uint8_t> in_doubt_;     // [N] 1: in kept_
  std::vector<uint32_t> doubtful_;    // of those, what is not certain; ascending
  CellOcclusion result_;
  double rays_ms_ = 0, host_ms_ = 0;
};

}  // namespace veduta
