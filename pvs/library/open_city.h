// What an open veduta::pvs::City holds.
#pragma once

#include <filesystem>
#include <vector>

#include "pvs/library/veduta/pvs.h"
#include "pvs/pvs_stream.h"

namespace veduta::pvs {

struct [[gnu::visibility("hidden")]] City::Open {
  Open(const std::filesystem::path& file, uint64_t memory_bytes);

  PvsStream stream;
  std::vector<Object> objects;  ///< [N]
  PvsRow row;                   ///< that was read last
};

}  // namespace veduta::pvs
