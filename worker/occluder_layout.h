// How clustered occluders lie in a file, and in memory: what is drawn together lies together.
//
// A header, the windows, their rings, the clusters and their bounds (the index), then for each cluster a
// block: its bodies, its polygons (one more of each, which ends the last) and its corners. The header's
// digest is of the index and of the header itself, without the digest; each cluster has one of its block.
// Everything is little-endian and aligned to its size, so that a mapped file is used as it is.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <ostream>
#include <span>
#include <vector>

#include "worker/occluders.h"

namespace veduta {

/// A polygon of an occluder. It ends where the next begins.
struct OccluderPolygon {
  glm::vec3 normal;       ///< outwards, unit length
  uint32_t first_corner;  ///< in the cluster
};

/// A body of some polygons. It ends where the next begins.
struct OccluderBody {
  Box bounds;
  uint32_t first_polygon;  ///< in the cluster
};

namespace occluder_layout {

inline constexpr char magic[8] = {'V', 'D', 'T', 'O', 'C', 'T', '0', '1'};
inline constexpr size_t cluster_size =
    32;  // bodies: small enough to cull well, large enough to be worth a test

struct Header {
  char magic[8];
  uint64_t digest, file_bytes;
  uint32_t windows, rings;
  uint64_t clusters;
};
struct Window {
  double half_extent_m[3];
  uint64_t rings;
};
struct Ring {
  double h_m;
  float depth_limit_m;
  uint32_t clusters;
};
struct Cluster {
  uint64_t at, digest;  ///< bytes into the file; of the block
  uint32_t bodies, polygons, corners, unused;
};
static_assert(sizeof(Header) == 40 && sizeof(Window) == 32 && sizeof(Ring) == 16 && sizeof(Cluster) == 32);
static_assert(sizeof(OccluderPolygon) == 16 && sizeof(OccluderBody) == 28 && sizeof(Box) == 24);

/// Of a cluster's block. Counts are below 2^32, so it does not overflow.
inline uint64_t block_bytes(const Cluster& cluster) {
  return (uint64_t{cluster.bodies} + 1) * sizeof(OccluderBody) +
         (uint64_t{cluster.polygons} + 1) * sizeof(OccluderPolygon) +
         uint64_t{cluster.corners} * sizeof(glm::vec3);
}

/// Digest of the header and the index behind it.
uint64_t index_digest(Header header, const std::byte* index, size_t size);
uint64_t block_digest(const std::byte* block, size_t size);

/// Lays occluders out: of each ring, neighbours in a cluster, and neighbouring clusters behind each other.
/// Faces without an area are left out, for they face nobody. `out` is at its begin, and can be sought in.
void write(std::ostream& out, const std::vector<WindowOccluders>& windows);

}  // namespace occluder_layout
}  // namespace veduta
