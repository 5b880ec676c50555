#include "scene/polygon_drafts.h"

#include <glm/vec4.hpp>
#include <limits>

namespace veduta {
namespace {

constexpr uint32_t unset = std::numeric_limits<uint32_t>::max();

}  // namespace

PolygonDrafts::PolygonDrafts(const RawModel& model, const glm::dvec3& origin, VertexPool& pool,
                             ImportReport& report)
    : model_(model),
      origin_(origin),
      pool_(pool),
      report_(report),
      pool_index_(model.vertices.size(), unset) {}

std::vector<Draft> PolygonDrafts::of(const RawObject& object, bool place) {
  object_ = &object;
  const glm::dmat4x3* placement =
      object.placement == RawObject::unplaced ? nullptr : &model_.placements[object.placement];
  placement_ = place ? placement : nullptr;
  turned_ = placement != nullptr && !place ? glm::dmat3(*placement) : glm::dmat3(1);
  drafts_.clear();
  for (uint32_t i = 0; i < object.patches.size(); ++i)
    for (uint64_t p = object.patches[i].polygon_begin; p < object.patches[i].polygon_end; ++p)
      add_polygon(i, p);
  for (const Draft& twin : remove_duplicates(drafts_)) drop("duplicate triangle", twin.patch, twin.polygon);
  if (drafts_.empty()) count_dropped(report_, "object without triangles", object.place);
  return std::move(drafts_);
}

void PolygonDrafts::add_polygon(uint32_t patch, uint64_t polygon) {
  gather(polygon);
  ++report_.polygons;
  if (ring_end_.size() > 1) ++report_.polygons_with_holes;
  triangles_.clear();
  const size_t own_points = points_.size();
  const Triangulation answer = triangulate(points_, ring_end_, triangles_);
  if (answer != Triangulation::done) {
    const bool flat = answer == Triangulation::degenerate;
    drop(flat ? "degenerate polygon" : "polygon that cannot be triangulated", patch, polygon);
    return;
  }
  if (points_.size() > own_points) drop("crossing of a polygon's edges, mended", patch, polygon);
  for (const auto& [a, b, c] : triangles_) {
    const glm::vec3 pa(points_[a]), pb(points_[b]), pc(points_[c]);
    if (degenerate(pa, pb, pc)) {
      drop("degenerate triangle", patch, polygon);
      continue;
    }
    Material material = model_.polygons[polygon].material;
    if (material == Material::unknown) {
      const auto turn = [&](const glm::vec3& p) { return glm::vec3(turned_ * glm::dvec3(p)); };
      material = material_of(object_->kind, turn(pa), turn(pb), turn(pc));
    }
    drafts_.push_back({{scene_vertex(a), scene_vertex(b), scene_vertex(c)}, material, patch, polygon});
  }
}

void PolygonDrafts::gather(uint64_t polygon) {
  points_.clear();
  ring_end_.clear();
  source_.clear();
  for (uint64_t r = model_.rings_before(polygon); r < model_.polygons[polygon].ring_end; ++r) {
    for (uint64_t i = model_.corners_before(r); i < model_.ring_end[r]; ++i) {
      source_.push_back(model_.ring_vertex[i]);
      const glm::dvec3& vertex = model_.vertices[source_.back()];
      points_.push_back((placement_ == nullptr ? vertex : *placement_ * glm::dvec4(vertex, 1)) - origin_);
    }
    ring_end_.push_back(points_.size());
  }
}

uint32_t PolygonDrafts::scene_vertex(uint32_t corner) {
  const glm::vec3 position = glm::vec3(points_[corner]) + 0.0f;  // -0 and 0 are one place
  if (corner >= source_.size() || placement_ != nullptr) return pool_.index_of(position);
  uint32_t& known = pool_index_[source_[corner]];
  if (known == unset) known = pool_.index_of(position);
  return known;
}

void PolygonDrafts::drop(const char* reason, uint32_t patch, uint64_t polygon) {
  count_dropped(report_, reason, place_of(model_, object_->patches[patch], polygon));
}

std::string place_of(const RawModel& model, const RawPatch& patch, uint64_t polygon) {
  const uint32_t line = model.polygons[polygon].line;
  return line == 0 ? patch.place : patch.place + ": line " + std::to_string(line);
}

}  // namespace veduta
