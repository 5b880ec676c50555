// Cells baked by one occlusion method, with the clock running.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/occlusion_job.h"
#include "worker/occlusion_method.h"

namespace veduta::bench {

/// One cell baked by itself: what somebody waits who asks for one.
struct CellCost {
  double ms = 0;  ///< row included; the least of all repeats
  uint64_t parts = 0;
  size_t row_objects = 0;
  float overestimate = 0;  ///< certified; 0: nobody looked
};

struct MethodRun {
  std::string method, renderer, gl_version;
  double set_up_s = 0;            ///< context, buffers, and a first cell that counts nowhere
  std::vector<CellCost> cells;    ///< as asked for
  double together_ms_a_cell = 0;  ///< all cells in one call, as a worker's lease; the least of all repeats
  // One more pass in which stages are told apart, which makes it slower:
  double staged_ms_a_cell = 0;
  double rows_ms = 0;        ///< of all cells: turning answers into rows
  OcclusionCounters staged;  ///< of that pass
};

/// Makes a GL context and the method, and bakes the cells: each by itself, then all together, `repeats`
/// times, then once more in stages. \throw Error(usage) without a usable EGL.
MethodRun run_method(const std::string& method, const PreparedCity& prepared, std::span<const uint32_t> cells,
                     const OcclusionJob& job);

}  // namespace veduta::bench
