#include "worker/cell_bracket.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>

#include "scene/error.h"
#include "worker/cell_windows.h"
#include "worker/view_cells.h"

namespace veduta {
namespace {

/// Adds the time of its life.
class Stopwatch {
 public:
  explicit Stopwatch(double& ms) : ms_(ms) {}
  ~Stopwatch() {
    ms_ += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began_).count();
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& ms_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

}  // namespace

CellBracket::CellBracket(const OcclusionInput& input, const SeenSampler& sampler,
                         const std::vector<Box>& bounds)
    : input_(input),
      slice_parts_(std::max(input.settings.occlusion.subdivide / 2, 1)),
      sampler_(sampler),
      bounds_(bounds) {}

void CellBracket::begin(uint32_t cell) {
  rays_ms_ = host_ms_ = 0;
  const Stopwatch all(host_ms_);
  const size_t objects = input_.city.scene.objects.size();
  cell_ = input_.city.cells[cell];
  result_.cell = cell;
  result_.occlusion.visible.assign(objects, 0);
  result_.occlusion.occluded.clear();
  for (const VerticalSlice& slice : input_.slices.slices) result_.occlusion.occluded.push_back(slice.heights);
  {
    const Stopwatch rays(rays_ms_);
    sampler_.look(cell, seen_);
  }
  close_enough_ = false;
  now_.clear();
  add_node(1, 0, 0, now_);
  for (Node& node : now_.nodes) {  // one, or none where no viewer can be
    node.items = static_cast<uint32_t>(objects);
    for (uint32_t o = 0; o < objects; ++o) now_.items.push_back({o, slices_begin(o)});
    now_.heights.assign(input_.slices.slices.size(), 0);
  }
  start_generation();
}

void CellBracket::start_generation() {
  asked_ = first_asked_ = 0;
  kept_.clear();
  kept_begin_.assign(1, 0);
}

/// What is hidden from a centre is hidden from every eye within the half-extents of its window, so the centre
/// may be moved to the middle of where eyes can be, and the window need hold no more than those: from inside
/// of a house, through its own near wall, hardly anything would be hidden. Eyes may stand between free space
/// and a wall, whose voxels are taken: one voxel off.
void CellBracket::add_node(int parts, int i, int j, Generation& generation) const {
  const glm::vec3 step =
      (cell_.upper - cell_.lower) / glm::vec3(static_cast<float>(parts), static_cast<float>(parts), 1);
  const glm::vec3 lower = cell_.lower + step * glm::vec3(i, j, 0);
  const Navigation& navigation = input_.city.navigation;
  const Box eyes = navigable_part(navigation.free, {lower, lower + step}, navigation.free.leaf_size_m);
  if (eyes.empty()) return;
  const auto window =
      smallest_window(input_.occluders.half_extents_m(), window_around(input_.settings, eyes));
  if (!window) throw Error(ExitStatus::defect, "occlusion: there are no occluders for parts of this size");
  Node node{parts, i, j, eyes.center(), *window, false, static_cast<uint32_t>(generation.items.size()), 0};
  node.smallest =
      parts >= input_.settings.occlusion.subdivide ||
      smallest_window(input_.occluders.half_extents_m(), glm::dvec3(0, 0, eyes.half_extent().z)) == window;
  generation.nodes.push_back(node);
}

bool CellBracket::next(QuestionBatch& batch) {
  const Stopwatch all(host_ms_);
  batch.clear();
  while (batch.parts.empty()) {
    if (asked_ == now_.nodes.size()) divide();
    if (now_.nodes.empty()) {
      finish();
      return false;
    }
    // Not all small parts at once: what some of them see, others need not be asked.
    first_asked_ = asked_;
    asked_ = std::min(asked_ + parts_at_a_time, now_.nodes.size());
    for (size_t n = first_asked_; n < asked_; ++n) ask(now_.nodes[n], batch);
    for (size_t n = first_asked_; n < asked_ && batch.parts.empty(); ++n) take_node(now_.nodes[n], {}, 0);
  }
  first_slice_answer_ = static_cast<uint32_t>(batch.objects.size());
  return true;
}

/// Does it take few pixels to ask again?
bool CellBracket::looks_small(uint32_t object, const glm::vec3& center) const {
  const Box& box = bounds_[object];
  const glm::vec3 away = glm::max(glm::max(box.lower - center, center - box.upper), glm::vec3(0));
  const glm::vec3 half = box.half_extent();
  return 2 * std::max({half.x, half.y, half.z}) < small_angle * glm::length(away);
}

/// Is it certain that the object is in the row?
bool CellBracket::certain(uint32_t object) const {
  return seen_.object[object] != 0 || result_.occlusion.visible[object] != 0;
}

void CellBracket::ask(Node& node, QuestionBatch& batch) {
  QuestionBatch::Part part;
  part.center = node.center, part.window = node.window;
  part.everywhere = node.parts == 1;
  part.first_object = static_cast<uint32_t>(batch.objects.size());
  part.first_slice = static_cast<uint32_t>(batch.slices.size());
  for (uint32_t n = node.first_item; n < node.first_item + node.items; ++n) {
    Item& item = now_.items[n];
    const bool doubtful = !certain(item.object) && !close_enough_;
    item.question = none, item.first_slice = none;
    if (doubtful) {
      item.question = static_cast<uint32_t>(batch.objects.size());
      batch.objects.push_back(item.object);
    }
    // Of what is certain, slices are asked once, or again where they look small: what looks large would have
    // most of the picture drawn for it. Of what is in doubt, wherever it may turn out to be seen. Where the
    // row is close enough, the next parts are small enough for slices, too: larger parts hide less, never
    // more.
    if (node.parts >= slice_parts_ || close_enough_ || node.smallest) ask_slices(item, batch);
  }
  part.objects = static_cast<uint32_t>(batch.objects.size()) - part.first_object;
  part.slices = static_cast<uint32_t>(batch.slices.size()) - part.first_slice;
  if (part.objects + part.slices > 0) batch.parts.push_back(part);
}

void CellBracket::ask_slices(Item& item, QuestionBatch& batch) const {
  item.first_slice = static_cast<uint32_t>(batch.slices.size());
  for (uint32_t s = slices_begin(item.object); s < slices_end(item.object); ++s) {
    const uint32_t low = now_.heights[item.heights + s - slices_begin(item.object)];
    const uint32_t high = std::min<uint32_t>(result_.occlusion.occluded[s], seen_.lowest[s]);
    batch.slices.push_back({input_.slices.slices[s].first_box, low, high,
                            item.question == none ? SliceQuestion::always : item.question});
  }
}

void CellBracket::take(std::span<const uint32_t> answers) {
  const Stopwatch all(host_ms_);
  for (size_t n = first_asked_; n < asked_; ++n) take_node(now_.nodes[n], answers, first_slice_answer_);
}

void CellBracket::take_node(const Node& node, std::span<const uint32_t> answers, uint32_t first_slice) {
  for (uint32_t n = node.first_item; n < node.first_item + node.items; ++n) {
    const Item& item = now_.items[n];
    if (item.question != none && answers[item.question] == 0) continue;  // hidden
    if (item.first_slice != none) {
      uint8_t* heights = &now_.heights[item.heights];
      const uint32_t count = slices_end(item.object) - slices_begin(item.object);
      for (uint32_t s = 0; s < count; ++s)
        heights[s] =
            static_cast<uint8_t>(std::max<uint32_t>(heights[s], answers[first_slice + item.first_slice + s]));
      if (all_hidden(item)) continue;
    }
    const bool enough = certain(item.object) && !looks_small(item.object, node.center);
    if (node.smallest || close_enough_ || (node.parts >= slice_parts_ && enough))
      settle(item);
    else
      kept_.push_back(item);
  }
  kept_begin_.push_back(static_cast<uint32_t>(kept_.size()));
}

/// Every slice along one axis is hidden to the top: so is the object, whatever its box said.
bool CellBracket::all_hidden(const Item& item) const {
  const SliceCounts& n = input_.city.slices[item.object];
  const uint8_t* heights = &now_.heights[item.heights];
  const auto full = [&](uint8_t height) { return height >= n.z; };
  return std::all_of(heights, heights + n.x, full) || std::all_of(heights + n.x, heights + n.x + n.y, full);
}

void CellBracket::settle(const Item& item) {
  const uint32_t o = item.object;
  result_.occlusion.visible[o] = 1;
  for (uint32_t s = slices_begin(o); s < slices_end(o); ++s) {
    uint32_t& occluded = result_.occlusion.occluded[s];
    occluded = std::min<uint32_t>(occluded, now_.heights[item.heights + s - slices_begin(o)]);
  }
}

void CellBracket::divide() {
  // The upper bound: what is certain, and what is in doubt.
  uint32_t upper = 0;
  in_doubt_.assign(result_.occlusion.visible.size(), 0);
  for (const Item& item : kept_) in_doubt_[item.object] = 1;
  doubtful_.clear();
  for (uint32_t o = 0; o < in_doubt_.size(); ++o) {
    if (in_doubt_[o] && !certain(o)) doubtful_.push_back(o);
    upper += in_doubt_[o] || certain(o);
  }
  if (!doubtful_.empty()) {
    const Stopwatch rays(rays_ms_);
    sampler_.aim(doubtful_, aimed_rays, seen_);
  }
  close_enough_ = upper <= input_.settings.occlusion.max_overestimate * seen_.objects;
  next_.clear();
  for (size_t n = 0; n < now_.nodes.size(); ++n) {
    const Node& node = now_.nodes[n];
    const std::span<const Item> items(kept_.data() + kept_begin_[n], kept_begin_[n + 1] - kept_begin_[n]);
    if (items.empty()) continue;
    if (close_enough_ && node.parts >= slice_parts_) {
      for (const Item& item : items) settle(item);
      continue;
    }
    for (int child = 0; child < 4; ++child) {
      const size_t before = next_.nodes.size();
      add_node(2 * node.parts, 2 * node.i + child % 2, 2 * node.j + child / 2, next_);
      if (next_.nodes.size() == before) continue;
      next_.nodes.back().items = static_cast<uint32_t>(items.size());
      for (const Item& item : items) {
        const uint32_t count = slices_end(item.object) - slices_begin(item.object);
        next_.items.push_back({item.object, static_cast<uint32_t>(next_.heights.size())});
        const auto first = now_.heights.begin() + item.heights;
        next_.heights.insert(next_.heights.end(), first, first + count);
      }
    }
  }
  std::swap(now_, next_);
  start_generation();
}

/// What rays have met is visible, whatever the occluders say: they close gaps narrower than two seeds.
void CellBracket::finish() {
  for (uint32_t o = 0; o < result_.occlusion.visible.size(); ++o) {
    if (!seen_.object[o]) continue;
    result_.occlusion.visible[o] = 1;
    for (uint32_t s = slices_begin(o); s < slices_end(o); ++s)
      result_.occlusion.occluded[s] = std::min<uint32_t>(result_.occlusion.occluded[s], seen_.lowest[s]);
  }
  result_.seen_objects = seen_.objects;
}

}  // namespace veduta
