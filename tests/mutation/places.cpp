#include "tests/mutation/places.h"

#include <algorithm>

namespace veduta::mutation {
namespace {

using test::OcclusionCity;

constexpr float lowest_m = -1;

/// Two small boxes at the ends of a long one: its bounds are what is tested, and only what is at the end that
/// looks past the silhouette is to be seen.
void add_dumbbell(OcclusionCity& city, const std::string& name, const glm::dvec3& lower,
                  const glm::dvec3& upper) {
  const double edge = std::min({0.02, upper.z - lower.z});
  city.begin(name);
  city.add_box(lower, lower + edge);
  city.add_box(upper - edge, upper);
}

/// A building over a convex outline without a floor, from the lowest height up: at the foot of a wall, where
/// floor or ground meet it, shrinking takes off up to two seeds more than it has to.
void add_building(OcclusionCity& city, const std::string& name, const std::vector<glm::dvec2>& outline,
                  double top) {
  test::Mesh mesh;
  mesh.object();
  mesh.scene.objects.back().name = name;
  for (size_t n = 0; n < outline.size(); ++n) {
    const glm::vec2 a(outline[n]), b(outline[(n + 1) % outline.size()]), first(outline[0]);
    const auto z = static_cast<float>(top);
    mesh.quad({a, lowest_m}, {b, lowest_m}, {b, z}, {a, z});
    mesh.triangle({first, z}, {a, z}, {b, z});
  }
  city.add_scene(mesh.scene);
}

/// Ground under a cell [0, edge] x [0, edge], and posts at the corners of the place: its middle is the origin
/// of what is baked, so that cells lie where they are said to.
void add_frame(OcclusionCity& city, const glm::dvec2& half, double edge) {
  city.add("ground", {-1, -1, lowest_m}, {edge + 1, edge + 1, 0});
  for (const double sign : {-1.0, 1.0})
    city.add("post", {sign * half - 0.5, lowest_m}, {sign * half + 0.5, 2});
  city.settings.cells.size_m = edge;
  city.cells_within(0, 0, edge, edge);
}

/// The end of a wall, and boxes behind it whose ends look past it by a little more each, as seen from the
/// corner of the cell that sees most of them. The boxes are wider than the cell, so that T2 leaves no room,
/// and pixels are small: what is left between true and false is h (T3).
void silhouette(OcclusionCity& city) {
  city.settings.occlusion.subdivide = 1;
  city.settings.occlusion.resolution = 1024, city.settings.slices.max = 1;
  add_frame(city, {86, 60}, 16);
  const double x = 20, y = -8;  // the edge of the wall that the cell [0, 16] x [0, 16] looks past
  add_building(city, "wall", {{x, y}, {x + 30, y}, {x + 30, 50}, {x, 50}}, 40);
  constexpr int count = 160;
  for (int n = 0; n < count; ++n) {
    const int past_cm = n - 125;
    const double left = 56, umbra = y + (left - x) * (y - 0) / (x - 0);  // from (0, 0) past (x, y)
    const double lower = umbra - 0.01 * past_cm, z = 0.3 + 0.2 * n;
    add_dumbbell(city, std::to_string(past_cm) + "_cm", {left, lower, z}, {left + 28, lower + 28, z + 0.1});
  }
  city.prepare();
}

/// Houses far away with slits between them that are narrower than a pixel, and small things right behind the
/// slits. The cell is small, so that shrinking by the cell opens the slits little.
void slits(OcclusionCity& city) {
  city.settings.occlusion.subdivide = 1;
  city.settings.occlusion.resolution = 128;
  constexpr double front = 80, back = 90, width = 0.4;
  add_frame(city, {100, 60}, 0.25);
  double begin = -50;
  for (int n = 0; n <= 6; ++n) {
    const double end = n < 6 ? -45 + 17.3 * n : 50;
    const auto outwards = [](double y) {
      return y * back / front;
    };  // slits are looked through from the cell
    add_building(city, "house_" + std::to_string(n),
                 {{front, begin}, {back, outwards(begin)}, {back, outwards(end)}, {front, end}}, 40);
    begin = end + width;
    for (int k = 0; n < 6 && k < 8; ++k) {
      const double y = (end + width / 2) * 94 / front, z = 8 + 1.5 * k;
      city.add("behind_slit_" + std::to_string(n) + "_" + std::to_string(k), {94, y - 0.1, z},
               {94.2, y + 0.1, z + 0.2});
    }
  }
  city.prepare();
}

const std::vector<Place>& places() {
  static const std::vector<Place> all{
      {"silhouette", silhouette},
      {"slits", slits},
  };
  return all;
}

}  // namespace

Place place(const std::string& name) {
  for (const Place& p : places()) {
    if (p.name == name) return p;
  }
  throw Error(ExitStatus::usage, "there is no place '" + name + "'");
}

std::vector<std::string> place_names() {
  std::vector<std::string> names;
  for (const Place& p : places()) names.push_back(p.name);
  return names;
}

}  // namespace veduta::mutation
