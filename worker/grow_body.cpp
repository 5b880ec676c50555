#include "worker/grow_body.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace veduta {
namespace {

constexpr size_t most_sides = 32;

class Grower {
 public:
  Grower(const Obstacles& obstacles, const Growth& growth, const glm::dvec3& seed,
         std::vector<glm::dvec3>& samples)
      : obstacles_(obstacles), growth_(growth), seed_(seed), samples_(samples) {}

  std::optional<std::vector<HalfSpace>> run() {
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 n(0);
      n[axis] = 1;
      if (!put({n, growth_.within.upper[axis] - growth_.room_m})) return std::nullopt;
      n[axis] = -1;
      // What is below the scene is sealed: no window ends there.
      const double below = axis == 2 ? growth_.window_m.z + 1 : 0;
      if (!put({n, -growth_.within.lower[axis] - growth_.room_m + below})) return std::nullopt;
    }
    std::vector<uint32_t> near;
    obstacles_.find(growth_.within, near);
    std::vector<std::pair<double, uint32_t>> order;
    for (const uint32_t piece : near) order.emplace_back(distance(obstacles_.bounds(piece)), piece);
    std::sort(order.begin(), order.end());
    for (const auto& [distance_m, piece] : order) {
      if (!kept_off(piece) && !keep_off(piece)) return std::nullopt;
    }
    return sides_;
  }

 private:
  double distance(const Box& box) const {
    const glm::dvec3 nearest = glm::clamp(seed_, glm::dvec3(box.lower), glm::dvec3(box.upper));
    return glm::dot(nearest - seed_, nearest - seed_);
  }
  double inner(const HalfSpace& side) const { return side.offset_m - support(growth_.window_m, side.normal); }

  bool put(const HalfSpace& side) {
    if (glm::dot(side.normal, seed_) > inner(side)) return false;
    for (HalfSpace& known : sides_) {
      if (glm::dot(known.normal, side.normal) > 1 - 1e-12) {
        known.offset_m = std::min(known.offset_m, side.offset_m);
        return true;
      }
    }
    sides_.push_back(side);
    return true;
  }

  bool kept_off(uint32_t piece) const {
    const Box& b = obstacles_.bounds(piece);
    const glm::dvec3 center = 0.5 * (glm::dvec3(b.lower) + glm::dvec3(b.upper)),
                     half = 0.5 * (glm::dvec3(b.upper) - glm::dvec3(b.lower));
    for (const HalfSpace& side : sides_) {
      const double middle = glm::dot(side.normal, center), reach = support(half, side.normal);
      if (middle - reach >= side.offset_m) return true;
      if (middle + reach >= side.offset_m && obstacles_.nearest(piece, side.normal) >= side.offset_m)
        return true;
    }
    return false;
  }

  /// Adds or moves the half-space that keeps the piece off and loses the fewest samples; a new face has to
  /// save some.
  bool keep_off(uint32_t piece) {
    if (move_a_little(piece)) return true;
    best_ = {};
    best_loss_ = -1;
    for (const HalfSpace& side : sides_) try_side(piece, side.normal, 0);
    const double new_face = 2 + 0.01 * static_cast<double>(samples_.size());
    if (sides_.size() < most_sides) {
      const glm::dvec3 n = obstacles_.normal(piece);
      try_side(piece, n, new_face), try_side(piece, -n, new_face);
      const Box& b = obstacles_.bounds(piece);
      const glm::dvec3 to = glm::clamp(seed_, glm::dvec3(b.lower), glm::dvec3(b.upper)) - seed_;
      if (glm::dot(to, to) > 0) try_side(piece, glm::normalize(to), new_face);
      const glm::dvec3 flat(to.x, to.y, 0);
      if (glm::dot(flat, flat) > 0) try_side(piece, glm::normalize(flat), new_face);
      for (const glm::dvec3& d : growth_.directions)
        try_side(piece, d, new_face), try_side(piece, -d, new_face);
    }
    if (best_loss_ < 0) try_edges(piece, new_face);
    if (best_loss_ < 0) return false;
    put(best_);
    drop_samples(best_);
    return true;
  }

  /// A side that has to move by two seeds at most does so: the ground ends that far behind the wall on it,
  /// because the seeds there touch both, and roofs are uneven.
  bool move_a_little(uint32_t piece) {
    double least = growth_.sill_m;
    HalfSpace* nearest = nullptr;
    for (HalfSpace& side : sides_) {
      const double move = side.offset_m - (obstacles_.nearest(piece, side.normal) - growth_.room_m);
      if (move <= least && glm::dot(side.normal, seed_) <= inner(side) - move) least = move, nearest = &side;
    }
    if (nearest == nullptr) return false;
    nearest->offset_m -= least;
    drop_samples(*nearest);
    return true;
  }

  void drop_samples(const HalfSpace& side) {
    const double limit = inner(side);
    samples_.erase(std::remove_if(samples_.begin(), samples_.end(),
                                  [&](const glm::dvec3& p) { return glm::dot(side.normal, p) > limit; }),
                   samples_.end());
  }

  /// A box and a convex polygon that do not meet are separated by one of the box's sides, by the polygon's
  /// plane or by a plane along an edge of each.
  void try_edges(uint32_t piece, double price) {
    const glm::dvec3* last = obstacles_.end(piece) - 1;
    for (const glm::dvec3* corner = obstacles_.begin(piece); corner != obstacles_.end(piece);
         last = corner++) {
      const glm::dvec3 edge = *corner - *last;
      for (const glm::dvec3& n :
           {glm::dvec3(0, edge.z, -edge.y), glm::dvec3(-edge.z, 0, edge.x), glm::dvec3(edge.y, -edge.x, 0)}) {
        const double length = glm::length(n);
        if (length < 1e-9) continue;
        try_side(piece, n / length, price), try_side(piece, -n / length, price);
      }
    }
  }

  void try_side(uint32_t piece, const glm::dvec3& normal, double price) {
    const HalfSpace side{normal, obstacles_.nearest(piece, normal) - growth_.room_m};
    const double limit = inner(side), slack = limit - glm::dot(normal, seed_);
    if (slack < 0) return;
    // Under a body that floats one sees everything: that is worth a quarter of it.
    double loss = price + (normal.z < -0.5 ? 0.25 * static_cast<double>(samples_.size()) : 0);
    // A sample stands for a box around it, which a plane may cut.
    const double width = support(growth_.sample_m, normal);
    for (const glm::dvec3& p : samples_) {
      loss += std::clamp(0.5 + (glm::dot(normal, p) - limit) / width, 0.0, 1.0);
      if (best_loss_ >= 0 && loss > best_loss_) return;
    }
    if (best_loss_ >= 0 && loss == best_loss_ && slack <= best_slack_) return;
    best_ = side, best_loss_ = loss, best_slack_ = slack;
  }

  const Obstacles& obstacles_;
  const Growth& growth_;
  const glm::dvec3 seed_;
  std::vector<glm::dvec3>& samples_;
  std::vector<HalfSpace> sides_;
  HalfSpace best_;
  double best_loss_ = -1;
  double best_slack_ = 0;
};

}  // namespace

std::optional<std::vector<HalfSpace>> grow_body(const Obstacles& obstacles, const Growth& growth,
                                                const glm::dvec3& seed, std::vector<glm::dvec3>& samples) {
  return Grower(obstacles, growth, seed, samples).run();
}

}  // namespace veduta
