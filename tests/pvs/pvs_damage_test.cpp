// A chunk index that lies is an error message. Mutants of all kinds: tests/fuzz/pvs_mutants_test.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "pvs/pvs_file.h"
#include "scene/error.h"
#include "tests/pvs/chunk_index.h"
#include "tests/pvs/small_verification.h"

#ifdef __SANITIZE_ADDRESS__
/// HDF5 1.10 leaks when it refuses a file. Our own leaks are still found.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libhdf5";
}
#endif

namespace veduta {
namespace {

/// HDF5 1.10 reads beyond its buffer when a chunk has fewer bytes than its checksum.
TEST(PvsDamage, ChunkShorterThanItsChecksum) {
  const test::TemporaryDirectory directory;
  write_pvs(directory / "a.h5", test::small_city(), test::small_header(), test::small_row_of_worker,
            test::small_workers);
  store_verification(directory / "a.h5", read_pvs(directory / "a.h5"), test::small_verification());
  const std::string whole = test::read_bytes(directory / "a.h5");
  const std::vector<test::ChunkIndex> indices = test::chunk_indices(whole);
  EXPECT_GT(indices.size(), 30u);
  int refused = 0;
  for (const test::ChunkIndex& index : indices) {
    if (!index.has(whole, 0)) continue;
    for (char size = 0; size <= 4; ++size) {
      std::string bytes = whole;
      bytes.replace(index.stored_size(0), index.element_bytes - 12,
                    std::string{size} + std::string(index.element_bytes - 13, '\0'));
      index.mend_sum(bytes);
      test::write_bytes(directory / "short.h5", bytes);
      EXPECT_EQ(test::status_of([&] { read_pvs(directory / "short.h5"); }), ExitStatus::bad_input)
          << index.at;
      ++refused;
    }
  }
  EXPECT_GT(refused, 150);
}

}  // namespace
}  // namespace veduta
