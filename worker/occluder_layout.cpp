#include "worker/occluder_layout.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <cstring>
#include <glm/geometric.hpp>
#include <utility>

namespace veduta::occluder_layout {
namespace {

/// The bits of v, each followed by a 0.
uint64_t spread_bits(uint32_t v) {
  uint64_t x = v;
  x = (x | x << 16) & 0x0000ffff0000ffffULL;
  x = (x | x << 8) & 0x00ff00ff00ff00ffULL;
  x = (x | x << 4) & 0x0f0f0f0f0f0f0f0fULL;
  x = (x | x << 2) & 0x3333333333333333ULL;
  return (x | x << 1) & 0x5555555555555555ULL;
}

/// Bodies along a Morton curve of the centres of their bounds, so that neighbours share a cluster.
std::vector<uint32_t> sorted_by_place(const std::vector<Box>& bounds) {
  Box all;
  for (const Box& b : bounds) all.extend(b);
  const glm::vec3 scale = 65535.0f / glm::max(all.upper - all.lower, glm::vec3(1e-3f));
  std::vector<std::pair<uint64_t, uint32_t>> keys;
  for (uint32_t b = 0; b < bounds.size(); ++b) {
    const glm::vec3 p = (bounds[b].center() - all.lower) * scale;
    keys.emplace_back(spread_bits(static_cast<uint32_t>(p.x)) | spread_bits(static_cast<uint32_t>(p.y)) << 1,
                      b);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<uint32_t> sorted;
  for (const auto& key : keys) sorted.push_back(key.second);
  return sorted;
}

/// Twice the area of a polygon along its normal.
glm::dvec3 area_vector(const glm::vec3* corners, uint32_t count) {
  glm::dvec3 sum(0);
  const glm::dvec3 origin(corners[0]);
  for (uint32_t c = 1; c + 1 < count; ++c)
    sum += glm::cross(glm::dvec3(corners[c]) - origin, glm::dvec3(corners[c + 1]) - origin);
  return sum;
}

/// What becomes a block.
struct Block {
  std::vector<OccluderBody> bodies;
  std::vector<OccluderPolygon> polygons;
  std::vector<glm::vec3> corners;

  void clear() { bodies.clear(), polygons.clear(), corners.clear(); }

  void add(const OccluderMesh& mesh, size_t body, const Box& bounds) {
    bodies.push_back({bounds, static_cast<uint32_t>(polygons.size())});
    for (uint32_t f = mesh.body_begin[body]; f < mesh.body_begin[body + 1]; ++f) {
      const glm::vec3* first = &mesh.corners[mesh.face_begin[f]];
      const uint32_t count = mesh.face_begin[f + 1] - mesh.face_begin[f];
      const glm::dvec3 area = area_vector(first, count);
      const double length = glm::length(area);
      if (!(length > 1e-12)) continue;
      polygons.push_back({glm::vec3(area / length), static_cast<uint32_t>(corners.size())});
      corners.insert(corners.end(), first, first + count);
    }
  }

  /// Its bytes and, but for its place, its entry in the index.
  Cluster encode(std::vector<std::byte>& bytes) {
    Cluster cluster{0,
                    0,
                    static_cast<uint32_t>(bodies.size()),
                    static_cast<uint32_t>(polygons.size()),
                    static_cast<uint32_t>(corners.size()),
                    0};
    bodies.push_back({{glm::vec3(0), glm::vec3(0)}, cluster.polygons});
    polygons.push_back({glm::vec3(0), cluster.corners});
    bytes.clear();
    const auto put = [&](const auto& values) {
      const auto all = std::as_bytes(std::span(values));
      bytes.insert(bytes.end(), all.begin(), all.end());
    };
    put(bodies), put(polygons), put(corners);
    cluster.digest = block_digest(bytes.data(), bytes.size());
    return cluster;
  }
};

/// The index, as its parts are found.
struct Index {
  std::vector<Window> windows;
  std::vector<Ring> rings;
  std::vector<Cluster> clusters;
  std::vector<Box> bounds;

  std::vector<std::byte> bytes() const {
    std::vector<std::byte> all;
    const auto put = [&](const auto& values) {
      const auto some = std::as_bytes(std::span(values));
      all.insert(all.end(), some.begin(), some.end());
    };
    put(windows), put(rings), put(clusters), put(bounds);
    return all;
  }
};

void put(std::ostream& out, const void* data, size_t size) {
  out.write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
}

uint64_t clusters_of(const OccluderMesh& mesh) {
  return (mesh.bodies() + cluster_size - 1) / cluster_size;
}

void write_ring(std::ostream& out, const OccluderRing& ring, uint64_t& at, Index& index) {
  const OccluderMesh& mesh = ring.occluders;
  std::vector<Box> bounds;
  for (size_t b = 0; b < mesh.bodies(); ++b) bounds.push_back(mesh.bounds(b));
  const std::vector<uint32_t> sorted = sorted_by_place(bounds);
  Block block;
  std::vector<std::byte> bytes;
  for (size_t b = 0; b < sorted.size(); b += cluster_size) {
    block.clear();
    Box all;
    for (size_t n = b; n < std::min(b + cluster_size, sorted.size()); ++n) {
      all.extend(bounds[sorted[n]]);
      block.add(mesh, sorted[n], bounds[sorted[n]]);
    }
    Cluster& cluster = index.clusters.emplace_back(block.encode(bytes));
    cluster.at = at;
    index.bounds.push_back(all);
    put(out, bytes.data(), bytes.size());
    at += bytes.size();
  }
  index.rings.push_back({ring.h_m, ring.depth_limit_m, static_cast<uint32_t>(clusters_of(mesh))});
}

}  // namespace

uint64_t block_digest(const std::byte* block, size_t size) {
  return XXH3_64bits(block, size);
}

uint64_t index_digest(Header header, const std::byte* index, size_t size) {
  header.digest = 0;
  header.digest = XXH3_64bits(&header, sizeof(header));
  return XXH3_64bits_withSeed(index, size, header.digest);
}

void write(std::ostream& out, const std::vector<WindowOccluders>& windows) {
  Header header{};
  std::memcpy(header.magic, magic, sizeof(magic));
  for (const WindowOccluders& window : windows) {
    header.windows += 1, header.rings += static_cast<uint32_t>(window.rings.size());
    for (const OccluderRing& ring : window.rings) header.clusters += clusters_of(ring.occluders);
  }
  uint64_t at = sizeof(Header) + header.windows * sizeof(Window) + header.rings * sizeof(Ring) +
                header.clusters * (sizeof(Cluster) + sizeof(Box));
  // The index goes before the blocks, but its digests are of them: room for it now, itself last.
  const std::vector<char> room(at);
  put(out, room.data(), room.size());
  Index index;
  for (const WindowOccluders& window : windows) {
    const glm::dvec3& e = window.half_extent_m;
    index.windows.push_back({{e.x, e.y, e.z}, window.rings.size()});
    for (const OccluderRing& ring : window.rings) write_ring(out, ring, at, index);
  }
  header.file_bytes = at;
  const std::vector<std::byte> bytes = index.bytes();
  header.digest = index_digest(header, bytes.data(), bytes.size());
  out.seekp(0);
  put(out, &header, sizeof(header));
  put(out, bytes.data(), bytes.size());
}

}  // namespace veduta::occluder_layout
