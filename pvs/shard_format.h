// Sizes and limits of the shard format, shared by its writer and its reader.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace veduta {

inline constexpr std::string_view shard_magic = "VEDUTASH";
inline constexpr uint32_t shard_version = 2;            // 1 had no over-estimate
inline constexpr size_t header_fixed_bytes = 20;        // magic, version, two lengths
inline constexpr size_t header_text_limit = 64 * 1024;  // of fingerprint and of renderer
inline constexpr size_t record_count_at = 13;           // behind cell, status, bake_us, overestimate
inline constexpr size_t record_payload_minimum = record_count_at + 4;
inline constexpr size_t record_entry_bytes = 7;             // object, x, y, z
inline constexpr size_t record_frame_bytes = 8;             // length before, CRC after
inline constexpr uint64_t record_payload_limit = 1u << 28;  // 256 MiB, as a frame's: more is damage

/// Can a record have this many bytes of payload?
constexpr bool plausible_payload(uint64_t bytes) {
  return bytes >= record_payload_minimum && bytes <= record_payload_limit &&
         (bytes - record_payload_minimum) % record_entry_bytes == 0;
}

}  // namespace veduta
