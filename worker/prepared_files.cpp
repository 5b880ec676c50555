// prepared/: city.h5 (the file's own layout) and occluders.bin (rings, private to the worker).
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <cstring>
#include <fstream>

#include "pvs/pvs_file.h"
#include "pvs/run_paths.h"
#include "scene/error.h"
#include "scene/sync_path.h"
#include "worker/prepare.h"

namespace veduta {
namespace {

constexpr char occluder_magic[8] = {'V', 'D', 'T', 'O', 'C', 'C', '0', '1'};

struct RingHeader {
  double h_m;
  float depth_limit_m;
  uint32_t boxes;
};
static_assert(sizeof(RingHeader) == 16 && sizeof(Box) == 24);

void append(std::string& bytes, const void* data, size_t size) {
  bytes.append(static_cast<const char*>(data), size);
}

}  // namespace

void write_prepared(const std::filesystem::path& run_directory, const Prepared& prepared) {
  namespace fs = std::filesystem;
  const RunPaths run{run_directory};
  std::error_code error;
  const fs::path temporary = run_directory / "prepared.tmp";
  fs::remove_all(temporary, error);
  if (!fs::create_directory(temporary, error)) {
    throw Error(ExitStatus::input_output, temporary.string() + ": cannot be made: " + error.message());
  }
  write_city(temporary / run.city().filename(), prepared.city);

  std::string bytes(occluder_magic, sizeof(occluder_magic));
  const auto rings = static_cast<uint32_t>(prepared.rings.size());
  append(bytes, &rings, sizeof(rings));
  for (const Ring& ring : prepared.rings) {
    const RingHeader header{ring.h_m, ring.depth_limit_m, static_cast<uint32_t>(ring.boxes.size())};
    append(bytes, &header, sizeof(header));
    append(bytes, ring.boxes.data(), ring.boxes.size() * sizeof(Box));
  }
  const XXH64_hash_t digest = XXH3_64bits(bytes.data(), bytes.size());
  append(bytes, &digest, sizeof(digest));
  const fs::path file = temporary / "occluders.bin";
  std::ofstream out(file, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) throw Error(ExitStatus::input_output, file.string() + ": cannot be written; is the disk full?");
  sync_path(file);
  sync_path(temporary);

  fs::remove_all(run.prepared(), error);
  fs::rename(temporary, run.prepared(), error);
  if (error) throw Error(ExitStatus::input_output, run.prepared().string() + ": " + error.message());
  sync_path(run_directory);
}

std::vector<Ring> read_occluders(const std::filesystem::path& run_directory) {
  const std::filesystem::path file = RunPaths{run_directory}.prepared() / "occluders.bin";
  std::ifstream in(file, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  const auto damaged = [&] {
    return Error(ExitStatus::bad_input,
                 file.string() + ": missing or damaged; remove the folder it is in and bake again");
  };
  XXH64_hash_t digest = 0;
  constexpr size_t least = sizeof(occluder_magic) + sizeof(uint32_t) + sizeof(digest);
  if (bytes.size() < least || std::memcmp(bytes.data(), occluder_magic, sizeof(occluder_magic)) != 0)
    throw damaged();
  const size_t end = bytes.size() - sizeof(digest);
  std::memcpy(&digest, bytes.data() + end, sizeof(digest));
  if (digest != XXH3_64bits(bytes.data(), end)) throw damaged();

  size_t at = sizeof(occluder_magic);
  uint32_t count = 0;
  std::memcpy(&count, bytes.data() + at, sizeof(count));
  at += sizeof(count);
  std::vector<Ring> rings;
  for (uint32_t r = 0; r < count; ++r) {
    RingHeader header{};
    if (end - at < sizeof(header)) throw damaged();
    std::memcpy(&header, bytes.data() + at, sizeof(header));
    at += sizeof(header);
    if ((end - at) / sizeof(Box) < header.boxes) throw damaged();
    Ring ring{header.h_m, header.depth_limit_m, std::vector<Box>(header.boxes)};
    std::memcpy(ring.boxes.data(), bytes.data() + at, header.boxes * sizeof(Box));
    at += header.boxes * sizeof(Box);
    rings.push_back(std::move(ring));
  }
  return rings;
}

}  // namespace veduta
