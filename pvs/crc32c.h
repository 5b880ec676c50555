// CRC-32C (Castagnoli), as in iSCSI and ext4: what a shard's records are checked by.
#pragma once

#include <cstddef>
#include <cstdint>

namespace veduta {

/// CRC-32C of bytes [data, data+size). crc32c("123456789") == 0xE3069283.
uint32_t crc32c(const void* data, size_t size);

/// The same, slowly: where the processor has no instruction for it, and what that is tested against.
uint32_t crc32c_by_table(const void* data, size_t size);

}  // namespace veduta
