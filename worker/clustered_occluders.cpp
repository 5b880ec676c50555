#include "worker/clustered_occluders.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>

#include "scene/error.h"

namespace veduta {
namespace {

namespace layout = occluder_layout;

constexpr float farthest_m = 1e8f;        // from the origin: farther is damage, and nothing overflows nearer
constexpr double most_pixels = 1u << 20;  // along a face, that a ring's limit and h may ask for

/// A file in memory, read-only, shared with everybody who maps it.
class Mapping {
 public:
  explicit Mapping(const std::filesystem::path& file) {
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    struct stat status {};
    if (descriptor >= 0 && ::fstat(descriptor, &status) == 0 && status.st_size > 0) {
      const auto size = static_cast<size_t>(status.st_size);
      void* at = ::mmap(nullptr, size, PROT_READ, MAP_SHARED, descriptor, 0);
      if (at != MAP_FAILED) bytes_ = {static_cast<const std::byte*>(at), size};
    }
    if (descriptor >= 0) ::close(descriptor);
  }
  ~Mapping() {
    if (!bytes_.empty()) ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
  }
  Mapping(const Mapping&) = delete;
  Mapping& operator=(const Mapping&) = delete;
  /// None where it cannot be mapped.
  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::span<const std::byte> bytes_;
};

bool near_enough(const glm::vec3& p) {
  return std::abs(p.x) <= farthest_m && std::abs(p.y) <= farthest_m && std::abs(p.z) <= farthest_m;
}

bool near_enough(const Box& box) {
  return near_enough(box.lower) && near_enough(box.upper);
}

/// Whether a block's parts begin and end within each other, and its numbers are no nonsense.
bool well_formed(const OccluderCluster& c, uint32_t corners) {
  const auto bodies = c.bodies.size(), polygons = c.polygons.size();
  if (c.bodies[0].first_polygon != 0 || c.bodies[bodies - 1].first_polygon != polygons - 1) return false;
  if (c.polygons[0].first_corner != 0 || c.polygons[polygons - 1].first_corner != corners) return false;
  for (size_t b = 0; b + 1 < bodies; ++b) {
    if (c.bodies[b].first_polygon > c.bodies[b + 1].first_polygon || !near_enough(c.bodies[b].bounds))
      return false;
  }
  for (size_t p = 0; p + 1 < polygons; ++p) {
    const uint32_t begin = c.polygons[p].first_corner, end = c.polygons[p + 1].first_corner;
    if (end < begin || end - begin < 3 || !near_enough(c.polygons[p].normal)) return false;
  }
  return std::all_of(c.corners, c.corners + corners, [](const glm::vec3& p) { return near_enough(p); });
}

}  // namespace

struct ClusteredOccluders::State {
  explicit State(const std::filesystem::path& a_file) : file(a_file) {
    mapping = std::make_unique<Mapping>(file);
    open(mapping->bytes());
  }
  explicit State(const std::vector<WindowOccluders>& occluders) : file("occluders") {
    std::stringstream stream;
    layout::write(stream, occluders);
    memory = std::move(stream).str();
    open(std::as_bytes(std::span(memory)));
  }

  void open(std::span<const std::byte> all) {
    bytes = all;
    if (!read_index()) damaged();
    checked.resize(clusters.size());
  }
  bool read_index();
  bool read_rings(std::span<const layout::Window> of_windows, std::span<const layout::Ring> of_rings);
  [[noreturn]] void damaged() const {
    throw Error(ExitStatus::bad_input,
                file.string() + ": missing or damaged; remove the folder it is in and bake again");
  }

