#include "scene/writers/written_city.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <map>
#include <tuple>

#include "scene/names.h"
#include "scene/text.h"
#include "scene/triangulate.h"

namespace veduta::city {
namespace {

struct Extent {
  glm::dvec3 lower{std::numeric_limits<double>::infinity()};
  glm::dvec3 upper{-std::numeric_limits<double>::infinity()};
};

Extent extent_of(const std::vector<WrittenObject>& objects) {
  return tbb::parallel_reduce(
      tbb::blocked_range<size_t>(0, objects.size()), Extent{},
      [&](const tbb::blocked_range<size_t>& range, Extent extent) {
        for (size_t i = range.begin(); i < range.end(); ++i)
          for (const glm::dvec3& v : objects[i].mesh->vertices) {
            const glm::dvec3 p = objects[i].place(v);
            extent.lower = glm::min(extent.lower, p);
            extent.upper = glm::max(extent.upper, p);
          }
        return extent;
      },
      [](const Extent& a, const Extent& b) {
        return Extent{glm::min(a.lower, b.lower), glm::max(a.upper, b.upper)};
      });
}

/// Polygons become triangles: OBJ and DXF know no holes, and CityJSON's terrain is of triangles.
class GroundMesh {
 public:
  explicit GroundMesh(Mesh& mesh) : mesh_(mesh) {}

  void add(const GroundPolygon& polygon, uint16_t layer, size_t number) {
    std::vector<glm::dvec3> points;
    std::vector<uint64_t> ring_end;
    for (const std::vector<glm::dvec3>& ring : polygon.rings) {
      points.insert(points.end(), ring.begin(), ring.end());
      ring_end.push_back(points.size());
    }
    std::vector<std::array<uint32_t, 3>> triangles;
    if (triangulate(points, ring_end, triangles) != Triangulation::done)
      throw bad_input("city", "ground polygon " + std::to_string(number),
                      "has no area, or edges that cross; mend the plan");
    for (const auto& [a, b, c] : triangles) {
      const uint32_t last = vertex(points[c]);
      mesh_.faces.push_back({{vertex(points[a]), vertex(points[b]), last, last}, layer});
    }
  }

 private:
  uint32_t vertex(const glm::dvec3& p) {
    const auto [known, added] =
        number_.try_emplace({p.x, p.y, p.z}, static_cast<uint32_t>(mesh_.vertices.size()));
    if (added) mesh_.vertices.push_back(p);
    return known->second;
  }

  Mesh& mesh_;
  std::map<std::tuple<double, double, double>, uint32_t> number_;
};

uint16_t layer_number(std::vector<std::string>& layers, const std::string& name) {
  const auto found = static_cast<size_t>(std::find(layers.begin(), layers.end(), name) - layers.begin());
  if (found == layers.size()) layers.push_back(name);
  return static_cast<uint16_t>(found);
}

void add_buildings(WrittenCity& city) {
  std::vector<uint32_t> uses(city.model.meshes.size(), 0);
  for (const Site& site : city.model.sites) ++uses[site.building];
  for (const Site& site : city.model.sites)
    city.objects.push_back({site.name, Kind::building, &city.model.meshes[site.building], site.placement,
                            site.building, uses[site.building] > 1});
}

void add_ground(WrittenCity& city) {
  std::map<std::string, size_t> count;
  for (size_t i = 0; i < city.model.ground.size();) {
    const GroundPolygon& first = city.model.ground[i];
    const Kind kind = kind_of_name(first.layer);
    GroundMesh mesh(city.ground.emplace_back());
    const uint16_t layer = layer_number(city.layers, first.layer);
    do {
      mesh.add(city.model.ground[i], layer, i);
      ++i;
    } while (kind == Kind::terrain && i < city.model.ground.size() &&
             city.model.ground[i].layer == first.layer);
    const std::string name = first.layer + "_" + std::to_string(count[first.layer]++);
    city.objects.push_back({name, kind == Kind::building ? Kind::other : kind, &city.ground.back()});
  }
}

}  // namespace

bool WrittenObject::mirrored() const {
  return glm::determinant(glm::dmat3(placement)) < 0;
}

WrittenCity::WrittenCity(const CityModel& model_to_write) : model(model_to_write), layers(model.layers) {
  add_buildings(*this);
  add_ground(*this);
  if (objects.empty())
    throw bad_input("city", "sites", "the plan holds neither a building nor ground; check the plan");
  const Extent extent = extent_of(objects);
  lower = extent.lower;
  upper = extent.upper;
}

FacesByLayer::FacesByLayer(const Mesh& mesh, size_t layer_count)
    : faces(mesh.faces.size()), begin(layer_count + 1, 0) {
  for (const Face& face : mesh.faces) ++begin[face.layer + 1u];
  for (size_t layer = 0; layer < layer_count; ++layer) begin[layer + 1] += begin[layer];
  std::vector<uint32_t> next(begin.begin(), begin.end() - 1);
  for (uint32_t i = 0; i < mesh.faces.size(); ++i) faces[next[mesh.faces[i].layer]++] = i;
}

}  // namespace veduta::city
