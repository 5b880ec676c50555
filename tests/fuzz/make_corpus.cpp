// make_corpus DIRECTORY: small files of every kind, for the fuzzer to begin with and for tests to damage.
#include <cstdio>
#include <exception>
#include <filesystem>

#include "tests/fuzz/corpus_cities.h"

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::fprintf(stderr, "usage: make_corpus DIRECTORY\n");
    return 2;
  }
  std::filesystem::create_directories(argv[1]);
  veduta::test::write_corpus(argv[1]);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "make_corpus: %s\n", error.what());
  return 1;
}
