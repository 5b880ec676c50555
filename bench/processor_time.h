// Time that does not pass while others have the machine.
#pragma once

#include <ctime>

namespace veduta::bench {

/// Seconds of processor time that this process has used, all threads together.
inline double processor_s() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace veduta::bench
