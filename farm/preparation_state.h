// How far a preparation has come, in its folder, so that it can be continued.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "pvs/run_paths.h"
#include "worker/protocol.h"

namespace veduta {

/// What a stopped preparation does not have to do again. Parts are done when their files are synced.
struct PreparationState {
  Stage stage = Stage::import;  ///< the stages before it are done
  uint32_t tiles = 0, blocks = 0;
  std::vector<uint32_t> done;  ///< parts of the stage; none of a flood, which is only done as a whole
};

/// Syncs what the parts have written first. The state lies beside what the import wrote, and removed with
/// that. \throw Error(input_output).
void write_preparation_state(const RunPaths& run, const PreparationState& state);
/// nullopt when there is nothing to continue.
std::optional<PreparationState> read_preparation_state(const RunPaths& run);

}  // namespace veduta
