// One point of a sweep: prepared, a sample of its cells baked by one worker with the clock running, verified.
#pragma once

#include <string>
#include <vector>

#include "farm/progress.h"
#include "farm/sweep_grid.h"
#include "pvs/run_paths.h"

namespace veduta {

struct SweepOptions {
  uint32_t cells = 32;
  uint64_t rays_per_cell = 1'000'000;
  uint64_t seed = 1;
  std::string gpu = "auto";
};

/// The fingerprint without what a preparation does not depend on: points of equal keys share one.
std::string preparation_key(const Settings& settings);

/// Prepares the city in a run directory, with one worker for each core of this machine; does nothing where
/// that is done. \return what it took, s, 0 when it was there. \throw Error of the worker.
double prepare_for_sweep(const RunPaths& run, const Settings& settings, Progress& progress);

/// Bakes and verifies in a prepared run directory.
/// \param places what to sample; chosen (and filled in) when empty.
/// \throw Error of the worker, Error(input_output).
SweepPoint sweep_point(const RunPaths& run, const GridPoint& grid, const SweepOptions& options,
                       std::vector<std::array<double, 3>>& places, Progress& progress);

}  // namespace veduta
