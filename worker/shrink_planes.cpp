#include "worker/shrink_planes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "worker/grow_body.h"

namespace veduta {
namespace {

constexpr double reach_m = 48;         // a body grows from samples within this of its seed
constexpr size_t most_directions = 8;  // wall directions that are tried at each obstacle
constexpr int tries_in_vain = 24;      // seeds of a component that gain too little before it is left

/// The bodies of one window, in sealed space itself: not eroded.
struct Body {
  std::vector<HalfSpace> sides;
  Box within;
};

class Cover {
 public:
  Cover(const SealedBlock& block, const Obstacles& obstacles, const ShrinkRequest& request,
        const glm::dvec3& window)
      : obstacles_(obstacles), request_(request), samples_(block, obstacles, window, request.lowest_eye_m) {
    const GridFrame& frame = block.region.frame();
    // Exposure is not known at the region's rim; above and below, nothing is missed.
    known_ = frame.box(1, frame.nx - 2, 1, frame.ny - 2, 0, frame.nz - 1);
    const glm::vec3 far = glm::max(glm::abs(known_.lower), glm::abs(known_.upper));
    growth_.window_m = window;
    growth_.sample_m = samples_.step_m();
    growth_.sill_m = 2 * block.region.seed_frame().size_m;
    // Corners are rounded to float32, by half a unit in the last place along each axis.
    growth_.room_m =
        std::max({far.x, far.y, far.z}) * static_cast<double>(std::numeric_limits<float>::epsilon()) + 1e-5;
  }

  std::vector<Body> run() {
    for (const auto& component : samples_.components()) cover(component);
    return std::move(bodies_);
  }

 private:
  void cover(const std::vector<ErodedSamples::Sample>& component) {
    std::vector<uint8_t> covered(component.size(), 0);
    size_t left = component.size();
    const auto may_stay = static_cast<size_t>((1 - request_.keep) * static_cast<double>(component.size()));
    // Of a large row, a quarter of a window's volume is worth a body; of a small house, less.
    const glm::dvec3 w = growth_.window_m / samples_.step_m();
    const auto least_gain =
        static_cast<size_t>(std::clamp(2 * w.x * w.y * w.z, 1.0, 1 + component.size() / 50.0));
    int in_vain = 0;
    for (size_t s = 0; s < component.size() && left > may_stay && in_vain < tries_in_vain; ++s) {
      if (covered[s] != 0) continue;
      const size_t gained = grow(component, s, covered, least_gain);
      left -= gained;
      in_vain = gained > 0 ? 0 : in_vain + 1;
      if (gained == 0) covered[s] = 1;  // tried
    }
  }

  size_t grow(const std::vector<ErodedSamples::Sample>& component, size_t seed, std::vector<uint8_t>& covered,
              size_t least_gain) {
    const glm::dvec3 center = component[seed].at;
    std::vector<glm::dvec3> samples;
    Box bounds;
    for (size_t n = 0; n < component.size(); ++n) {
      const glm::dvec3 d = glm::abs(component[n].at - center);
      if (std::max(d.x, d.y) > reach_m) continue;
      bounds.extend(glm::vec3(component[n].at));
      if (covered[n] == 0) samples.push_back(component[n].at);
    }
    // Windows of the outermost samples, and once more, so that what lies across a block's border is covered.
    const glm::vec3 margin(2.0 * growth_.window_m + samples_.step_m());
    growth_.within = {glm::max(bounds.lower - margin, known_.lower),
                      glm::min(bounds.upper + margin, known_.upper)};
    growth_.within.lower.z = known_.lower.z;
    growth_.directions = wall_directions();
    auto sides = grow_body(obstacles_, growth_, center, samples);
    if (!sides || samples.size() < least_gain) return 0;
    size_t gained = 0;
    for (size_t n = 0; n < component.size(); ++n) {
      if (covered[n] == 0 && holds(*sides, component[n].at)) covered[n] = 1, ++gained;
    }
    bodies_.push_back({std::move(*sides), growth_.within});
    return gained;
  }

  bool holds(const std::vector<HalfSpace>& sides, const glm::dvec3& p) const {
    return std::all_of(sides.begin(), sides.end(), [&](const HalfSpace& side) {
      return glm::dot(side.normal, p) <= side.offset_m - support(growth_.window_m, side.normal);
    });
  }

  /// Horizontal normals of the walls in `within`, those with most surface first.
  std::vector<glm::dvec3> wall_directions() {
    obstacles_.find(growth_.within, found_);
    constexpr int bins = 90;  // of two degrees, over half a turn
    std::vector<double> area(bins, 0);
    std::vector<glm::dvec3> normal(bins, glm::dvec3(0));
    for (const uint32_t piece : found_) {
      const glm::dvec3 n = obstacles_.normal(piece);
      if (std::abs(n.z) > 0.1) continue;
      const Box& b = obstacles_.bounds(piece);
      const glm::vec3 e = b.upper - b.lower;
      const double size = std::hypot(e.x, e.y) * e.z;
      const glm::dvec3 flat =
          glm::normalize(glm::dvec3(n.x, n.y, 0)) * (n.y < 0 || (n.y == 0 && n.x < 0) ? -1.0 : 1.0);
      const int bin = std::clamp(static_cast<int>(std::atan2(flat.y, flat.x) / M_PI * bins), 0, bins - 1);
      if (size > area[bin]) normal[bin] = flat;
      area[bin] += size;
    }
    std::vector<int> order;
    for (int b = 0; b < bins; ++b) {
      if (area[b] > 0) order.push_back(b);
    }
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return area[a] > area[b]; });
    std::vector<glm::dvec3> directions;
    for (size_t n = 0; n < std::min(order.size(), most_directions); ++n)
      directions.push_back(normal[order[n]]);
    return directions;
  }

  const Obstacles& obstacles_;
  const ShrinkRequest& request_;
  const ErodedSamples samples_;
  Box known_;
  Growth growth_;
  std::vector<uint32_t> found_;
  std::vector<Body> bodies_;
};

}  // namespace

std::vector<WindowOccluders> PlanesShrinker::shrink(const SealedBlock& block,
                                                    const ShrinkRequest& request) const {
  const ExposedSurface surface = exposed_surface(block);
  const Obstacles obstacles(surface, 8.0);
  std::vector<WindowOccluders> result;
  for (const glm::dvec3& half_extent : request.half_extents_m) {
    WindowOccluders occluders{half_extent, {}};
    const std::vector<RingWindow> windows = request.rings(half_extent);
    const std::vector<Body> bodies =
        Cover(block, obstacles, request, half_extent + windows.front().h_m).run();
    for (const RingWindow& window : windows) {
      OccluderRing ring{window.h_m, static_cast<float>(window.depth_limit_m), {}};
      for (const Body& body : bodies)
        add_body(body.sides, half_extent + window.h_m, body.within, ring.occluders);
      occluders.rings.push_back(std::move(ring));
    }
    result.push_back(std::move(occluders));
  }
  return result;
}

}  // namespace veduta
