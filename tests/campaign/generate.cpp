#include "tests/campaign/generate.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/campaign/plots.h"

namespace veduta::campaign {
namespace {

constexpr double eye_height_m = 1.7;

Settings random_settings(Dice& dice) {
  Settings s;
  s.scene.terrain_tile_m = dice.pick({10.0, 30.0, 64.0, 64.0});
  s.navigation.seed_size_m = dice.chance(0.7) ? dice.pick({0.0625, 0.125, 0.25, 0.5}) : dice.scale(0.06, 0.5);
  s.navigation.eye_height_m = eye_height_m;
  s.cells.size_m = dice.chance(0.7) ? dice.pick({0.5, 1.0, 2.0, 4.0}) : dice.scale(0.3, 8);
  s.cells.height_m = dice.pick({0.5, 1.0, 1.0, 2.0});
  if (dice.chance(0.25)) {
    s.navigation.mode = "fly";
    s.navigation.fly_lowest_m = dice.real(0.2, 6);
    s.cells.height_m = dice.pick({1.0, 0.5}) * s.cells.size_m;
    s.navigation.fly_highest_m = s.navigation.fly_lowest_m + dice.real(1, 3) * s.cells.height_m;
    s.cells.largest = dice.pick({1, 2});
  }
  s.slices.max = dice.pick({1, 2, 4, 8, 8, 16});
  s.shrink.method = dice.pick<const char*>({"planes", "planes", "planes", "sections", "sealed", "vertex"});
  s.occlusion.method = dice.chance(0.1) ? "zoom" : "panorama";
  s.occlusion.resolution = dice.pick({64, 128, 256, 512});
  s.occlusion.subdivide = dice.pick({1, 2, 4});
  s.occlusion.max_overestimate = dice.pick({1.0, 1.0, 1.0, 1.5, 3.0});
  // Sections take minutes where seeds are fine, or parts of a cell not much larger than a seed.
  const double part_m = s.cells.size_m / s.occlusion.subdivide;
  if (s.shrink.method == "sections" &&
      (s.navigation.seed_size_m < 0.1 || part_m < 4 * s.navigation.seed_size_m))
    s.shrink.method = "planes";
  if (s.occlusion.method == "zoom")  // slow
    s.occlusion.subdivide = std::min(s.occlusion.subdivide, 2);
  s.stereo.eye_margin_m = dice.pick({0.0, 0.0325, 0.0325, 0.2});
  return s;
}

/// How far from the cell things stand mostly: fine seeds are many.
double spread_m(const Settings& settings) {
  return std::clamp(240 * settings.navigation.seed_size_m, 15.0, 30.0);
}

/// Level, uneven or none. \return the terrain to stand on, for heights.
Piece add_ground(CampaignScene& scene, Dice& dice) {
  Piece piece;
  const double edge = 2.2 * spread_m(scene.settings) + dice.real(8, 40);
  piece.foot = {0, 0, 0}, piece.size = {edge, edge, 0}, piece.bumps = dice.bits();
  const double kind = dice.real(0, 1);
  if (kind < 0.1) return piece;
  if (kind < 0.3) {
    Piece slab = piece;
    slab.size.z = 1, slab.foot.z = -1;
    scene.things.push_back({"ground", {slab}});
    return piece;
  }
  piece.shape = Shape::terrain;
  if (kind > 0.6) piece.size.z = dice.scale(0.1, 5);
  scene.things.push_back({"ground", {piece}});
  return piece;
}

/// A point of what stands there: half of the times a corner, else one within it.
glm::dvec3 point_of(const std::vector<Piece>& pieces, Dice& dice) {
  const Piece& piece = pieces[static_cast<size_t>(dice.whole(0, static_cast<int>(pieces.size()) - 1))];
  const std::vector<Polygon> all = faces(piece);
  const auto corner = [&] {
    const Polygon& face = all[static_cast<size_t>(dice.whole(0, static_cast<int>(all.size()) - 1))];
    return face[static_cast<size_t>(dice.whole(0, static_cast<int>(face.size()) - 1))];
  };
  const glm::dvec3 one = corner();
  return dice.chance(0.5) ? one : glm::mix(one, corner(), dice.real(0, 1));
}

/// Small things beyond what stands there as an eye sees it: some hidden and some not by a little, where an
/// answer that is wrong by a little shows.
void add_occludees(CampaignScene& scene, Dice& dice) {
  std::vector<Piece> pieces;
  for (const Thing& thing : scene.things) {
    for (const Piece& piece : thing.pieces)
      if (piece.shape != Shape::terrain) pieces.push_back(piece);
  }
  if (pieces.empty()) return;
  const int count = dice.whole(6, 24);
  for (int n = 0; n < count; ++n) {
    const glm::dvec3 eye(dice.real(scene.lower.x, scene.upper.x), dice.real(scene.lower.y, scene.upper.y),
                         eye_height_m + dice.real(-0.3, 0.3));
    const glm::dvec3 off(dice.real(-1, 1), dice.real(-1, 1), dice.real(-1, 1));
    Piece piece;
    piece.foot = eye + dice.real(1.02, 2) * (point_of(pieces, dice) - eye) + off * off * off * 2.0;
    piece.foot.z = std::max(piece.foot.z, 0.0);
    if (glm::length(glm::dvec2(piece.foot)) < 2 * scene.settings.cells.size_m) continue;
    // A post, a wire, a plate or a crumb.
    for (int axis = 0; axis < 3; ++axis) piece.size[axis] = dice.scale(0.004, dice.chance(0.4) ? 6 : 0.6);
    piece.turn = dice.chance(0.5) ? 0 : dice.angle();
    piece.shape = dice.pick({Shape::box, Shape::box, Shape::spike, Shape::sheet});
    scene.things.push_back({"small", {piece}});
  }
}

void add_quirks(CampaignScene& scene, Dice& dice) {
  const bool often = dice.chance(0.15);
  for (Thing& thing : scene.things) {
    for (Piece& piece : thing.pieces) {
      if (piece.shape == Shape::terrain) continue;
      const double share = often ? 0.3 : 0.02;
      piece.inverted = dice.chance(share);
      piece.twice = dice.chance(share);
      piece.open_top = piece.open_top || dice.chance(0.3 * share);
    }
  }
}

/// Numbers as people draw them: walls in one plane, things that touch.
void snap(CampaignScene& scene, Dice& dice) {
  const double grid = dice.pick(
      {scene.settings.navigation.seed_size_m, 4 * scene.settings.navigation.seed_size_m, 0.25, 0.5});
  const double quarter = 0.5 * std::numbers::pi;
  for (Thing& thing : scene.things) {
    for (Piece& piece : thing.pieces) {
      if (piece.shape == Shape::terrain) continue;
      // Lower corners and sizes, so that both sides come to lie on the grid.
      for (int axis = 0; axis < 3; ++axis) {
        const double before = axis < 2 ? 0.5 * piece.size[axis] : 0;
        const double lower = grid * std::round((piece.foot[axis] - before) / grid);
        if (piece.size[axis] > 0)
          piece.size[axis] = grid * std::max(std::round(piece.size[axis] / grid), 1.0);
        piece.foot[axis] = lower + (axis < 2 ? 0.5 * piece.size[axis] : 0);
      }
      piece.turn = quarter * std::round(piece.turn / quarter);
      piece.lean = 0;
    }
  }
}

void name_apart(CampaignScene& scene) {
  for (size_t n = 0; n < scene.things.size(); ++n) scene.things[n].name += "_" + std::to_string(n);
}

}  // namespace

CampaignScene generate(uint64_t number) {
  Dice dice(number);
  CampaignScene scene;
  scene.number = number;
  scene.settings = random_settings(dice);
  if (dice.chance(0.3)) {
    const double far = dice.pick({1e3, 1e5, 4e6, 1e7});
    scene.origin = {std::round(dice.real(-far, far)) + 0.125, dice.real(-far, far)};
  }
  const double cell = scene.settings.cells.size_m;
  scene.lower = {-cell * dice.real(0, 1), -cell * dice.real(0, 1)};
  scene.upper = scene.lower + cell * glm::dvec2(dice.whole(1, 2), dice.whole(1, 2));

  const Piece ground = add_ground(scene, dice);
  const double reach = std::min(150.0, 500 * scene.settings.navigation.seed_size_m);
  const int plots = dice.whole(4, 12);
  for (int n = 0; n < plots; ++n) {
    const auto plot = dice.chance(0.5) ? dice.pick({Plot::wall, Plot::block, Plot::row_houses})
                                       : static_cast<Plot>(dice.whole(0, static_cast<int>(Plot::count) - 1));
    const double away = plot == Plot::over_cell  ? dice.real(0, 1)
                        : plot == Plot::far_away ? dice.real(0.5, 1) * reach
                        : plot == Plot::courtyard && dice.chance(0.5)
                            ? 0.5
                            : 1.5 * cell + dice.real(4, spread_m(scene.settings));
    const double heading = dice.angle();
    Site site{scene.settings, away * glm::dvec2(std::cos(heading), std::sin(heading)), 0};
    site.ground_m = ground.size.z > 0
                        ? terrain_height(ground, site.at) - (dice.chance(0.8) ? 0.3 * ground.size.z : 0)
                        : 0;
    const std::vector<Thing> things = build(plot, site, dice);
    scene.things.insert(scene.things.end(), things.begin(), things.end());
  }
  add_occludees(scene, dice);
  add_quirks(scene, dice);
  if (dice.chance(0.35)) snap(scene, dice);
  name_apart(scene);
  return scene;
}

}  // namespace veduta::campaign
