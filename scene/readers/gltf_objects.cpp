#include "scene/readers/gltf_objects.h"

#include <tiny_gltf.h>

#include <map>

#include "scene/readers/gltf_mesh.h"
#include "scene/readers/gltf_nodes.h"
#include "scene/text.h"

namespace veduta {
namespace {

// Objects that the smallest file may have; larger ones have as many as bytes.
constexpr uint64_t most_objects_at_least = 100'000;

class Builder {
 public:
  Builder(const tinygltf::Model& gltf, const std::string& file, const GltfPlacing& placing, uint64_t bytes,
          RawModel& model, ImportReport& report)
      : gltf_(gltf),
        file_(file),
        placing_(placing),
        model_(model),
        report_(report),
        meshes_(gltf, model, file, bytes, report),
        objects_left_(most_objects_at_least + bytes) {}

  void build() {
    std::vector<GltfOccurrence> occurrences =
        gltf_occurrences(gltf_, file_, placing_.prefix, placing_.kind, objects_left_, report_);
    std::vector<uint64_t> uses(gltf_.meshes.size());
    for (const GltfOccurrence& occurrence : occurrences) ++uses[static_cast<size_t>(occurrence.mesh)];
    for (GltfOccurrence& occurrence : occurrences) {
      occurrence.world_from_mesh = placing_.model_from_gltf * occurrence.world_from_mesh;
      const bool instance =
          placing_.instances && !placing_.batched && uses[static_cast<size_t>(occurrence.mesh)] > 1;
      if (instance) {
        add_instance(occurrence);
      } else {
        add_objects(occurrence, meshes_.add(occurrence.mesh, occurrence.world_from_mesh),
                    RawObject::unplaced);
      }
    }
  }

 private:
  void add_instance(const GltfOccurrence& occurrence) {
    const auto [runs, added] = shared_.try_emplace(occurrence.mesh);
    if (added) runs->second = meshes_.add(occurrence.mesh, glm::dmat4(1));
    model_.placements.emplace_back(occurrence.world_from_mesh);
    add_objects(occurrence, runs->second, static_cast<uint32_t>(model_.placements.size() - 1));
  }

  void add_objects(const GltfOccurrence& occurrence, const std::vector<GltfRun>& runs, uint32_t placement) {
    if (runs.size() > objects_left_)
      throw bad_input(file_, "nodes/" + std::to_string(occurrence.node),
                      "the file shows more objects than its size allows; cut it into tiles");
    objects_left_ -= runs.size();
    std::map<uint64_t, size_t> of_node;
    for (const GltfRun& run : runs) {
      const bool of_document = placing_.batched && run.feature != GltfRun::no_feature;
      const auto [object, added] =
          (of_document ? of_document_ : of_node).try_emplace(run.feature, model_.objects.size());
      if (added)
        model_.objects.push_back(of_document ? feature(run.feature, occurrence)
                                             : part_of_node(run.feature, occurrence, placement));
      model_.objects[object->second].patches.push_back({"", run.place, run.polygon_begin, run.polygon_end});
    }
  }

  RawObject part_of_node(uint64_t id, const GltfOccurrence& occurrence, uint32_t placement) const {
    const std::string place = file_ + ": nodes/" + std::to_string(occurrence.node);
    const std::string suffix = id == GltfRun::no_feature ? "" : "_" + std::to_string(id);
    return {occurrence.name + suffix, occurrence.kind, place, {}, placement};
  }

  RawObject feature(uint64_t id, const GltfOccurrence& occurrence) const {
    const std::string name = id < placing_.feature_names.size() && !placing_.feature_names[id].empty()
                                 ? placing_.feature_names[id]
                                 : placing_.prefix + "batch_" + std::to_string(id);
    return {name, stated_kind(name, occurrence.kind), file_ + ": batch " + std::to_string(id), {}};
  }

  const tinygltf::Model& gltf_;
  const std::string& file_;
  const GltfPlacing& placing_;
  RawModel& model_;
  ImportReport& report_;
  GltfMeshes meshes_;
  uint64_t objects_left_;
  std::map<int, std::vector<GltfRun>> shared_;  // meshes of instances
  std::map<uint64_t, size_t> of_document_;      // batch id -> object
};

}  // namespace

void add_gltf(const tinygltf::Model& gltf, uint64_t content_bytes, const std::string& name,
              const GltfPlacing& placing, RawModel& model, ImportReport& report) {
  uint64_t bytes = content_bytes;
  for (const tinygltf::Buffer& buffer : gltf.buffers) bytes += buffer.data.size();
  Builder(gltf, name, placing, bytes, model, report).build();
}

glm::dmat4 z_up_from_y_up() {
  return {{1, 0, 0, 0}, {0, 0, 1, 0}, {0, -1, 0, 0}, {0, 0, 0, 1}};
}

}  // namespace veduta
