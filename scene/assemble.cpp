#include "scene/assemble.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_map>
#include <unordered_set>

#include "scene/draft.h"
#include "scene/terrain_skirt.h"
#include "scene/text.h"
#include "scene/triangulate.h"
#include "scene/vertex_pool.h"

namespace veduta {
namespace {

constexpr uint32_t unset = std::numeric_limits<uint32_t>::max();
constexpr double largest_span_m = 2e7;  // float32 steps are 1 m there: nothing sensible is left

struct Extent {
  glm::dvec3 lower{std::numeric_limits<double>::infinity()};
  glm::dvec3 upper{-std::numeric_limits<double>::infinity()};
};

Extent extent_of(const std::vector<RawModel>& models) {
  Extent all;
  for (const RawModel& model : models) {
    if (model.ring_vertex.empty())
      throw bad_input(model.file, "whole file", "holds no surface; check what was exported");
    for (const uint32_t index : model.ring_vertex) {
      all.lower = glm::min(all.lower, model.vertices[index]);
      all.upper = glm::max(all.upper, model.vertices[index]);
    }
    const glm::dvec3 span = all.upper - all.lower;
    if (!(std::max({span.x, span.y, span.z}) <= largest_span_m))
      throw bad_input(model.file, "vertices",
                      fmt::format("the surfaces span {:.3g} x {:.3g} x {:.3g} m, more than 20,000 km; "
                                  "check the coordinates and that all files share a CRS",
                                  span.x, span.y, span.z));
  }
  return all;
}

glm::dvec3 origin_of(const Extent& extent) {
  const glm::dvec3 middle = extent.lower + 0.5 * (extent.upper - extent.lower);
  return {std::round(middle.x), std::round(middle.y), std::round(extent.lower.z)};
}

std::string place_of(const RawModel& model, const RawPatch& patch, uint64_t polygon) {
  const uint32_t line = model.polygons[polygon].line;
  return line == 0 ? patch.place : patch.place + ": line " + std::to_string(line);
}

class Assembler {
 public:
  Assembler(const glm::dvec3& origin, double lowest, const ImportOptions& options, ImportReport report)
      : origin_(origin), bottom_(static_cast<float>(lowest - origin.z)), options_(options) {
    result_.report = std::move(report);
    result_.scene.origin = {origin.x, origin.y, origin.z};
  }

  void add(const RawModel& model) {
    model_ = &model;
    scene_index_.assign(model.vertices.size(), unset);
    const size_t before = result_.scene.triangles.size();
    for (const RawObject& object : model.objects) add(object);
    if (result_.scene.triangles.size() == before)
      throw bad_input(model.file, "whole file",
                      fmt::format("none of its {} polygons gives a triangle (no area, or edges that cross "
                                  "too often); check the unit and the coordinates",
                                  model.polygons.size()));
  }

  ImportResult take() { return std::move(result_); }

 private:
  void add(const RawObject& object) {
    drafts_.clear();
    for (uint32_t i = 0; i < object.patches.size(); ++i)
      for (uint64_t p = object.patches[i].polygon_begin; p < object.patches[i].polygon_end; ++p)
        add_polygon(object, i, p);
    for (const Draft& twin : remove_duplicates(drafts_))
      drop("duplicate triangle", object, twin.patch, twin.polygon);
    if (drafts_.empty()) {
      count_dropped(result_.report, "object without triangles", object.place);
      return;
    }
    if (object.kind == Kind::terrain) {
      const std::vector<Draft> walls = terrain_skirt(drafts_, result_.scene.vertices, pool_, bottom_);
      result_.report.skirt_triangles += walls.size();
      drafts_.insert(drafts_.end(), walls.begin(), walls.end());
    }
    order_.resize(drafts_.size());
    std::iota(order_.begin(), order_.end(), 0u);
    const std::string name = unique(object.name.empty() ? kind_name(object.kind) : object.name);
    if (object.kind == Kind::terrain && options_.terrain_tile_m > 0)
      emit_tiles(name);
    else
      emit_whole(object, name);
  }

  void add_polygon(const RawObject& object, uint32_t patch, uint64_t polygon) {
    gather(polygon);
    ++result_.report.polygons;
    if (ring_end_.size() > 1) ++result_.report.polygons_with_holes;
    triangles_.clear();
    const size_t own_points = points_.size();
    const Triangulation answer = triangulate(points_, ring_end_, triangles_);
    if (answer != Triangulation::done) {
      const bool flat = answer == Triangulation::degenerate;
      drop(flat ? "degenerate polygon" : "polygon that cannot be triangulated", object, patch, polygon);
      return;
    }
    if (points_.size() > own_points)
      count_dropped(result_.report, "crossing of a polygon's edges, mended",
                    place_of(*model_, object.patches[patch], polygon));
    for (const auto& [a, b, c] : triangles_) {
      const glm::vec3 pa(points_[a]), pb(points_[b]), pc(points_[c]);
      if (degenerate(pa, pb, pc)) {
        drop("degenerate triangle", object, patch, polygon);
        continue;
      }
      const Material stated = model_->polygons[polygon].material;
      drafts_.push_back({{scene_vertex(a), scene_vertex(b), scene_vertex(c)},
                         stated == Material::unknown ? material_of(object.kind, pa, pb, pc) : stated,
                         patch,
                         polygon});
    }
  }

