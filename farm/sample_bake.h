// Some cells of a prepared city baked by one worker with the clock running.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "farm/lone_worker.h"
#include "pvs/run_paths.h"
#include "pvs/shard.h"

namespace veduta {

struct SampleBake {
  std::string renderer;
  double open_s = 0;           ///< until the worker could begin
  double ms = 0, core_ms = 0;  ///< of all cells: by the clock, and of all its threads
  std::vector<CellRecord> records;
};

/// Bakes cells of a prepared run with its settings. The first is baked twice: shaders are compiled and
/// buffers made in a time that nobody asks for.
/// \param worker has been started for this. \param progress how many cells are done.
/// \throw Error as LoneWorker.
SampleBake bake_sample(LoneWorker& worker, const RunPaths& run, const std::vector<uint32_t>& cells,
                       const std::function<void(size_t done)>& progress);

}  // namespace veduta
