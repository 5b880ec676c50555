#include "scene/assemble.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>

#include "scene/draft.h"
#include "scene/extent.h"
#include "scene/polygon_drafts.h"
#include "scene/terrain_skirt.h"
#include "scene/text.h"
#include "scene/unique_names.h"
#include "scene/vertex_pool.h"

namespace veduta {
namespace {

glm::dvec3 origin_of(const Extent& extent) {
  const glm::dvec3 middle = extent.lower + 0.5 * (extent.upper - extent.lower);
  return {std::round(middle.x), std::round(middle.y), std::round(extent.lower.z)};
}

// Objects with equal keys are instances of one mesh.
using MeshKey = std::tuple<uint64_t, uint64_t, size_t, Kind>;

MeshKey key_of(const RawObject& object) {
  return {object.patches.front().polygon_begin, object.patches.back().polygon_end, object.patches.size(),
          object.kind};
}

// Terrain is cut into tiles and closed below: it stands for itself.
bool may_share(const RawObject& object) {
  return object.placement != RawObject::unplaced && !object.patches.empty() && object.kind != Kind::terrain;
}

// The runs of triangles that have a part's name.
std::vector<Part> parts_of(const RawObject& object, const std::vector<Draft>& drafts) {
  std::vector<Part> parts;
  for (size_t i = 0; i < drafts.size(); ++i) {
    const std::string& name = object.patches[drafts[i].patch].part;
    if (name.empty()) continue;
    if (parts.empty() || parts.back().triangle_end != i || parts.back().name != name)
      parts.push_back({name, 0, i, i});
    parts.back().triangle_end = i + 1;
  }
  return parts;
}

class Assembler {
 public:
  Assembler(const glm::dvec3& origin, double lowest, const ImportOptions& options, ImportReport report)
      : origin_(origin), bottom_(static_cast<float>(lowest - origin.z)), options_(options) {
    result_.report = std::move(report);
    result_.scene.origin = {origin.x, origin.y, origin.z};
  }

  /// Adds the objects with triangles of their own: all but those whose mesh is there more than once.
  void add(const RawModel& model) {
    const size_t before = result_.scene.triangles.size(), shared_before = shared_.size();
    std::map<MeshKey, uint64_t> uses;
    for (const RawObject& object : model.objects)
      if (may_share(object)) ++uses[key_of(object)];
    PolygonDrafts polygons(model, origin_, pool_, result_.report);
    for (const RawObject& object : model.objects) {
      if (may_share(object) && uses[key_of(object)] > 1)
        shared_.push_back({&model, &object});
      else
        add(object, polygons.of(object, true));
    }
    if (result_.scene.triangles.size() == before && shared_.size() == shared_before)
      count_dropped(result_.report, "file without a triangle", model.file);
  }

  /// Adds the instances of all models; they come last in a scene.
  void add_instances() {
    const RawModel* model = nullptr;
    std::map<MeshKey, Shared> known;
    for (const auto& [of, object] : shared_) {
      if (of != model) known.clear();
      model = of;
      const auto [mesh, fresh] = known.try_emplace(key_of(*object));
      if (fresh) mesh->second = share(*model, *object);
      add_instance(*object, model->placements[object->placement], mesh->second);
    }
  }

  ImportResult take() { return std::move(result_); }

 private:
  struct Shared {
    uint32_t mesh = 0;
    glm::dvec3 origin{0};  // of its space, in that of the file
    std::vector<Part> parts;
  };

  void add(const RawObject& object, std::vector<Draft> drafts) {
    if (drafts.empty()) return;
    const bool terrain = object.kind == Kind::terrain;
    if (terrain) {
      const std::vector<Draft> walls = terrain_skirt(drafts, result_.scene.vertices, pool_, bottom_);
      result_.report.skirt_triangles += walls.size();
      drafts.insert(drafts.end(), walls.begin(), walls.end());
    }
    const std::string name = unique_(object.name.empty() ? kind_name(object.kind) : object.name);
    if (terrain && options_.terrain_tile_m > 0) {
      emit_tiles(name, drafts);
    } else {
      add_parts(parts_of(object, drafts), result_.scene.triangles.size());
      emit(name, object.kind, drafts.begin(), drafts.end());
    }
  }

