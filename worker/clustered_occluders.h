// The shrunk occluders of a city as cells are baked with them: read from the file where a part of them is
// needed, so that a worker holds none of them and the workers of a host share what they look at.
#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "worker/occluder_layout.h"
#include "worker/occluders.h"

namespace veduta {

/// Bodies that are neighbours. Valid as long as what it is of.
struct OccluderCluster {
  std::span<const OccluderBody> bodies;       ///< and one more, which ends the last
  std::span<const OccluderPolygon> polygons;  ///< and one more
  const glm::vec3* corners = nullptr;         ///< m, relative to the scene origin

  size_t count() const { return bodies.size() - 1; }
};

/// The occluders of a ring (see OccluderRing): clusters along a curve through the city.
struct ClusteredRing {
  double h_m = 0;
  float depth_limit_m = 0;
  uint32_t first_cluster = 0;
  std::span<const Box> bounds;  ///< of its clusters
};

struct ClusteredWindow {
  glm::dvec3 half_extent_m{0};
  std::vector<ClusteredRing> rings;
};

/// A handle: copies share what they stand for. Only one thread at a time may use it and its copies.
class ClusteredOccluders {
 public:
  /// Of occluders in memory; a copy. Implicit, for a method takes either.
  ClusteredOccluders(const std::vector<WindowOccluders>& windows);

  /// Of a file that write_clustered_occluders wrote. It is mapped: its index is read and checked now, a
  /// cluster when it is first asked for. The kernel may drop what was read at any time, and reads it again.
  /// The file must stay as it is; where one is cut short or cannot be read any more the kernel ends the
  /// process with SIGBUS.
  /// \throw Error(bad_input) when it is missing, damaged, or no such file.
  static ClusteredOccluders map(const std::filesystem::path& file);

  const std::vector<ClusteredWindow>& windows() const;
  /// The windows' half-extents.
  const std::vector<glm::dvec3>& half_extents_m() const;
  /// By its number among all clusters (ClusteredRing::first_cluster). What it holds is well formed.
  /// \throw Error(bad_input) when it is damaged.
  OccluderCluster cluster(uint32_t number) const;

  /// All of a ring, copied: what zoom and the references take. In the order of the clusters, without faces
  /// that have no area. \throw Error(bad_input) when a part is damaged.
  OccluderMesh mesh(const ClusteredRing& ring) const;
  /// All there is, likewise.
  std::vector<WindowOccluders> meshes() const;

 private:
  struct State;
  explicit ClusteredOccluders(std::shared_ptr<State> state) : state_(std::move(state)) {}
  std::shared_ptr<State> state_;
};

/// Writes the file; neither synced nor under a temporary name. \throw Error(input_output).
void write_clustered_occluders(const std::filesystem::path& file,
                               const std::vector<WindowOccluders>& windows);

}  // namespace veduta
