// One wall of a building: its floors are split by the rules until all is terminals (thesis A.2).
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "scene/city/mesh_builder.h"
#include "scene/city/random.h"
#include "scene/city/rules.h"

namespace veduta::city {

/// The vertical plane over an edge of the outline, seen from outside: u in m from a to b, v upwards from the
/// ground, w out of the wall. The ends have exactly the coordinates of a and b.
struct Facade {
  Facade(const glm::dvec2& from, const glm::dvec2& to);
  glm::dvec3 at(double u, double v, double w = 0) const {
    const double t = u / length_m;
    return {a.x * (1 - t) + b.x * t + out.x * w, a.y * (1 - t) + b.y * t + out.y * w, v};
  }
  /// Keeps recesses on their side of the corners with the walls before and after, which end at `previous` and
  /// `next`.
  void keep_clear_of(const glm::dvec2& previous, const glm::dvec2& next);

  glm::dvec2 a, b, out;
  double length_m;
  /// What is set back by d keeps d times this away from the ends: the cotangent of half the corner's angle.
  double clear_a = 0, clear_b = 0;
};

struct Rectangle {
  double u0, u1, v0, v1;  ///< m
};

/// Splits rectangles of facades. Use one for many buildings: its memory stays.
class FacadeDeriver {
 public:
  /// The parts of one building may not be more than this; a rule that splits on and on stops here.
  static constexpr uint64_t most_cells = 4'000'000;

  void begin(const RuleSet& rules, MeshBuilder& mesh) {
    rules_ = &rules;
    mesh_ = &mesh;
    cells_ = 0;
  }
  /// \throw Error(bad_input) when a rule never ends
  void derive(const Facade& facade, const Rectangle& rectangle, uint32_t state, RandomPlace place);
  /// Plain wall.
  void wall(const Facade& facade, const Rectangle& rectangle) {
    put(rules_->terminals[rules_->wall], facade, rectangle);
  }

 private:
  static constexpr int most_deep = 100;
  /// Narrower or lower than this in m is plain wall: a rule that halves a shape for ever ends here.
  static constexpr double least_m = 0.02;

  void split(const Facade& facade, const Rectangle& rectangle, uint32_t state, RandomPlace place, int depth);
  const Choice* choose(const State& state, const Rectangle& rectangle, RandomPlace place) const;
  /// Plain wall where the terminal would reach through a corner.
  void put(const Terminal& terminal, const Facade& facade, const Rectangle& rectangle);

  const RuleSet* rules_ = nullptr;
  MeshBuilder* mesh_ = nullptr;
  uint64_t cells_ = 0;
  std::vector<double> lines_;       ///< a stack of the columns' and rows' ends
  std::vector<uint32_t> vertices_;  ///< of the terminal at hand
};

}  // namespace veduta::city
