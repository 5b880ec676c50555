// Reading shards. What follows the longest valid prefix is a torn tail when no valid record follows it, and
// damage otherwise: a crash tears only what was written last, so a valid record behind a bad one says that a
// disk or somebody changed the file, and cutting there would lose finished work silently.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <optional>

#include "pvs/crc32c.h"
#include "pvs/shard.h"
#include "pvs/shard_format.h"
#include "scene/error.h"

namespace veduta {

namespace {

/// Reads at offsets through a window, so that neither many small reads nor a large file in memory are needed.
/// It is small at first and after a jump, and grows while reading goes on where it ended.
class Window {
 public:
  Window(const std::filesystem::path& file, uint64_t limit) : file_(file), limit_(limit) {
    descriptor_ = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    struct stat status {};
    if (descriptor_ < 0 || ::fstat(descriptor_, &status) != 0) {
      const int error = errno;
      if (descriptor_ >= 0) ::close(descriptor_);
      throw Error(ExitStatus::input_output,
                  fmt::format("{}: cannot open: {}", file.string(), std::strerror(error)));
    }
    size_ = static_cast<uint64_t>(status.st_size);
  }
  ~Window() { ::close(descriptor_); }
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  uint64_t size() const { return size_; }

  /// Bytes [offset, offset+count), valid until the next call; nullptr when the file is shorter.
  const std::byte* at(uint64_t offset, uint64_t count) {
    if (offset > size_ || count > size_ - offset) return nullptr;
    if (offset < begin_ || offset + count > begin_ + bytes_.size()) fill(offset, count);
    return offset + count <= begin_ + bytes_.size() ? bytes_.data() + (offset - begin_) : nullptr;
  }
  template <typename T>
  std::optional<T> value(uint64_t offset) {
    const std::byte* data = at(offset, sizeof(T));
    if (!data) return {};
    T out;
    std::memcpy(&out, data, sizeof out);
    return out;
  }

 private:
  void fill(uint64_t offset, uint64_t count) {
    const bool goes_on = offset >= begin_ && offset <= begin_ + bytes_.size();
    ahead_ = goes_on ? std::min(4 * ahead_, limit_) : std::min(first_ahead, limit_);
    begin_ = offset;
    bytes_.resize(std::min(std::max(count, ahead_), size_ - offset));
    size_t done = 0;
    while (done < bytes_.size()) {
      const ssize_t got =
          ::pread(descriptor_, bytes_.data() + done, bytes_.size() - done, static_cast<off_t>(offset + done));
      if (got < 0 && errno == EINTR) continue;
      if (got < 0)
        throw Error(ExitStatus::input_output, fmt::format("{}: cannot read at byte {}: {}", file_.string(),
                                                          offset + done, std::strerror(errno)));
      if (got == 0) break;  // somebody cut the file meanwhile: what is not there is not valid
      done += static_cast<size_t>(got);
    }
    bytes_.resize(done);
  }