  void gather(uint64_t polygon) {
    points_.clear();
    ring_end_.clear();
    source_.clear();
    for (uint64_t r = model_->rings_before(polygon); r < model_->polygons[polygon].ring_end; ++r) {
      for (uint64_t i = model_->corners_before(r); i < model_->ring_end[r]; ++i) {
        source_.push_back(model_->ring_vertex[i]);
        points_.push_back(model_->vertices[source_.back()] - origin_);
      }
      ring_end_.push_back(points_.size());
    }
  }

  uint32_t scene_vertex(uint32_t corner) {
    const glm::vec3 position = glm::vec3(points_[corner]) + 0.0f;  // -0 and 0 are one place
    if (corner >= source_.size()) return pool_.index_of(position);
    uint32_t& known = scene_index_[source_[corner]];
    if (known == unset) known = pool_.index_of(position);
    return known;
  }

  void drop(const char* reason, const RawObject& object, uint32_t patch, uint64_t polygon) {
    count_dropped(result_.report, reason, place_of(*model_, object.patches[patch], polygon));
  }

  // Appends an object of the drafts [begin, end) in the order of `order_`.
  void emit(const std::string& name, Kind kind, size_t begin, size_t end) {
    Scene& scene = result_.scene;
    Object object{name, kind, scene.triangles.size(), 0};
    for (size_t i = begin; i < end; ++i) {
      scene.triangles.push_back(drafts_[order_[i]].corners);
      scene.material.push_back(drafts_[order_[i]].material);
    }
    object.triangle_end = scene.triangles.size();
    scene.objects.push_back(std::move(object));
    ++result_.report.objects_by_kind[kind_name(kind)];
  }

  void emit_whole(const RawObject& object, const std::string& name) {
    const uint64_t first = result_.scene.triangles.size();
    emit(name, object.kind, 0, drafts_.size());
    std::vector<Part>& parts = result_.scene.parts;
    const auto object_index = static_cast<uint32_t>(result_.scene.objects.size() - 1);
    const size_t parts_before = parts.size();
    for (size_t i = 0; i < drafts_.size(); ++i) {
      const std::string& part = object.patches[drafts_[i].patch].part;
      if (part.empty()) continue;
      const bool goes_on =
          parts.size() > parts_before && parts.back().triangle_end == first + i && parts.back().name == part;
      if (!goes_on) parts.push_back({part, object_index, first + i, 0});
      parts.back().triangle_end = first + i + 1;
    }
    result_.report.parts += parts.size() - parts_before;
  }

  // Tiles by row, then by column; the triangles of a tile in the file's order.
  void emit_tiles(const std::string& name) {
    const std::vector<Tile> tiles = tiles_of(drafts_, result_.scene.vertices, options_.terrain_tile_m);
    std::stable_sort(order_.begin(), order_.end(),
                     [&](uint32_t a, uint32_t b) { return tiles[a] < tiles[b]; });
    for (size_t begin = 0, end = 0; begin < order_.size(); begin = end) {
      const Tile tile = tiles[order_[begin]];
      while (end < order_.size() && tiles[order_[end]] == tile) ++end;
      emit(unique(fmt::format("{}/{}_{}", name, tile.column, tile.row)), Kind::terrain, begin, end);
    }
  }

  std::string unique(const std::string& name) {
    if (names_.insert(name).second) return name;
    uint64_t& last = last_suffix_.try_emplace(name, 1).first->second;
    std::string other;
    do other = fmt::format("{}#{}", name, ++last);
    while (!names_.insert(other).second);
    return other;
  }

  const glm::dvec3 origin_;
  const float bottom_;  // lowest z of the models, relative to the origin
  const ImportOptions options_;
  ImportResult result_;
  VertexPool pool_{result_.scene.vertices};
  std::unordered_set<std::string> names_;
  std::unordered_map<std::string, uint64_t> last_suffix_;

  const RawModel* model_ = nullptr;    // being added
  std::vector<uint32_t> scene_index_;  // of each of its vertices, once used
  std::vector<Draft> drafts_;          // of the object being added
  std::vector<uint32_t> order_;        // in which they are emitted
  std::vector<glm::dvec3> points_;     // of the polygon being added, relative to the origin
  std::vector<uint32_t> source_;       // their vertices in the model
  std::vector<uint64_t> ring_end_;
  std::vector<std::array<uint32_t, 3>> triangles_;
};

std::string common_crs(const std::vector<RawModel>& models) {
  const RawModel* first = nullptr;
  for (const RawModel& model : models) {
    if (model.crs.empty()) continue;
    if (first == nullptr) first = &model;
    if (model.crs != first->crs)
      throw bad_input(
          model.file, "metadata/referenceSystem",
          fmt::format("is {}, but {} is in {}; bring both into one CRS", model.crs, first->file, first->crs));
  }
  return first == nullptr ? "" : first->crs;
}

}  // namespace

ImportResult assemble(const std::vector<RawModel>& models, const ImportOptions& options,
                      ImportReport report) {
  const std::string crs = common_crs(models);
  const Extent extent = extent_of(models);
  Assembler assembler(origin_of(extent), extent.lower.z, options, std::move(report));
  for (const RawModel& model : models) assembler.add(model);
  ImportResult result = assembler.take();
  result.scene.crs = crs;
  return result;
}

}  // namespace veduta
