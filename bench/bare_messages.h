// A bare loop of MPI messages: what a coordinator that did nothing could answer.
#pragma once

#include <cstdint>

namespace veduta::bench {

struct BareMessages {
  uint64_t tasks = 0;
  double elapsed_s = 0;
  double processor_s = 0;  ///< of rank 0
};

/// Collective. Every rank but 0 asks for `tasks` / (ranks - 1) tasks, `window` requests of 24 bytes at a
/// time; rank 0 answers each with 24 bytes. Needs two ranks and MPI initialised. The figures are those of
/// rank 0.
BareMessages exchange_bare_messages(uint64_t tasks, uint32_t window);

}  // namespace veduta::bench