  static constexpr uint64_t first_ahead = 1 << 13;
  std::filesystem::path file_;
  uint64_t limit_;
  int descriptor_ = -1;
  uint64_t size_ = 0, begin_ = 0, ahead_ = first_ahead / 4;
  std::vector<std::byte> bytes_;
};

struct Payload {
  const std::byte* data;
  size_t size;
};

/// The record at an offset, when its length fits and its checksum holds.
std::optional<Payload> whole_record(Window& file, uint64_t offset) {
  const auto size = file.value<uint32_t>(offset);
  if (!size || !plausible_payload(*size)) return {};
  // The count repeats the length: random bytes rarely agree, which keeps the search for a later record cheap.
  const auto count = file.value<uint32_t>(offset + 4 + record_count_at);
  if (!count || record_payload_minimum + uint64_t{*count} * record_entry_bytes != *size) return {};
  const std::byte* data = file.at(offset, *size + record_frame_bytes);
  if (!data) return {};
  uint32_t stored = 0;
  std::memcpy(&stored, data + 4 + *size, 4);
  if (stored != crc32c(data, 4 + size_t{*size})) return {};
  return Payload{data + 4, *size};
}

std::optional<uint64_t> next_whole_record(Window& file, uint64_t offset) {
  for (; offset + record_payload_minimum + record_frame_bytes <= file.size(); ++offset)
    if (whole_record(file, offset)) return offset;
  return {};
}

[[noreturn]] void refuse_damage(const std::filesystem::path& file, uint64_t bad, uint64_t next) {
  throw Error(
      ExitStatus::bad_input,
      fmt::format(
          "{}: byte {}: damaged, with a valid record behind it at byte {}; restore the file, or move it out "
          "of the run directory and run the bake again: its cells are baked once more",
          file.string(), bad, next));
}

struct Header {
  std::string fingerprint, renderer;
  uint64_t bytes = 0;
};

/// The header, or none when it is torn.
std::optional<Header> read_header(Window& window, const std::filesystem::path& file) {
  if (window.size() < header_fixed_bytes) return {};
  const std::byte* fixed = window.at(0, header_fixed_bytes);
  if (!fixed) return {};
  std::array<uint32_t, 3> number{};  // version, bytes of fingerprint, bytes of renderer
  std::memcpy(number.data(), fixed + shard_magic.size(), sizeof number);
  const bool magic = std::memcmp(fixed, shard_magic.data(), shard_magic.size()) == 0;
  if (magic && number[1] <= header_text_limit && number[2] <= header_text_limit) {
    const size_t size = header_fixed_bytes + number[1] + number[2];
    const std::byte* data = window.at(0, size + 4);
    uint32_t stored = 0;
    if (data) std::memcpy(&stored, data + size, 4);
    if (data && stored == crc32c(data, size)) {
      if (number[0] != shard_version)
        throw Error(ExitStatus::bad_input,
                    fmt::format("{}: shard version {}, this program reads {}; use the version that wrote it",
                                file.string(), number[0], shard_version));
      const char* text = reinterpret_cast<const char*>(data + header_fixed_bytes);
      return Header{{text, number[1]}, {text + number[1], number[2]}, size + 4};
    }
  }
  if (const auto next = next_whole_record(window, 0)) refuse_damage(file, 0, *next);
  // A power loss can leave the length without the bytes: zeros. Anything else without our magic is another's
  // file.
  const bool zeros =
      std::all_of(fixed, fixed + shard_magic.size(), [](std::byte b) { return b == std::byte{0}; });
  if (!magic && !zeros)
    throw Error(ExitStatus::bad_input,
                fmt::format("{}: byte 0: not a shard; remove it from the run directory", file.string()));
  return {};
}

}  // namespace

ShardScan scan_shard(const std::filesystem::path& file, const std::string& fingerprint,
                     const std::function<void(CellRecord&&, uint64_t offset)>& visit) {
  Window window(file, 1 << 18);
  ShardScan scan;
  const auto header = read_header(window, file);
  if (!header) {
    scan.torn_bytes = window.size();
    return scan;
  }
  if (header->fingerprint != fingerprint)
    throw Error(ExitStatus::other_job,
                fmt::format("{}: belongs to another job (fingerprint {}, this job has {}); use another "
                            "--out, or --fresh to start over",
                            file.string(), header->fingerprint, fingerprint));
  scan.renderer = header->renderer;
  uint64_t offset = header->bytes;
  while (const auto payload = whole_record(window, offset)) {
    const uint64_t bytes = payload->size + record_frame_bytes;
    CellRecord record;
    try {
      record = decode_cell_record(payload->data, payload->size);
    } catch (const Error& error) {
      throw Error(ExitStatus::bad_input, fmt::format("{}: byte {}: {}", file.string(), offset, error.what()));
    }
    visit(std::move(record), offset);
    ++scan.records;
    offset += bytes;
  }
  scan.valid_bytes = offset;
  scan.torn_bytes = window.size() - offset;
  if (scan.torn_bytes > 0)
    if (const auto next = next_whole_record(window, offset + 1)) refuse_damage(file, offset, *next);
  return scan;
}

struct ShardReader::File {
  std::filesystem::path path;
  Window window;
};

ShardReader::ShardReader(const std::filesystem::path& file) : file_(new File{file, Window(file, 1 << 16)}) {}
ShardReader::~ShardReader() = default;
ShardReader::ShardReader(ShardReader&&) noexcept = default;
ShardReader& ShardReader::operator=(ShardReader&&) noexcept = default;

CellRecord ShardReader::read(uint64_t offset) {
  const auto payload = whole_record(file_->window, offset);
  if (!payload)
    throw Error(ExitStatus::bad_input,
                fmt::format("{}: byte {}: no valid record there any more; was the file changed "
                            "meanwhile? Run the same command again",
                            file_->path.string(), offset));
  return decode_cell_record(payload->data, payload->size);
}

}  // namespace veduta
