// How much memory this process has taken.
#pragma once

#include <fstream>
#include <string>

namespace veduta {

/// At most at a time so far, in MB, as the kernel counted it; 0 where it does not say.
inline double peak_memory_mb() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return std::stod(line.substr(6)) * 1.024e-3;
  return 0;
}

}  // namespace veduta
