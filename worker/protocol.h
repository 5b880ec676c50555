// Frames between a shepherd and its worker child, over the child's standard input and output.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace veduta {

/// The stages of the preparation, in order (worker/preparation.h): `flood` and `cells` have a part for each
/// tile, `shrink` one for each block, `import` and `finish` one.
enum class Stage : uint32_t { import, flood, cells, shrink, finish };
inline constexpr std::array<const char*, 5> stage_names{"import", "flood", "cells", "shrink", "finish"};
inline constexpr const char* name_of(Stage stage) {
  return stage_names[static_cast<size_t>(stage)];
}
/// A flood lets more into neighbours only: that many tiles at most are named to be flooded again.
inline constexpr size_t neighbour_limit = 8;

/// What a frame says. Control payloads are JSON objects with the members listed; cell_baked carries an
/// encoded CellRecord.
enum class Verb : uint32_t {
  // shepherd to worker
  prepare = 1,  ///< {"directory", "stage", "part", "threads"}: do this part, answer `prepared`; what passes
                ///< between parts lies in prepared.tmp/
  open = 2,     ///< {"directory"}: load prepared/, make a GL context, answer `opened`
  bake = 3,     ///< {"cells": [u32...]}: answer one `cell_baked` per cell, in order, then `lease_done`
  quit = 4,     ///< {}: leave with status 0 (closing standard input means the same)
  // worker to shepherd
  hello = 16,       ///< {"pid", "version"}: sent first
  prepared = 17,    ///< {"stage", "part", "seconds", "peak_mb", "notes": [text...]}; besides `import`:
                    ///< {"tiles", "blocks"}, `flood`: {"again": [tiles...]}, `finish`: {"cells", "objects",
                    ///< "triangles"}
  opened = 18,      ///< {"renderer", "cells"}
  cell_baked = 19,  ///< encode(CellRecord)
  lease_done = 20,  ///< {}
  failed = 21,      ///< {"status", "message", "again"}: an Error; the worker then leaves with that status.
                    ///< `again`: for want of memory, so that another try is worth it
};

/// On the wire: u32 magic, u32 verb, u64 payload length, payload; little-endian.
struct Frame {
  Verb verb{};
  std::vector<std::byte> payload;
  std::string text() const { return {reinterpret_cast<const char*>(payload.data()), payload.size()}; }
};

inline constexpr uint32_t frame_magic = 0x31544456;        // "VDT1"
inline constexpr uint64_t frame_payload_limit = 1u << 28;  // 256 MiB: more is a damaged stream
inline constexpr int protocol_version = 3;

std::vector<std::byte> encode_frame(Verb verb, const std::byte* payload, size_t size);
std::vector<std::byte> encode_frame(Verb verb, const std::string& json);

/// Blocking. nullopt at end of stream. \throw Error(defect) on a damaged stream, Error(input_output) on a
/// read error.
std::optional<Frame> read_frame(int descriptor);
/// Blocking; writes all. \throw Error(input_output).
void write_frame(int descriptor, const std::vector<std::byte>& encoded);

/// Takes bytes as they come (for a shepherd that polls several children) and gives whole frames out.
class FrameBuffer {
 public:
  void append(const std::byte* data, size_t size) { bytes_.insert(bytes_.end(), data, data + size); }
  /// \throw Error(defect) on a damaged stream.
  std::optional<Frame> next();

 private:
  std::vector<std::byte> bytes_;
  size_t begin_ = 0;
};

}  // namespace veduta
