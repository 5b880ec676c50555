#include "export/drawn_object.h"

#include "pvs/vertex_numbers.h"

namespace veduta {

DrawnObject drawn_of(City&& city, const PvsEntry& entry) {
  DrawnObject drawn{entry, {}, {}, {}};
  const Scene& scene = city.scene;
  for (size_t t = 0; t < scene.triangles.size(); ++t) {
    if (!draws(entry.index, city.triangle_slices[t])) continue;
    drawn.triangles.push_back(scene.triangles[t]);
    drawn.material.push_back(scene.material[t]);
  }
  for (const VertexRun& run : number_from_zero(drawn.triangles)) {
    const auto first = scene.vertices.begin() + static_cast<ptrdiff_t>(run.first);
    drawn.vertices.insert(drawn.vertices.end(), first, first + static_cast<ptrdiff_t>(run.count));
  }
  return drawn;
}

void visit_drawn(const PvsStream& stream, const PvsRow& row,
                 const std::function<void(const DrawnObject&)>& visit) {
  for (const PvsEntry& entry : row) {
    const DrawnObject drawn = drawn_of(stream.read_objects(entry.object, entry.object + 1), entry);
    if (!drawn.triangles.empty()) visit(drawn);
  }
}

}  // namespace veduta
