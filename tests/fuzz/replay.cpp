// replay FILE-OR-FOLDER...: every file through the fuzzing target, without libFuzzer. Status 0 when all of
// them were read or refused as they should be.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/fuzz/fuzz_target.h"

namespace {

using std::filesystem::path;

std::vector<path> files_of(int count, char** names) {
  std::vector<path> files;
  for (int i = 0; i < count; ++i) {
    if (!std::filesystem::is_directory(names[i]))
      files.emplace_back(names[i]);
    else
      for (const auto& entry : std::filesystem::directory_iterator(names[i]))
        if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

int main(int argc, char** argv) {
  int failed = 0, replayed = 0;
  for (const path& file : files_of(argc - 1, argv + 1)) {
    std::ifstream in(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    if (!in) {
      std::fprintf(stderr, "%s: cannot be read\n", file.c_str());
      return 2;
    }
    try {
      LLVMFuzzerTestOneInput(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s: %s\n", file.c_str(), error.what());
      ++failed;
    }
    ++replayed;
  }
  std::printf("%d files replayed, %d failed\n", replayed, failed);
  return failed == 0 && replayed > 0 ? 0 : 1;
}
