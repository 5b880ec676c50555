// Adaptive border sampling: where something ends, something else begins to show.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "scene/box.h"
#include "scene/random.h"
#include "scene/ray_scene.h"
#include "scene/scene.h"
#include "verify/directions.h"

namespace veduta {

/// Rays past the edges of the triangles seen so far, after guided visibility sampling (Wonka et al. 2006;
/// Koch & Wimmer 2021): what is new is found beside what is known, in slits and over roofs, where uniform
/// rays take long to fall.
/// - *Border samples*: the border of a triangle is enlarged a little (by an angle between 10^-5 and 0.03, all
///   magnitudes alike) and rays go to points along its edges, at first from the eye that saw the triangle,
///   then from others. An edge past which such a ray met something else than the surface going on is a
///   *silhouette*; most samples go to those.
/// - *Gaps*: between two neighbouring samples that met different objects goes a third ray, and so on.
/// - *Reverse samples*: where something nearer hides the place, a ray to it from another eye, past the edge
/// of
///   what hides it.
class Borders {
 public:
  /// Can a viewer's eye be here?
  using EyeTest = std::function<bool(const glm::vec3&)>;

  /// \param object_of [T] number of a triangle's object.
  /// \param cell where eyes of reverse samples are, as far as `eye_test` lets them.
  Borders(const Scene& scene, const std::vector<uint32_t>& object_of, const Box& cell, EyeTest eye_test);

  /// A triangle that was met for the first time, from this eye.
  void add(uint32_t triangle, const glm::vec3& eye);
  bool empty() const { return edges_.empty(); }

  /// From now on, all edges known are sampled. Those that are new since the last call are so only once.
  void take_up();
  /// Replaces `rays` by at most as many as the part has: samples past edges of this part of those known,
  /// along a Morton curve around the cell, each 16 from a random eye; and what the last aim() gave reason
  /// for.
  void aim(const Strata& part, std::span<const glm::vec3> eyes, Random& random, std::vector<Ray>& rays);
  /// What the rays of the last aim() met.
  void learn(std::span<const Ray> rays, std::span<const Hit> hits, Random& random);

 private:
  struct Edge {
    uint32_t triangle = 0, corner = 0;  ///< from this corner to the next
    uint32_t key = 0;                   ///< curve_key() of its middle from the middle of the cell
    bool silhouette = false;
  };
  struct Fresh {
    uint32_t first_edge = 0;
    glm::vec3 eye{0};
  };
  /// A border sample: the ray passes this place of the edge, outside of the triangle.
  struct Sample {
    uint32_t edge = 0;
    glm::vec3 place{0};
  };
  /// Two rays from an eye that met different objects, close together.
  struct Gap {
    glm::vec3 eye{0}, one{0}, other{0};
    uint32_t one_object = 0, other_object = 0, level = 0;
  };

  void sample_edge(uint32_t edge, const glm::vec3& eye, Random& random, std::vector<Ray>& rays);
  void learn_sample(size_t ray, std::span<const Ray> rays, std::span<const Hit> hits, Random& random);
  void learn_gap(const Gap& gap, const Ray& ray, const Hit& hit);
  void reverse(const glm::vec3& place, uint32_t hiding, const glm::vec3& hit, Random& random);
  uint32_t object_at(const Hit& hit) const;

  const Scene& scene_;
  const std::vector<uint32_t>& object_of_;
  Box cell_;
  EyeTest eye_test_;
  std::vector<Edge> edges_;
  std::vector<uint32_t> known_, silhouettes_;  // numbers in edges_, along the curve
  std::vector<Fresh> fresh_;
  std::vector<Gap> gaps_;
  std::vector<Ray> reverse_;
  // of the last aim(), in the order of its rays: samples, gaps, reverse
  std::vector<Sample> sampled_;
  std::vector<Gap> looked_into_;
  size_t limit_ = 0;  // of gaps_ and reverse_: what is more than one aim() can take is not worth keeping
};

}  // namespace veduta
