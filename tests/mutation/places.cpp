#include "tests/mutation/places.h"

#include "scene/error.h"
#include "tests/mutation/building_blocks.h"
#include "tests/mutation/silhouette.h"

namespace veduta::mutation {
namespace {

/// Pixels are small: what is left between true and false is h (T3).
void silhouette(OcclusionCity& city) {
  city.settings.occlusion.subdivide = 1, city.settings.slices.max = 1;
  Silhouette{}.make(city);
}

/// The same with another shrinking method.
void silhouette_by(OcclusionCity& city, const std::string& shrink_method) {
  city.settings.shrink.method = shrink_method;
  silhouette(city);
}

/// Pixels are nearly as wide as rings allow, and lie so that the wall ends just beyond the middle of one.
void silhouette_coarse(OcclusionCity& city) {
  city.settings.occlusion.subdivide = 1, city.settings.slices.max = 1;
  Silhouette{.wall_x = 30, .wall_y = -8.1, .resolution = 128, .first = -200, .count = 250}.make(city);
}

/// Eyes may be beside the cell.
void silhouette_stereo(OcclusionCity& city) {
  city.settings.occlusion.subdivide = 1, city.settings.slices.max = 1;
  Silhouette{.edge_m = 2, .margin_m = 0.1}.make(city);
}

/// Too little for the bake's own rays to find, in a city whose rows are tight enough for it after the first
/// look.
void slivers(OcclusionCity& city) {
  city.settings.occlusion.subdivide = 2, city.settings.occlusion.max_overestimate = 100;
  Silhouette{.first = 1, .count = 12, .strips = true}.make(city);
}

/// Houses far away with slits between them that are narrower than a pixel, small things right behind the
/// slits, and others before the houses. The cell is small, so that shrinking by the cell opens the slits
/// little.
void slits(OcclusionCity& city) {
  city.settings.occlusion.subdivide = 1, city.settings.occlusion.resolution = 128;
  constexpr double front = 80, back = 90, width = 0.4;
  add_frame(city, {100, 60}, 0.25);
  double begin = -50;
  for (int n = 0; n <= 6; ++n) {
    const double end = n < 6 ? -45 + 17.3 * n : 50;
    const auto outwards = [](double y) { return y * back / front; };  // the cell looks through
    const std::string number = std::to_string(n);
    add_building(city, "house_" + number,
                 {{front, begin}, {back, outwards(begin)}, {back, outwards(end)}, {front, end}}, 40);
    for (int k = 0; k < 8; ++k) {
      const std::string name = number + "_" + std::to_string(k);
      const glm::dvec3 behind(94, (end + width / 2) * 94 / front, 8 + 1.5 * k);
      if (n < 6) city.add("behind_slit_" + name, behind - 0.1, behind + 0.1);
      const glm::dvec3 before(79 - 0.1 * k, begin + 6, 8 + 1.5 * k);
      city.add("before_house_" + name, before - 0.02, before + 0.02);
    }
    begin = end + width;
  }
  city.prepare();
}

/// Small things around a cell: in the open, without a thickness, right at the eyes and below them, through a
/// wall, around the end of one as seen from behind, and on two faces of the cube.
void yard(OcclusionCity& city) {
  city.settings.occlusion.subdivide = 1, city.settings.occlusion.resolution = 512;
  city.settings.slices.max = 1;
  add_frame(city, {90, 50}, 4);
  add_building(city, "east", {12, -16}, {24, 20}, 12);
  add_building(city, "north", {-16, 12}, {20, 24}, 12);
  test::Random random(1);
  for (int n = 0; n < 24; ++n) {
    const std::string number = "_" + std::to_string(n);
    const auto within = [&](const glm::dvec3& lower, const glm::dvec3& upper) {
      return glm::dvec3(random.real(lower.x, upper.x), random.real(lower.y, upper.y),
                        random.real(lower.z, upper.z));
    };
    const glm::dvec3 pebble = within({-14, -14, 0.2}, {-6, 9, 4}), below = within({1, 1, 0.01}, {3, 3, 0.02});
    city.add("pebble" + number, pebble - 0.01, pebble + 0.01);
    city.add("below" + number, below - 0.01, below + 0.01);
    // Of no thickness along one axis.
    test::Mesh flat;
    flat.object();
    flat.scene.objects.back().name = "flat" + number;
    const glm::vec3 a(within({-14, -14, 0.2}, {-6, 9, 4})), u(n % 3 == 0, n % 3 == 1, n % 3 == 2),
        v(u.z, u.x, u.y);
    flat.quad(a, a + 0.03f * u, a + 0.03f * (u + v), a + 0.03f * v);
    city.add_scene(flat.scene);
    const double z = 0.3 + 0.1 * n;
    add_pair(city, "through_wall" + number, {9, -0.2 * n, z}, {30, -0.2 * n, z});
    add_pair(city, "past_north" + number, {80, 30, z}, {-60, 30, z});
    const glm::dvec3 middle = glm::dvec3(2, 2, 1.7) + 0.02 * within({-1, -1, 0.3}, {1, 1, 1});
    city.add("at_eye" + number, middle - 0.001, middle + 0.001);
    add_pair(city, "across_edge_of_cube" + number, {34, -6, z}, {26, -40, z});
  }
  city.prepare();
}

/// Turned blocks in all directions, four by four parts in a cell, and hundreds of small things beside the
/// blocks' silhouettes.
void blocks(OcclusionCity& city) {
  test::Random random(5);
  city.add_ground(38);
  for (int j = -2; j <= 2; ++j) {
    for (int i = -2; i <= 2; ++i) {
      if (i == 0 && j == 0) continue;
      const glm::dvec2 middle(14 * i, 14 * j);
      const double angle = random.real(0, 1.6), w = random.real(3, 4.5), d = random.real(3, 4.5);
      std::vector<glm::dvec2> outline;
      for (const auto& [x, y] : {std::pair{-w, -d}, {w, -d}, {w, d}, {-w, d}})
        outline.push_back(middle + glm::dvec2(x * std::cos(angle) - y * std::sin(angle),
                                              x * std::sin(angle) + y * std::cos(angle)));
      add_building(city, "block", outline, random.real(5, 12));
    }
  }
  city.settings.cells.size_m = 4, city.settings.slices.max = 1;
  city.settings.occlusion.subdivide = 4, city.settings.occlusion.resolution = 512;
  city.cells_within(-4, -4, 4, 4);
  city.prepare();
  city.add_probes(1500, city.all_cells(), 1);
}

/// Curtains of hundreds of crumbs, and of few, behind a wall: what is seen of them, above it and past its
/// end, ends within slices, and is too little for the bake's own rays to find.
void curtains(OcclusionCity& city) {
  city.settings.occlusion.resolution = 512;
  add_frame(city, {50, 50}, 4);
  add_building(city, "wall", {12, -40}, {24, 6}, 9);
  test::Random random(2);
  for (int n = 0; n < 16; ++n) {
    city.begin((n < 4 ? "curtain_" : "few_") + std::to_string(n));
    for (int crumb = 0; crumb < (n < 4 ? 400 : 10); ++crumb) {
      const glm::dvec3 at(27 + n, random.real(-20, 20), random.real(0, 20));
      city.add_box(at, at + 0.02);
    }
  }
  city.prepare();
}

/// Slits of two and of three seeds between houses, straight on the planes between seeds, and small things
/// behind them.
void gaps(OcclusionCity& city) {
  city.settings.occlusion.subdivide = 1, city.settings.occlusion.resolution = 1024;
  const double seed = city.settings.navigation.seed_size_m;
  add_frame(city, {50, 50}, 0.25);
  double begin = -10;
  for (int n = 0; n < 4; ++n) {
    const double end = -2 + 0.5 * n + (n == 3 ? 9 : 0), width = (n % 2 == 0 ? 2 : 3) * seed;
    add_building(city, "house_" + std::to_string(n), {20, begin}, {23, end}, 8);
    begin = end + width;
    for (int k = 0; n < 3 && k < 8; ++k) {
      const glm::dvec3 behind(23.5, end + width / 2, 0.5 + 0.5 * k);
      city.add("behind_gap_" + std::to_string(n) + "_" + std::to_string(k), behind - 0.02, behind + 0.02);
    }
  }
  city.prepare();
}

const std::vector<Place>& places() {
  static const std::vector<Place> all{
      {"silhouette", silhouette},
      {"silhouette_sealed", [](OcclusionCity& city) { silhouette_by(city, "sealed"); }},
      {"silhouette_sections", [](OcclusionCity& city) { silhouette_by(city, "sections"); }},
      {"silhouette_coarse", silhouette_coarse},
      {"silhouette_stereo", silhouette_stereo},
      {"slivers", slivers, "panorama", 3'000'000},
      {"slits", slits},
      {"yard", yard},
      {"blocks", blocks, "panorama", 2'000'000},
      {"curtains",
       [](OcclusionCity& city) {
         city.settings.occlusion.subdivide = 4;
         curtains(city);
       },
       "panorama", 1'000'000},
      {"curtains_zoom",
       [](OcclusionCity& city) {
         city.settings.occlusion.subdivide = 1;
         curtains(city);
       },
       "zoom", 1'000'000},
      {"gaps", gaps},
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

}  // namespace veduta::mutation