  // A space of its own, near which float32 is fine: a block may be drawn anywhere.
  Shared share(const RawModel& model, const RawObject& object) {
    const Extent own = own_extent(model, object);
    Shared shared{0, glm::round(0.5 * (own.lower + own.upper)), {}};
    SharedMesh mesh;
    VertexPool pool(mesh.vertices);
    const std::vector<Draft> drafts =
        PolygonDrafts(model, shared.origin, pool, result_.report).of(object, false);
    shared.parts = parts_of(object, drafts);
    for (const Draft& draft : drafts) {
      mesh.triangles.push_back(draft.corners);
      mesh.material.push_back(draft.material);
    }
    shared.mesh = static_cast<uint32_t>(result_.scene.meshes.size());
    result_.scene.meshes.push_back(std::move(mesh));
    return shared;
  }

  void add_instance(const RawObject& object, const glm::dmat4x3& placement, const Shared& shared) {
    Scene& scene = result_.scene;
    const uint64_t begin = scene.triangle_count(), count = scene.meshes[shared.mesh].triangles.size();
    if (count == 0) return;  // counted when the mesh was made
    vertices_ += scene.meshes[shared.mesh].vertices.size();
    if (std::max(begin + count, scene.vertices.size() + vertices_) >= std::numeric_limits<uint32_t>::max())
      throw Error(ExitStatus::bad_input,
                  object.place +
                      ": with its instances the model has more than 4 billion triangles or vertices; "
                      "cut it into tiles");
    Instance instance{shared.mesh, placement};
    instance.scene_from_mesh[3] = placement * glm::dvec4(shared.origin, 1) - origin_;
    scene.instances.push_back(instance);
    add_parts(shared.parts, begin);
    push_object(unique_(object.name.empty() ? kind_name(object.kind) : object.name), object.kind, begin,
                count);
    ++result_.report.instances;
  }

  // Parts of the object that is added next, whose triangles are numbered from `first` on.
  void add_parts(std::vector<Part> parts, uint64_t first) {
    for (Part& part : parts) {
      part.object = static_cast<uint32_t>(result_.scene.objects.size());
      part.triangle_begin += first, part.triangle_end += first;
      result_.scene.parts.push_back(std::move(part));
      ++result_.report.parts;
    }
  }

  using DraftIterator = std::vector<Draft>::const_iterator;
  void emit(const std::string& name, Kind kind, DraftIterator begin, DraftIterator end) {
    Scene& scene = result_.scene;
    const uint64_t first = scene.triangles.size();
    for (auto draft = begin; draft != end; ++draft) {
      scene.triangles.push_back(draft->corners);
      scene.material.push_back(draft->material);
    }
    push_object(name, kind, first, scene.triangles.size() - first);
  }

  void push_object(const std::string& name, Kind kind, uint64_t begin, uint64_t count) {
    result_.scene.objects.push_back({name, kind, begin, begin + count});
    ++result_.report.objects_by_kind[kind_name(kind)];
  }

  // Tiles by row, then by column; the triangles of a tile in the file's order.
  void emit_tiles(const std::string& name, const std::vector<Draft>& drafts) {
    const std::vector<Tile> tiles = tiles_of(drafts, result_.scene.vertices, options_.terrain_tile_m);
    std::vector<uint32_t> order(drafts.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return tiles[a] < tiles[b]; });
    std::vector<Draft> sorted;
    for (const uint32_t i : order) sorted.push_back(drafts[i]);
    for (size_t begin = 0, end = 0; begin < order.size(); begin = end) {
      const Tile tile = tiles[order[begin]];
      while (end < order.size() && tiles[order[end]] == tile) ++end;
      emit(unique_(fmt::format("{}/{}_{}", name, tile.column, tile.row)), Kind::terrain,
           sorted.begin() + static_cast<ptrdiff_t>(begin), sorted.begin() + static_cast<ptrdiff_t>(end));
    }
  }

  const glm::dvec3 origin_;
  const float bottom_;  // lowest z of the models, relative to the origin
  const ImportOptions options_;
  ImportResult result_;
  VertexPool pool_{result_.scene.vertices};
  UniqueNames unique_{'#'};
  std::vector<std::pair<const RawModel*, const RawObject*>> shared_;
  uint64_t vertices_ = 0;  // of all instances
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
  assembler.add_instances();
  ImportResult result = assembler.take();
  if (result.scene.objects.empty())
    throw bad_input(models.front().file, "whole file",
                    fmt::format("none of its {} polygons gives a triangle (no area, or edges that cross "
                                "too often); check the unit and the coordinates",
                                models.front().polygons.size()));
  result.scene.crs = crs;
  return result;
}

}  // namespace veduta
