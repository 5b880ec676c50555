// A hierarchy of triangles in tiles, each of which is built when a ray first reaches its bounds.
#pragma once

#include <embree3/rtcore.h>

#include <exception>
#include <memory>
#include <vector>

#include "scene/scene.h"

namespace veduta {

/// Of a scene without instances, which outlives it. A tile has whole objects, neighbours, up to a number of
/// triangles where an object has not more by itself. What a ray meets does not depend on which tiles there
/// are at the time. Only one thread may use it.
class RayTiles {
 public:
  /// The device outlives it. Takes time and memory by objects, not by triangles.
  RayTiles(RTCDevice device, const Scene& scene, uint64_t tile_triangles);
  ~RayTiles();
  RayTiles(const RayTiles&) = delete;
  RayTiles& operator=(const RayTiles&) = delete;

  /// What rays are shot into; primitives of hits are numbers of triangles of the scene. After a call of
  /// Embree: \throw what building a tile threw meanwhile.
  RTCScene hierarchy() const { return top_; }
  void rethrow();

  /// Drops tiles that no ray has reached for the longest time, until those left have at most so many
  /// triangles.
  void keep_within(uint64_t triangles);
  /// Of the tiles that are there.
  uint64_t triangles() const { return triangles_; }

 private:
  struct Tile {
    std::vector<uint32_t> objects;  // ascending
    Box bounds;
    uint64_t triangles = 0, last_use = 0;
    RTCScene built = nullptr;
    std::vector<uint32_t> numbers;  // of its triangles in the scene, while it is built
  };
  struct Place {
    uint32_t object;
    Box bounds;
  };

  void divide(Place* begin, Place* end, uint64_t tile_triangles);
  uint64_t triangles_of(uint32_t object) const;
  /// The tile, built; null when that failed.
  Tile* reach(uint32_t tile) noexcept;
  void build(Tile& tile) const;
  static void intersect(const RTCIntersectFunctionNArguments* arguments);
  static void occlude(const RTCOccludedFunctionNArguments* arguments);

  RTCDevice device_;
  const Scene& scene_;
  std::vector<Tile> tiles_;
  RTCScene top_ = nullptr;
  uint64_t uses_ = 0, triangles_ = 0;
  std::exception_ptr failure_;
};

}  // namespace veduta
