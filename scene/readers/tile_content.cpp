#include "scene/readers/tile_content.h"

#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "scene/readers/b3dm.h"
#include "scene/readers/gltf_document.h"
#include "scene/readers/gltf_objects.h"

namespace veduta {

bool is_tile_format(std::string_view bytes) {
  return bytes.starts_with("b3dm") || bytes.starts_with("glTF") || bytes.starts_with('{');
}

RawModel parse_tile(const TileContent& content, const FindFile& find, ImportReport& report) {
  RawModel part;
  const std::string& name = content.file->name;
  const std::string folder = folder_of(content.path);
  const FindFile find_beside = [&](const std::string& relative) { return find(folder + relative); };

  BatchedModel tile;
  tile.gltf = content.bytes;
  GltfPlacing placing;
  placing.batched = content.bytes.starts_with("b3dm");
  if (placing.batched) tile = read_b3dm(content.bytes, name);
  const auto gltf = parse_gltf(tile.gltf, name, find_beside, report);
  placing.model_from_gltf =
      glm::translate(content.world_from_tile, tile.rtc_center + rtc_center(*gltf, name)) *
      content.z_up_from_gltf;
  placing.kind = content.kind;
  placing.prefix = content.path.substr(0, content.path.rfind('.')) + "/";
  placing.instances = content.instances;
  placing.feature_names = std::move(tile.names);
  add_gltf(*gltf, tile.gltf.size(), name, placing, part, report);
  return part;
}

std::string folder_of(const std::string& path) {
  return path.substr(0, path.rfind('/') + 1);  // npos + 1 is 0
}

void append(RawModel& model, RawModel&& part) {
  const size_t vertices = model.vertices.size(), corners = model.ring_vertex.size(),
               rings = model.ring_end.size(), polygons = model.polygons.size(),
               placements = model.placements.size();
  if (vertices + part.vertices.size() > std::numeric_limits<uint32_t>::max())
    throw bad_input(model.file, "tiles", "more than 4 billion vertices; import a part of the tiles");
  model.vertices.insert(model.vertices.end(), part.vertices.begin(), part.vertices.end());
  for (const uint32_t vertex : part.ring_vertex)
    model.ring_vertex.push_back(vertex + static_cast<uint32_t>(vertices));
  for (const uint64_t end : part.ring_end) model.ring_end.push_back(end + corners);
  for (const RawPolygon& polygon : part.polygons)
    model.polygons.push_back({polygon.ring_end + rings, polygon.line, polygon.material});
  for (RawObject& object : part.objects) {
    for (RawPatch& patch : object.patches) {
      patch.polygon_begin += polygons;
      patch.polygon_end += polygons;
    }
    if (object.placement != RawObject::unplaced) object.placement += static_cast<uint32_t>(placements);
    model.objects.push_back(std::move(object));
  }
  model.placements.insert(model.placements.end(), part.placements.begin(), part.placements.end());
  part = {};
}

}  // namespace veduta
