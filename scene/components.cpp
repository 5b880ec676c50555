#include "scene/components.h"

#include <algorithm>
#include <bit>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <unordered_map>

#include "scene/extent.h"

namespace veduta {
namespace {

constexpr uint32_t unset = std::numeric_limits<uint32_t>::max();
constexpr uint64_t few_components = 1000;

struct PlaceHash {
  size_t operator()(const glm::dvec3& p) const {
    uint64_t hash = 0x9E3779B97F4A7C15u;
    for (int axis = 0; axis < 3; ++axis) {
      hash ^= std::bit_cast<uint64_t>(p[axis] + 0.0);  // -0 and 0 are one place
      hash *= 0xff51afd7ed558ccdu;
      hash ^= hash >> 32;
    }
    return hash;
  }
};

// The vertices that corners use, those at one place as one.
class Places {
 public:
  explicit Places(const RawModel& model) : parent_(model.vertices.size(), unset) {
    std::unordered_map<glm::dvec3, uint32_t, PlaceHash> first;
    first.reserve(model.vertices.size());
    for (const uint32_t corner : model.ring_vertex)
      if (parent_[corner] == unset)
        parent_[corner] = first.try_emplace(model.vertices[corner], corner).first->second;
  }

  uint32_t root(uint32_t vertex) {
    while (parent_[vertex] != vertex) vertex = parent_[vertex] = parent_[parent_[vertex]];
    return vertex;
  }
  void join(uint32_t a, uint32_t b) { parent_[root(b)] = root(a); }

 private:
  std::vector<uint32_t> parent_;
};

uint64_t first_corner(const RawModel& model, uint64_t polygon) {
  return model.corners_before(model.rings_before(polygon));
}

// The component of each polygon, numbered in the order of their first polygons.
std::vector<uint32_t> components_of(const RawModel& model, uint32_t& count) {
  Places places(model);
  for (uint64_t p = 0; p < model.polygons.size(); ++p)  // of no corner: nothing to join
    for (uint64_t i = first_corner(model, p); i < first_corner(model, p + 1); ++i)
      places.join(model.ring_vertex[first_corner(model, p)], model.ring_vertex[i]);
  std::vector<uint32_t> number(model.vertices.size(), unset), component(model.polygons.size());
  count = 0;
  for (uint64_t p = 0; p < model.polygons.size(); ++p) {
    if (first_corner(model, p) == first_corner(model, p + 1)) {
      component[p] = count++;  // no corner, no neighbours
      continue;
    }
    uint32_t& known = number[places.root(model.ring_vertex[first_corner(model, p)])];
    if (known == unset) known = count++;
    component[p] = known;
  }
  return component;
}

// Brings the polygons of each component together.
void sort_polygons(RawModel& model, const std::vector<uint64_t>& order) {
  RawModel sorted;
  for (const uint64_t p : order) {
    for (uint64_t r = model.rings_before(p); r < model.polygons[p].ring_end; ++r) {
      sorted.ring_vertex.insert(sorted.ring_vertex.end(),
                                model.ring_vertex.begin() + static_cast<ptrdiff_t>(model.corners_before(r)),
                                model.ring_vertex.begin() + static_cast<ptrdiff_t>(model.ring_end[r]));
      sorted.ring_end.push_back(sorted.ring_vertex.size());
    }
    sorted.polygons.push_back(model.polygons[p]);
    sorted.polygons.back().ring_end = sorted.ring_end.size();
  }
  model.ring_vertex = std::move(sorted.ring_vertex);
  model.ring_end = std::move(sorted.ring_end);
  model.polygons = std::move(sorted.polygons);
}

bool may_be_taken_apart(const RawModel& model) {
  if (model.objects.size() != 1 || model.objects[0].patches.size() != 1) return false;
  const RawObject& object = model.objects[0];
  return (object.kind == Kind::building || object.kind == Kind::other) &&
         object.placement == RawObject::unplaced && object.patches[0].polygon_begin == 0 &&
         object.patches[0].polygon_end == model.polygons.size() && !model.polygons.empty();
}

// Twice the area, along the normal. Newell's method: corners need not be in a plane.
glm::dvec3 normal_of(const RawModel& model, uint64_t polygon) {
  const uint64_t ring = model.rings_before(polygon);
  const uint64_t begin = model.corners_before(ring), end = model.ring_end[ring];
  glm::dvec3 sum(0);
  for (uint64_t i = begin; i < end; ++i) {
    const glm::dvec3& origin = model.vertices[model.ring_vertex[begin]];
    const glm::dvec3 a = model.vertices[model.ring_vertex[i]] - origin;
    const glm::dvec3 b = model.vertices[model.ring_vertex[i + 1 < end ? i + 1 : begin]] - origin;
    sum += glm::cross(a, b);
  }
  return sum;
}

// A surface without a wall or an overhang, more than half as wide and as deep as the model, and nothing lies
// below it.
bool is_ground(const RawModel& model, const RawObject& object, const Extent& all) {
  constexpr double below_m = 0.5, least_cosine = 0.5;
  const Extent own = own_extent(model, object);
  if (own.lower.z > all.lower.z + below_m || 2 * (own.upper.x - own.lower.x) < all.upper.x - all.lower.x ||
      2 * (own.upper.y - own.lower.y) < all.upper.y - all.lower.y)
    return false;
  for (const RawPatch& patch : object.patches)
    for (uint64_t p = patch.polygon_begin; p < patch.polygon_end; ++p) {
      const glm::dvec3 normal = normal_of(model, p);
      if (normal.z < least_cosine * glm::length(normal)) return false;
    }
  return true;
}

}  // namespace

void take_apart(RawModel& model) {
  if (!may_be_taken_apart(model)) return;
  uint32_t count = 0;
  const std::vector<uint32_t> component = components_of(model, count);
  if (count == 1 || (count > few_components && model.polygons.size() < 2 * uint64_t{count})) return;
  std::vector<uint64_t> order(model.polygons.size());
  std::iota(order.begin(), order.end(), uint64_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](uint64_t a, uint64_t b) { return component[a] < component[b]; });
  sort_polygons(model, order);
  const Extent all = own_extent(model, model.objects[0]);
  const RawObject whole = std::move(model.objects[0]);
  model.objects.assign(count, {});
  uint64_t polygon = 0;
  for (uint32_t i = 0; i < count; ++i) {
    RawObject& object = model.objects[i];
    object = {whole.name + "/" + std::to_string(i + 1), whole.kind, whole.place, {}, RawObject::unplaced};
    RawPatch patch = whole.patches[0];
    patch.polygon_begin = polygon;
    while (polygon < order.size() && component[order[polygon]] == i) ++polygon;
    patch.polygon_end = polygon;
    object.patches.push_back(std::move(patch));
    if (is_ground(model, object, all)) object.kind = Kind::terrain;
  }
}

}  // namespace veduta