  std::filesystem::path file;
  std::unique_ptr<Mapping> mapping;  // or
  std::string memory;
  std::span<const std::byte> bytes;
  std::vector<ClusteredWindow> windows;
  std::vector<glm::dvec3> half_extents_m;
  std::span<const layout::Cluster> clusters;
  std::span<const Box> bounds;
  std::vector<bool> checked;  // [clusters]
};

/// \return false where the file is not one of ours, or not as it was written.
bool ClusteredOccluders::State::read_index() {
  layout::Header header{};
  if (bytes.size() < sizeof(header)) return false;
  std::memcpy(&header, bytes.data(), sizeof(header));
  // Counts are compared with the size before they are multiplied.
  if (std::memcmp(header.magic, layout::magic, sizeof(layout::magic)) != 0 ||
      header.file_bytes != bytes.size() || header.clusters > bytes.size())
    return false;
  size_t at = sizeof(header);
  const auto next = [&]<typename T>(std::span<const T>& values, uint64_t count) {
    if (count > (bytes.size() - at) / sizeof(T)) return false;
    values = {reinterpret_cast<const T*>(bytes.data() + at), static_cast<size_t>(count)};
    at += values.size_bytes();
    return true;
  };
  std::span<const layout::Window> of_windows;
  std::span<const layout::Ring> of_rings;
  if (!next(of_windows, header.windows) || !next(of_rings, header.rings) ||
      !next(clusters, header.clusters) || !next(bounds, header.clusters))
    return false;
  if (header.digest != layout::index_digest(header, bytes.data() + sizeof(header), at - sizeof(header)))
    return false;
  for (size_t c = 0; c < clusters.size(); ++c) {
    const layout::Cluster& cluster = clusters[c];
    if (cluster.at % alignof(OccluderBody) != 0 || cluster.at < at || cluster.at > bytes.size() ||
        layout::block_bytes(cluster) > bytes.size() - cluster.at || !near_enough(bounds[c]))
      return false;
  }
  return read_rings(of_windows, of_rings);
}

bool ClusteredOccluders::State::read_rings(std::span<const layout::Window> of_windows,
                                           std::span<const layout::Ring> of_rings) {
  size_t ring = 0, cluster = 0;
  for (const layout::Window& w : of_windows) {
    ClusteredWindow window{{w.half_extent_m[0], w.half_extent_m[1], w.half_extent_m[2]}, {}};
    if (w.rings > of_rings.size() - ring) return false;
    for (const size_t end = ring + w.rings; ring < end; ++ring) {
      const layout::Ring& r = of_rings[ring];
      if (!(r.h_m > 0 && r.depth_limit_m <= most_pixels * r.h_m) || r.clusters > clusters.size() - cluster)
        return false;
      window.rings.push_back(
          {r.h_m, r.depth_limit_m, static_cast<uint32_t>(cluster), bounds.subspan(cluster, r.clusters)});
      cluster += r.clusters;
    }
    half_extents_m.push_back(window.half_extent_m);
    windows.push_back(std::move(window));
  }
  return ring == of_rings.size() && cluster == clusters.size() && cluster <= UINT32_MAX;
}

ClusteredOccluders::ClusteredOccluders(const std::vector<WindowOccluders>& windows)
    : state_(std::make_shared<State>(windows)) {}

ClusteredOccluders ClusteredOccluders::map(const std::filesystem::path& file) {
  return ClusteredOccluders(std::make_shared<State>(file));
}

const std::vector<ClusteredWindow>& ClusteredOccluders::windows() const {
  return state_->windows;
}

const std::vector<glm::dvec3>& ClusteredOccluders::half_extents_m() const {
  return state_->half_extents_m;
}

OccluderCluster ClusteredOccluders::cluster(uint32_t number) const {
  State& s = *state_;
  const layout::Cluster& entry = s.clusters[number];
  const std::byte* at = s.bytes.data() + entry.at;
  OccluderCluster found;
  found.bodies = {reinterpret_cast<const OccluderBody*>(at), size_t{entry.bodies} + 1};
  found.polygons = {reinterpret_cast<const OccluderPolygon*>(found.bodies.data() + found.bodies.size()),
                    size_t{entry.polygons} + 1};
  found.corners = reinterpret_cast<const glm::vec3*>(found.polygons.data() + found.polygons.size());
  if (!s.checked[number]) {
    if (layout::block_digest(at, layout::block_bytes(entry)) != entry.digest ||
        !well_formed(found, entry.corners))
      s.damaged();
    s.checked[number] = true;
  }
  return found;
}

OccluderMesh ClusteredOccluders::mesh(const ClusteredRing& ring) const {
  OccluderMesh mesh;
  for (uint32_t c = 0; c < ring.bounds.size(); ++c) {
    const OccluderCluster found = cluster(ring.first_cluster + c);
    for (size_t b = 0; b < found.count(); ++b) {
      for (uint32_t p = found.bodies[b].first_polygon; p < found.bodies[b + 1].first_polygon; ++p) {
        const glm::vec3* corners = found.corners;
        mesh.add_face(
            {corners + found.polygons[p].first_corner, corners + found.polygons[p + 1].first_corner});
      }
      mesh.end_body();
    }
  }
  return mesh;
}

std::vector<WindowOccluders> ClusteredOccluders::meshes() const {
  std::vector<WindowOccluders> all;
  for (const ClusteredWindow& window : windows()) {
    WindowOccluders& copy = all.emplace_back(WindowOccluders{window.half_extent_m, {}});
    for (const ClusteredRing& ring : window.rings)
      copy.rings.push_back({ring.h_m, ring.depth_limit_m, mesh(ring)});
  }
  return all;
}

void write_clustered_occluders(const std::filesystem::path& file,
                               const std::vector<WindowOccluders>& windows) {
  std::ofstream out(file, std::ios::binary);
  layout::write(out, windows);
  out.close();
  if (!out) throw Error(ExitStatus::input_output, file.string() + ": cannot be written; is the disk full?");
}

}  // namespace veduta
