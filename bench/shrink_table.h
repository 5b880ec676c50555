// The table of docs/shrinking.md, from the answers of the benchmark.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace veduta::bench {

/// Markdown. \throw std::exception for a file that holds no answer.
std::string shrink_table(const std::vector<std::filesystem::path>& files);

}  // namespace veduta::bench
