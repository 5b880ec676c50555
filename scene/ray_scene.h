// The full model under a robust ray tracer.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "scene/scene.h"

namespace veduta {

/// What a ray meets first.
struct Hit {
  static constexpr uint32_t none = ~uint32_t{0};
  uint32_t triangle = none;  ///< number in Scene::triangles
  float distance_m = 0;
};

/// From an eye; the direction of unit length.
struct Ray {
  glm::vec3 eye{0}, direction{0};
};

/// How rays follow each other: `ordered` when sixteen in a row lie close together. Hits are the same
/// but for ties; the wrong one costs a third of the speed.
enum class RayOrder { ordered, scattered };

/// What the hierarchy is built for: half of the memory (40 bytes a triangle), or a tenth to a quarter more
/// speed; or `on_demand`, as compact but in tiles, each built when a ray first reaches its bounds: for who
/// looks at a part of a large city. Hits are the same but for ties.
enum class RaySpeed { compact, fast, on_demand };

/// The triangles of a scene without instances in a bounding-volume hierarchy (Embree, robust mode, both sides
/// of every triangle are solid). The same scene gives the same hits, ties included, on one machine. Every
/// member may be called from several threads at once, unless it is on demand. The scene must outlive it.
class RayScene {
 public:
  /// \throw Error(bad_input) when the scene has no triangle or 2^32 of them; Error(defect) when Embree fails.
  /// \param tile_triangles of a tile, on demand
  explicit RayScene(const Scene& scene, RaySpeed speed = RaySpeed::compact, uint64_t tile_triangles = 8192);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  /// First hits of rays from one eye; `directions` of unit length, `hits` as many. In float arithmetic: a hit
  /// next to an edge may be of the neighbour, and of coincident triangles any may be named.
  void first_hits(const glm::vec3& eye, std::span<const glm::vec3> directions, std::span<Hit> hits,
                  RayOrder order = RayOrder::ordered) const;

  /// The same from an eye for each ray. Ordered: of sixteen in a row the eyes lie close together as well.
  void first_hits(std::span<const Ray> rays, std::span<Hit> hits, RayOrder order = RayOrder::ordered) const;

  /// Does a triangle meet the segment? Its far end is stretched by 0.1 %, so a point on a surface counts as
  /// behind it.
  bool blocked(const glm::vec3& from, const glm::vec3& to) const;

  /// On demand: drops tiles that no ray has reached for the longest time, until those left have at most so
  /// many triangles, some 65 bytes each.
  void keep_within(uint64_t triangles);
  /// In the hierarchy at the time.
  uint64_t triangles_held() const;

  /// Every triangle that the ray may meet up to a distance, and more (those whose bounds it meets),
  /// ascending. Nothing that it meets is left out: what exact arithmetic has to look at. Direction of unit
  /// length.
  std::vector<uint32_t> triangles_near(const glm::vec3& eye, const glm::vec3& direction,
                                       float distance_m) const;

  /// Every triangle with a point in the ball, and more, ascending.
  std::vector<uint32_t> triangles_around(const glm::vec3& center, float radius_m) const;

 private:
  struct Tracer;
  std::unique_ptr<Tracer> tracer_;
};

}  // namespace veduta
