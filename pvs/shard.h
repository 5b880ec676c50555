// Shards: append-only result files, one per worker and attempt (DESIGN §8). Not HDF5: those do not open after
// a kill.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "pvs/visibility.h"

namespace veduta {

/// What a worker says of one cell.
struct CellRecord {
  uint32_t cell = 0;
  CellStatus status = CellStatus::baked;
  uint32_t bake_us = 0;
  PvsRow row;
  float overestimate = 0;  ///< certified: see certified_overestimate in pvs/visibility.h; 0: nobody looked
  /// Same answer, whatever the time it took, and whatever the over-estimate: two kinds of CPU may differ in
  /// a ray that grazes an edge, and both bounds hold.
  bool same_answer(const CellRecord& other) const { return status == other.status && row == other.row; }
};

/// The payload of a record, little-endian: u32 cell, u8 status, u32 bake_us, f32 overestimate, u32 count,
/// then per entry u32 object, i8[3].
std::vector<std::byte> encode(const CellRecord& record);
/// \throw Error(bad_input) when the bytes are not exactly one record.
CellRecord decode_cell_record(const std::byte* data, size_t size);

/// Appends records to a new shard. Each is one write: length, payload, CRC32C over both. Synced by `sync()`.
class ShardWriter {
 public:
  /// Creates FILE with a header (magic, version, fingerprint).
  /// \throw Error(input_output) when it exists or cannot be made.
  ShardWriter(const std::filesystem::path& file, const std::string& fingerprint, const std::string& renderer);
  ~ShardWriter();
  ShardWriter(const ShardWriter&) = delete;
  ShardWriter& operator=(const ShardWriter&) = delete;

  /// \throw Error(input_output) when the disk is full; the file is then cut back to its last whole record.
  void append(const CellRecord& record);
  /// fdatasync when something was appended since the last one.
  void sync();
  uint64_t bytes() const { return bytes_; }

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
  uint64_t bytes_ = 0;
  bool dirty_ = false;
};

/// What reading a shard found.
struct ShardScan {
  std::string renderer;
  uint64_t records = 0;
  uint64_t valid_bytes = 0;  ///< length of the longest valid prefix
  uint64_t torn_bytes = 0;   ///< what follows it: a torn tail, to be baked again
};

/// Reads the longest valid prefix and hands out its records in order. The file is not changed.
/// A shard whose header itself is torn (shorter than a header) counts as empty.
/// \throw Error(other_job) when the header's fingerprint is another; Error(bad_input) when a damaged record
/// is followed by
///   a valid one (damage in the middle: file and byte offset are named); Error(input_output) when it cannot
///   be read.
ShardScan scan_shard(const std::filesystem::path& file, const std::string& fingerprint,
                     const std::function<void(CellRecord&&, uint64_t offset)>& visit);

/// Reads records whose offsets `scan_shard` gave, keeping the file open.
class ShardReader {
 public:
  /// \throw Error(input_output) when the file cannot be opened.
  explicit ShardReader(const std::filesystem::path& file);
  ~ShardReader();
  ShardReader(ShardReader&&) noexcept;
  ShardReader& operator=(ShardReader&&) noexcept;

  /// \throw Error(bad_input) when the record is not there any more.
  CellRecord read(uint64_t offset);

 private:
  struct File;
  std::unique_ptr<File> file_;
};

}  // namespace veduta
