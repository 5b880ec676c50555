#include "worker/occluder_file.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <cstring>
#include <fstream>

#include "scene/error.h"

namespace veduta {
namespace {

constexpr char magic[8] = {'V', 'D', 'T', 'O', 'C', 'C', '0', '2'};

// The file: magic, number of windows; for each window a header and its rings; for each ring a header and the
// arrays of its occluders; the digest of all that.
struct WindowHeader {
  double half_extent_m[3];
  uint64_t rings;
};
struct RingHeader {
  double h_m;
  float depth_limit_m;
  uint32_t corners, face_begins, body_begins;
};
static_assert(sizeof(WindowHeader) == 32 && sizeof(RingHeader) == 24 && sizeof(glm::vec3) == 12);

/// Writes and digests.
class Sink {
 public:
  explicit Sink(const std::filesystem::path& file) : out_(file, std::ios::binary) {
    XXH3_64bits_reset(&state_);
  }

  void put(const void* data, size_t size) {
    XXH3_64bits_update(&state_, data, size);
    out_.write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
  }
  template <typename T>
  void put_all(const std::vector<T>& values) {
    put(values.data(), values.size() * sizeof(T));
  }
  /// \return whether all of it was written.
  bool finish() {
    const XXH64_hash_t digest = XXH3_64bits_digest(&state_);
    out_.write(reinterpret_cast<const char*>(&digest), sizeof(digest));
    out_.close();
    return static_cast<bool>(out_);
  }

 private:
  std::ofstream out_;
  XXH3_state_t state_;
};

/// Takes from bytes in order; says no when they are not enough, before it allocates.
class Source {
 public:
  Source(const char* begin, const char* end) : at_(begin), end_(end) {}

  bool take(void* data, size_t size) {
    if (static_cast<size_t>(end_ - at_) < size) return false;
    std::memcpy(data, at_, size);
    at_ += size;
    return true;
  }
  template <typename T>
  bool take_all(std::vector<T>& values, size_t count) {
    if (static_cast<size_t>(end_ - at_) / sizeof(T) < count) return false;
    values.resize(count);
    return count == 0 || take(values.data(), count * sizeof(T));
  }
  bool done() const { return at_ == end_; }

 private:
  const char *at_, *end_;
};

/// Do the numbers begin at 0, rise by at least `step` each, and end at `end`?
bool rises(const std::vector<uint32_t>& begin, uint32_t step, size_t end) {
  if (begin.empty() || begin.front() != 0 || begin.back() != end) return false;
  for (size_t n = 1; n < begin.size(); ++n) {
    if (begin[n] < begin[n - 1] || begin[n] - begin[n - 1] < step) return false;
  }
  return true;
}

bool take_ring(Source& source, OccluderRing& ring) {
  RingHeader header{};
  OccluderMesh& mesh = ring.occluders;
  if (!source.take(&header, sizeof(header)) || !source.take_all(mesh.corners, header.corners) ||
      !source.take_all(mesh.face_begin, header.face_begins) ||
      !source.take_all(mesh.body_begin, header.body_begins))
    return false;
  ring.h_m = header.h_m, ring.depth_limit_m = header.depth_limit_m;
  return rises(mesh.face_begin, 3, mesh.corners.size()) && rises(mesh.body_begin, 1, mesh.faces());
}

bool take_windows(Source& source, std::vector<WindowOccluders>& windows) {
  uint64_t count = 0;
  if (!source.take(&count, sizeof(count))) return false;
  for (uint64_t w = 0; w < count; ++w) {
    WindowHeader header{};
    if (!source.take(&header, sizeof(header))) return false;
    const double* e = header.half_extent_m;
    windows.push_back({{e[0], e[1], e[2]}, {}});
    for (uint64_t r = 0; r < header.rings; ++r) {
      if (!take_ring(source, windows.back().rings.emplace_back())) return false;
    }
  }
  return source.done();
}

}  // namespace

void write_occluder_file(const std::filesystem::path& file, const std::vector<WindowOccluders>& windows) {
  Sink sink(file);
  sink.put(magic, sizeof(magic));
  const uint64_t count = windows.size();
  sink.put(&count, sizeof(count));
  for (const WindowOccluders& window : windows) {
    const glm::dvec3& e = window.half_extent_m;
    const WindowHeader window_header{{e.x, e.y, e.z}, window.rings.size()};
    sink.put(&window_header, sizeof(window_header));
    for (const OccluderRing& ring : window.rings) {
      const OccluderMesh& mesh = ring.occluders;
      const RingHeader header{ring.h_m, ring.depth_limit_m, static_cast<uint32_t>(mesh.corners.size()),
                              static_cast<uint32_t>(mesh.face_begin.size()),
                              static_cast<uint32_t>(mesh.body_begin.size())};
      sink.put(&header, sizeof(header));
      sink.put_all(mesh.corners), sink.put_all(mesh.face_begin), sink.put_all(mesh.body_begin);
    }
  }
  if (!sink.finish())
    throw Error(ExitStatus::input_output, file.string() + ": cannot be written; is the disk full?");
}

std::vector<WindowOccluders> read_occluder_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  std::vector<WindowOccluders> windows;
  XXH64_hash_t digest = 0;
  bool good =
      bytes.size() >= sizeof(magic) + sizeof(digest) && std::memcmp(bytes.data(), magic, sizeof(magic)) == 0;
  if (good) {
    const size_t end = bytes.size() - sizeof(digest);
    std::memcpy(&digest, bytes.data() + end, sizeof(digest));
    Source source(bytes.data() + sizeof(magic), bytes.data() + end);
    good = digest == XXH3_64bits(bytes.data(), end) && take_windows(source, windows);
  }
  if (!good)
    throw Error(ExitStatus::bad_input,
                file.string() + ": missing or damaged; remove the folder it is in and bake again");
  return windows;
}

}  // namespace veduta
