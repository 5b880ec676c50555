#include "scene/instances.h"

#include <limits>
#include <unordered_map>

#include "scene/text.h"

namespace veduta {
namespace {

constexpr uint32_t unset = std::numeric_limits<uint32_t>::max();

std::span<uint32_t> corners_of(RawModel& model, const RawPatch& patch) {
  const std::span<const uint32_t> corners = veduta::corners_of(static_cast<const RawModel&>(model), patch);
  return std::span<uint32_t>(model.ring_vertex)
      .subspan(static_cast<size_t>(corners.data() - model.ring_vertex.data()), corners.size());
}

// Which vertices instances alone use, once those that others use as well are doubled.
std::vector<bool> vertices_of_instances(RawModel& model) {
  std::vector<bool> fixed(model.vertices.size()), placed(model.vertices.size());
  for (const RawObject& object : model.objects)
    if (object.placement == RawObject::unplaced)
      for (const RawPatch& patch : object.patches)
        for (const uint32_t corner : corners_of(model, patch)) fixed[corner] = true;
  std::unordered_map<uint32_t, uint32_t> twins;
  std::vector<bool> done(model.polygons.size());
  for (const RawObject& object : model.objects) {
    if (object.placement == RawObject::unplaced) continue;
    for (const RawPatch& patch : object.patches) {
      if (patch.polygon_begin == patch.polygon_end || done[patch.polygon_begin]) continue;
      done[patch.polygon_begin] = true;
      for (uint32_t& corner : corners_of(model, patch)) {
        if (fixed[corner]) {
          const auto [twin, added] = twins.try_emplace(corner, static_cast<uint32_t>(model.vertices.size()));
          if (added) {
            const glm::dvec3 vertex = model.vertices[corner];
            model.vertices.push_back(vertex);
            fixed.push_back(false);
            placed.push_back(true);
          }
          corner = twin->second;
        }
        placed[corner] = true;
      }
    }
  }
  return placed;
}

class Flattener {
 public:
  explicit Flattener(RawModel& model) : model_(model), index_(model.vertices.size(), unset) {}

  void flatten() {
    for (RawObject& object : model_.objects) {
      for (RawPatch& patch : object.patches) copy(patch, object.placement);
      object.placement = RawObject::unplaced;
    }
    model_.placements.clear();
    model_.vertices = std::move(flat_.vertices);
    model_.ring_vertex = std::move(flat_.ring_vertex);
    model_.ring_end = std::move(flat_.ring_end);
    model_.polygons = std::move(flat_.polygons);
  }

 private:
  void copy(RawPatch& patch, uint32_t placement) {
    const std::span<const uint32_t> corners = corners_of(model_, patch);
    const uint64_t begin = flat_.polygons.size();
    for (const uint32_t corner : corners) {
      if (index_[corner] == unset) {
        index_[corner] = static_cast<uint32_t>(flat_.vertices.size());
        flat_.vertices.push_back(placed(model_.vertices[corner], placement));
      }
      flat_.ring_vertex.push_back(index_[corner]);
    }
    for (const uint32_t corner : corners) index_[corner] = unset;
    if (flat_.vertices.size() >= unset)
      throw bad_input(model_.file, "instances",
                      "have more than 4 billion vertices when they are projected; set scene.crs to the "
                      "file's own CRS");
    for (uint64_t p = patch.polygon_begin; p < patch.polygon_end; ++p) {
      for (uint64_t r = model_.rings_before(p); r < model_.polygons[p].ring_end; ++r) {
        const uint64_t size = model_.ring_end[r] - model_.corners_before(r);
        flat_.ring_end.push_back((flat_.ring_end.empty() ? 0 : flat_.ring_end.back()) + size);
      }
      flat_.polygons.push_back(model_.polygons[p]);
      flat_.polygons.back().ring_end = flat_.ring_end.size();
    }
    patch.polygon_begin = begin;
    patch.polygon_end = flat_.polygons.size();
  }

  glm::dvec3 placed(const glm::dvec3& vertex, uint32_t placement) const {
    return placement == RawObject::unplaced ? vertex : model_.placements[placement] * glm::dvec4(vertex, 1);
  }

  RawModel& model_;
  RawModel flat_;
  std::vector<uint32_t> index_;  // of the model's vertices in the patch being copied
};

}  // namespace

std::span<const uint32_t> corners_of(const RawModel& model, const RawPatch& patch) {
  if (patch.polygon_begin == patch.polygon_end) return {};
  const uint64_t begin = model.corners_before(model.rings_before(patch.polygon_begin));
  const uint64_t end = model.corners_before(model.rings_before(patch.polygon_end));
  return std::span(model.ring_vertex).subspan(begin, end - begin);
}

void map_linearly(RawModel& model, const glm::dmat3& map) {
  const std::vector<bool> placed =
      model.placements.empty() ? std::vector<bool>(model.vertices.size()) : vertices_of_instances(model);
  for (size_t i = 0; i < model.vertices.size(); ++i)
    if (!placed[i]) model.vertices[i] = map * model.vertices[i];
  for (glm::dmat4x3& placement : model.placements) placement = map * placement;
}

void flatten_instances(RawModel& model) {
  Flattener(model).flatten();
}

}  // namespace veduta
