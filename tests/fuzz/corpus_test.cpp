// The files that are committed: the corpus that fuzzing begins with, and what has ever gone wrong.
#include <gtest/gtest.h>

#include "tests/fuzz/memory_file.h"
#include "tests/fuzz/read_every_way.h"
#include "tests/pvs/small_city.h"

namespace veduta::test {
namespace {

std::vector<std::filesystem::path> files_in(const char* folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(VEDUTA_FUZZ_FILES) / folder))
    files.push_back(entry.path());
  return files;
}

/// A corpus of another version of the format would be refused at its first attribute, and test nothing.
TEST(Corpus, IsOfTodaysFormat) {
  const auto files = files_in("corpus");
  EXPECT_GE(files.size(), 5u);
  for (const auto& file : files) {
    const MemoryFile in_memory(read_bytes(file));
    const Reading reading = read_every_way(in_memory.path());
    EXPECT_TRUE(reading.whole) << file << ": " << reading.whole_error
                               << "; docs/fuzzing.md says how to make it anew";
  }
}

TEST(Corpus, WhatWentWrongIsRefused) {
  const auto files = files_in("found");
  EXPECT_GE(files.size(), 2u);
  for (const auto& file : files) {
    const MemoryFile in_memory(read_bytes(file));
    const Reading reading = read_every_way(in_memory.path());
    EXPECT_FALSE(reading.whole) << file;
    EXPECT_NE(reading.whole_error, "") << file;
    EXPECT_EQ(reading.whole_error.find("/@version"), std::string::npos) << file;
  }
}

}  // namespace
}  // namespace veduta::test
