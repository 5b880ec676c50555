#include "tests/mutation/silhouette.h"

#include "tests/mutation/building_blocks.h"

namespace veduta::mutation {
namespace {

/// A strip of two triangles from a to b, 10 cm high.
void add_strip(OcclusionCity& city, const std::string& name, const glm::vec3& a, const glm::vec3& b) {
  test::Mesh mesh;
  mesh.object();
  mesh.scene.objects.back().name = name;
  const glm::vec3 up(0, 0, 0.1f);
  mesh.quad(a, b, b + up, a + up);
  city.add_scene(mesh.scene);
}

}  // namespace

void Silhouette::make(test::OcclusionCity& city) const {
  city.settings.occlusion.resolution = resolution, city.settings.stereo.eye_margin_m = margin_m;
  const double u = edge_m / 16;
  add_frame(city, u * glm::dvec2(96, 60), edge_m);
  const glm::dvec2 end = u * glm::dvec2(wall_x, wall_y);
  add_building(city, "wall", end, {end.x + u * 30, u * 50}, u * 40);
  const double left = end.x + u * 36, eye = -margin_m;  // the eye that sees most is at (eye, eye)
  const double umbra = end.y + (left - end.x) * (end.y - eye) / (end.x - eye);
  for (int n = 0; n < count; ++n) {
    const std::string name = "past_by_" + std::to_string(first + n);
    const double width = u * 28;
    const glm::dvec3 a(left, umbra - 0.01 * u * (first + n), u * (0.3 + 32.0 * n / count));
    const glm::dvec3 b = a + glm::dvec3(width, width, 0);
    if (strips)
      add_strip(city, name, a, b);
    else
      add_pair(city, name, a, b);
  }
  city.prepare();
}

}  // namespace veduta::mutation
