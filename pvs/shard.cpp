// Writing shards, and the bytes of a record.
//
// File: header, records.
//   header: magic "VEDUTASH", u32 version, u32 bytes of fingerprint, u32 bytes of renderer, fingerprint,
//   renderer, u32 CRC32C
//     of all before. Its layout stays the same in every version, so that a version can be told from damage.
//   record: u32 bytes of payload, payload (encode()), u32 CRC32C of both.
#include "pvs/shard.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "pvs/crc32c.h"
#include "pvs/shard_format.h"
#include "scene/error.h"
#include "scene/sync_path.h"

namespace veduta {

namespace {

template <typename T>
void put(std::vector<std::byte>& out, T value) {
  const size_t at = out.size();
  out.resize(at + sizeof value);
  std::memcpy(out.data() + at, &value, sizeof value);
}

void put_text(std::vector<std::byte>& out, const std::string& text) {
  const auto* bytes = reinterpret_cast<const std::byte*>(text.data());
  out.insert(out.end(), bytes, bytes + text.size());
}

std::vector<std::byte> encode_header(const std::string& fingerprint, const std::string& renderer) {
  std::vector<std::byte> out;
  put_text(out, std::string(shard_magic));
  put(out, shard_version);
  put(out, static_cast<uint32_t>(fingerprint.size()));
  put(out, static_cast<uint32_t>(renderer.size()));
  put_text(out, fingerprint);
  put_text(out, renderer);
  put(out, crc32c(out.data(), out.size()));
  return out;
}

/// 0, or the errno of what failed. Parts of the data may have been written then.
int write_all(int descriptor, const std::vector<std::byte>& data, uint64_t offset) {
  size_t done = 0;
  while (done < data.size()) {
    const ssize_t wrote =
        ::pwrite(descriptor, data.data() + done, data.size() - done, static_cast<off_t>(offset + done));
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote < 0) return errno;
    if (wrote == 0) return ENOSPC;
    done += static_cast<size_t>(wrote);
  }
  return 0;
}

}  // namespace

std::vector<std::byte> encode(const CellRecord& record) {
  std::vector<std::byte> out;
  out.reserve(record_payload_minimum + record.row.size() * record_entry_bytes);
  put(out, record.cell);
  put(out, static_cast<uint8_t>(record.status));
  put(out, record.bake_us);
  put(out, record.overestimate);
  put(out, static_cast<uint32_t>(record.row.size()));
  for (const PvsEntry& entry : record.row) {
    put(out, entry.object);
    put(out, entry.index.x);
    put(out, entry.index.y);
    put(out, entry.index.z);
  }
  return out;
}

CellRecord decode_cell_record(const std::byte* data, size_t size) {
  const auto bad = [](const char* what) {
    return Error(ExitStatus::bad_input, fmt::format("cell record: {}", what));
  };
  if (size < record_payload_minimum) throw bad("shorter than a record");
  CellRecord record;
  uint8_t status = 0;
  uint32_t count = 0;
  std::memcpy(&record.cell, data, 4);
  std::memcpy(&status, data + 4, 1);
  std::memcpy(&record.bake_us, data + 5, 4);
  std::memcpy(&record.overestimate, data + 9, 4);
  std::memcpy(&count, data + record_count_at, 4);
  if (size != record_payload_minimum + uint64_t{count} * record_entry_bytes)
    throw bad("its length is not that of its entries");
  if (status > static_cast<uint8_t>(CellStatus::all_visible)) throw bad("unknown status");
  if (!is_overestimate(record.overestimate)) throw bad("an over-estimate that is neither 0 nor at least 1");
  record.status = static_cast<CellStatus>(status);
  record.row.resize(count);
  const std::byte* at = data + record_payload_minimum;
  for (uint32_t i = 0; i < count; ++i, at += record_entry_bytes) {
    PvsEntry& entry = record.row[i];
    std::memcpy(&entry.object, at, 4);
    std::memcpy(&entry.index, at + 4, 3);
    if (i > 0 && entry.object <= record.row[i - 1].object) throw bad("objects are not in ascending order");
    if (entry.index.nothing()) throw bad("an entry that shows nothing");
  }
  return record;
}

ShardWriter::ShardWriter(const std::filesystem::path& file, const std::string& fingerprint,
                         const std::string& renderer)
    : file_(file) {
  if (fingerprint.size() > header_text_limit || renderer.size() > header_text_limit)
    throw Error(ExitStatus::defect,
                fmt::format("{}: header text longer than {} bytes", file.string(), header_text_limit));
  descriptor_ = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor_ < 0)
    throw Error(ExitStatus::input_output,
                fmt::format("{}: cannot create the shard: {}", file.string(), std::strerror(errno)));
  const std::vector<std::byte> header = encode_header(fingerprint, renderer);
  if (const int error = write_all(descriptor_, header, 0)) {
    ::close(descriptor_);
    ::unlink(file.c_str());
    throw Error(ExitStatus::input_output,
                fmt::format("{}: cannot write the header: {}; free some space and start again", file.string(),
                            std::strerror(error)));
  }
  sync_path(file.has_parent_path() ? file.parent_path() : ".");  // the new name
  bytes_ = header.size();
  dirty_ = true;
}

ShardWriter::~ShardWriter() {
  ::close(descriptor_);
}

void ShardWriter::append(const CellRecord& record) {
  const std::vector<std::byte> payload = encode(record);
  if (payload.size() > record_payload_limit)
    throw Error(ExitStatus::defect,
                fmt::format("{}: cell {}: a record of {} bytes is over the limit of {}", file_.string(),
                            record.cell, payload.size(), record_payload_limit));
  std::vector<std::byte> out;
  out.reserve(payload.size() + record_frame_bytes);
  put(out, static_cast<uint32_t>(payload.size()));
  out.insert(out.end(), payload.begin(), payload.end());
  put(out, crc32c(out.data(), out.size()));
  if (const int error = write_all(descriptor_, out, bytes_)) {
    // Best effort: were the cut to fail as well, the reader would take what is there for a torn tail.
    const bool cut = ::ftruncate(descriptor_, static_cast<off_t>(bytes_)) == 0;
    throw Error(
        ExitStatus::input_output,
        fmt::format(
            "{}: cannot append cell {} at byte {}: {}{}; free some space and run the same command again",
            file_.string(), record.cell, bytes_, std::strerror(error),
            cut ? "" : " (nor cut the file back)"));
  }
  bytes_ += out.size();
  dirty_ = true;
}

void ShardWriter::sync() {
  if (!dirty_) return;
  if (::fdatasync(descriptor_) != 0)
    throw Error(ExitStatus::input_output,
                fmt::format("{}: cannot sync: {}", file_.string(), std::strerror(errno)));
  dirty_ = false;
}

}  // namespace veduta
