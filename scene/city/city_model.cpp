#include "scene/city/city_model.h"

namespace veduta::city {

uint64_t Mesh::triangle_count() const {
  uint64_t count = 0;
  for (const Face& face : faces) count += face.is_quad() ? 2 : 1;
  return count;
}

uint64_t CityModel::triangle_count() const {
  std::vector<uint64_t> of_mesh;
  for (const Mesh& mesh : meshes) of_mesh.push_back(mesh.triangle_count());
  uint64_t count = 0;
  for (const Site& site : sites) count += of_mesh[site.building];
  return count;
}

}  // namespace veduta::city
