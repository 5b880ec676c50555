#include "tests/campaign/minimise.h"

#include <array>
#include <cmath>

namespace veduta::campaign {
namespace {

double rounded(double value, double step) {
  return step * std::round(value / step);
}
glm::dvec3 rounded(const glm::dvec3& value, double step) {
  return {rounded(value.x, step), rounded(value.y, step), rounded(value.z, step)};
}

/// Simpler pieces, the simplest first.
std::vector<Piece> simpler(const Piece& piece) {
  std::vector<Piece> all;
  const auto with = [&](const std::function<void(Piece&)>& change) {
    Piece changed = piece;
    change(changed);
    if (!(changed == piece)) all.push_back(changed);
  };
  if (piece.shape != Shape::terrain) with([](Piece& p) { p.shape = Shape::box; });
  with([](Piece& p) { p.turn = 0; });
  with([](Piece& p) { p.lean = 0; });
  with([](Piece& p) { p.open_top = false; });
  with([](Piece& p) { p.inverted = false; });
  with([](Piece& p) { p.twice = false; });
  for (const double step : {1.0, 0.5, 0.1, 0.01, 0.001}) {
    with([&](Piece& p) {
      p.foot = rounded(p.foot, step), p.size = rounded(p.size, step), p.turn = rounded(p.turn, step);
    });
    with([&](Piece& p) { p.foot = rounded(p.foot, step); });
    with([&](Piece& p) { p.size = rounded(p.size, step); });
    with([&](Piece& p) { p.turn = rounded(p.turn, step), p.lean = rounded(p.lean, step); });
  }
  return all;
}

void plain_numbers(Settings& s) {
  for (double* value :
       {&s.navigation.fly_lowest_m, &s.navigation.fly_highest_m, &s.cells.size_m, &s.cells.height_m})
    *value = rounded(*value, 0.5);
  s.navigation.seed_size_m = std::exp2(std::round(std::log2(s.navigation.seed_size_m)));
}

/// What may become simpler about a bake. None undoes another.
const std::array<void (*)(Settings&), 13> simpler_settings{
    [](Settings& s) { s.navigation.mode = "walk"; },
    [](Settings& s) { s.occlusion.method = "panorama"; },
    [](Settings& s) { s.shrink.method = "planes"; },
    [](Settings& s) { s.shrink.method = s.shrink.method == "planes" ? "planes" : "sealed"; },
    [](Settings& s) { s.occlusion.subdivide = 1; },
    [](Settings& s) { s.occlusion.subdivide = std::min(s.occlusion.subdivide, 2); },
    [](Settings& s) { s.slices.max = 1; },
    [](Settings& s) { s.occlusion.max_overestimate = 1; },
    [](Settings& s) { s.occlusion.resolution = 64; },
    [](Settings& s) { s.stereo.eye_margin_m = 0; },
    [](Settings& s) { s.cells.largest = 1; },
    [](Settings& s) { s.scene.terrain_tile_m = 64; },
    plain_numbers};

class Minimiser {
 public:
  Minimiser(const CampaignScene& scene, const Outcome& failure,
            const std::function<Outcome(const CampaignScene&)>& check, size_t most_checks)
      : best_{scene, failure, 0}, check_(check), most_checks_(most_checks) {}

  Minimal run() {
    one_cell();
    fewer_things();
    size_t before = 0;
    do {
      before = changes_;
      near_origin();
      simpler_bake();
      fewer_things();
      simpler_pieces();
    } while (changes_ > before && best_.checks < most_checks_);
    return best_;
  }

 private:
  /// Keeps a scene that fails in the same way.
  bool try_scene(const CampaignScene& scene) {
    if (best_.checks >= most_checks_) return false;
    ++best_.checks;
    const Outcome outcome = check_(scene);
    if (outcome.verdict != best_.outcome.verdict) return false;
    best_.scene = scene, best_.outcome = outcome;
    ++changes_;
    return true;
  }

  void one_cell() {
    const Outcome& failure = best_.outcome;
    if (failure.cell_lower == failure.cell_upper) return;
    CampaignScene scene = best_.scene;
    // A little inside, so that the centres of the cells around stay outside.
    const glm::dvec2 inside = 0.1 * (failure.cell_upper - failure.cell_lower);
    scene.lower = failure.cell_lower + inside - scene.origin,
    scene.upper = failure.cell_upper - inside - scene.origin;
    try_scene(scene);
  }

  void fewer_things() {
    fewest(best_.scene.things, [&](const std::vector<Thing>& things) {
      CampaignScene scene = best_.scene;
      scene.things = things;
      return try_scene(scene);
    });
    for (size_t t = 0; t < best_.scene.things.size(); ++t) {
      fewest(best_.scene.things[t].pieces, [&](const std::vector<Piece>& pieces) {
        CampaignScene scene = best_.scene;
        scene.things[t].pieces = pieces;
        return !pieces.empty() && try_scene(scene);
      });
    }
  }

  void near_origin() {
    if (best_.scene.origin == glm::dvec2(0)) return;
    CampaignScene scene = best_.scene;
    scene.origin = glm::dvec2(0);
    try_scene(scene);
  }

  void simpler_bake() {
    for (const auto change : simpler_settings) {
      CampaignScene scene = best_.scene;
      change(scene.settings);
      if (to_toml(scene.settings) != to_toml(best_.scene.settings)) try_scene(scene);
    }
  }

  void simpler_pieces() {
    for (size_t t = 0; t < best_.scene.things.size(); ++t) {
      for (size_t p = 0; p < best_.scene.things[t].pieces.size(); ++p) {
        for (const Piece& piece : simpler(best_.scene.things[t].pieces[p])) {
          CampaignScene scene = best_.scene;
          scene.things[t].pieces[p] = piece;
          if (try_scene(scene)) break;  // what else may be simpler is asked in the next round
        }
      }
    }
  }

  Minimal best_;
  const std::function<Outcome(const CampaignScene&)>& check_;
  size_t most_checks_, changes_ = 0;
};

}  // namespace

Minimal minimise(const CampaignScene& scene, const Outcome& failure,
                 const std::function<Outcome(const CampaignScene&)>& check, size_t most_checks) {
  return Minimiser(scene, failure, check, most_checks).run();
}

}  // namespace veduta::campaign
