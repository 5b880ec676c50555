// Measured times of view-cells, for benchmarks of the farm.
#pragma once

#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace veduta::bench {

/// Seconds, from a file of microseconds, one a line, as /cells/bake_us of a file has them; lines with # are
/// comments. \throw std::runtime_error.
inline std::vector<double> read_cell_times(const std::string& name) {
  std::ifstream file(name);
  std::vector<double> seconds;
  for (std::string line; std::getline(file, line);)
    if (!line.empty() && line.front() != '#') seconds.push_back(1e-6 * std::stod(line));
  if (seconds.empty()) throw std::runtime_error(name + ": no times of cells");
  return seconds;
}

}  // namespace veduta::bench
