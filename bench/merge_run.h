// Run directories as large bakes leave them, without the bake.
#pragma once

#include <cstdint>

#include "pvs/run_paths.h"

namespace veduta::bench {

struct MergeCity {
  uint32_t cells = 10000, objects = 20000, triangles_per_object = 4;
  uint32_t entries = 130;  ///< of a row, about: Den Haag has 130, the thesis's city 370
  uint32_t shards = 8;     ///< with up to 10^4: a shard is one worker of one attempt
  uint32_t lease = 16;     ///< consecutive cells that one shard holds
};

/// Writes prepared/city.h5, fingerprint, settings and shards into an empty directory. Rows are runs of
/// objects that slowly change from cell to cell, as those of streets are, and compress as they do (about 6 :
/// 1); every eighth row equals the one before it. \return bytes of all shards.
uint64_t write_merge_run(const RunPaths& run, const MergeCity& city);

}  // namespace veduta::bench
