// How much memory this process has taken.
#pragma once

#include <fstream>
#include <string>

namespace veduta {

/// At most at a time so far, or since it was reset, in MB, as the kernel counted it; 0 where it does not say.
inline double peak_memory_mb() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return std::stod(line.substr(6)) * 1.024e-3;
  return 0;
}

/// From now on the peak is that of what comes; where the kernel does not allow this, it stays that of all.
inline void reset_peak_memory() {
  std::ofstream("/proc/self/clear_refs") << "5";
}

}  // namespace veduta
