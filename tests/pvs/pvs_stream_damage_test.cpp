// Chunk indices that lie, in a file that is read piece by piece, are an error message or change nothing.
// Mutants of all kinds: tests/fuzz/pvs_mutants_test.
#include <gtest/gtest.h>

#include "pvs/pvs_stream.h"
#include "tests/pvs/chunk_index.h"
#include "tests/pvs/small_verification.h"
#include "tests/pvs/stream_compare.h"

#ifdef __SANITIZE_ADDRESS__
/// HDF5 1.10 leaks when it refuses a file. Our own leaks are still found.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libhdf5";
}
#endif

namespace veduta {
namespace {

class PvsStreamDamage : public testing::Test {
 protected:
  PvsStreamDamage() {
    const std::filesystem::path file = directory_ / "a.h5";
    write_pvs(file, test::small_city(), test::small_header(), test::small_row_of_worker, test::small_workers);
    store_verification(file, read_pvs(file), test::small_verification());
    bytes_ = test::read_bytes(file);
    content_ = read_pvs(file);
  }

  test::TemporaryDirectory directory_;
  std::string bytes_;
  PvsFile content_;
};

/// The chunk indices of two datasets, each well-formed by itself, mixed up and their checksums made to hold:
/// where triangles lie is held against bounds that were checked at the opening.
TEST_F(PvsStreamDamage, ChunkIndicesMixedUpDoNotMoveTriangles) {
  const std::vector<test::ChunkIndex> indices = test::chunk_indices(bytes_);
  ASSERT_GT(indices.size(), 30u);
  int refused = 0, refused_late = 0;
  for (const test::ChunkIndex& a : indices)
    for (const test::ChunkIndex& b : indices) {
      if (a.at == b.at || a.element_bytes != b.element_bytes) continue;
      SCOPED_TRACE(std::to_string(a.at) + " from " + std::to_string(b.at));
      std::string bytes = bytes_;
      bytes.replace(a.element(0), a.element_bytes, bytes_.substr(b.element(0), b.element_bytes));
      a.mend_sum(bytes);
      test::write_bytes(directory_ / "mutant.h5", bytes);
      bool opened = false;
      try {
        const PvsStream stream(directory_ / "mutant.h5");
        opened = true;
        const City page = stream.read_objects(0, 6);
        const Scene& scene = content_.city.scene;
        ASSERT_EQ(page.scene.triangles.size(), scene.triangles.size());
        for (size_t t = 0; t < scene.triangles.size(); ++t)
          for (int corner = 0; corner < 3; ++corner)
            ASSERT_EQ(page.scene.vertices[page.scene.triangles[t][corner]],
                      scene.vertices[scene.triangles[t][corner]]);
      } catch (const Error& error) {
        EXPECT_EQ(error.status(), ExitStatus::bad_input) << error.what();
        ++refused;
        refused_late += opened;
      }
    }
  EXPECT_GT(refused, 500);
  EXPECT_GT(refused_late, 10);
}

/// Two chunks of one dataset taken for one another: each holds its own checksum, and every number in it may
/// well be in range. The index has a checksum.
TEST(PvsStreamDamageOfChunks, AnIndexThatNamesTwoChunksTheOtherWayRound) {
  test::TemporaryDirectory directory;
  const auto source = [](uint32_t c) {
    BakedCell cell{CellStatus::baked, c, {}};
    for (uint32_t i = c % 7; i < 30000; i += 7 + c % 13)
      cell.row.push_back({i, {0, 0, static_cast<int8_t>(1 + (c / 50 + i) % 2)}});
    return cell;
  };
  write_pvs(directory / "a.h5", test::small_city(30000, 100), test::small_header(), source);
  const std::string whole = test::read_bytes(directory / "a.h5");
  int swapped = 0;
  for (const test::ChunkIndex& index : test::chunk_indices(whole)) {
    if (!index.has(whole, 1)) continue;
    std::string bytes = whole;
    bytes.replace(index.element(0), index.element_bytes, whole, index.element(1), index.element_bytes);
    bytes.replace(index.element(1), index.element_bytes, whole, index.element(0), index.element_bytes);
    test::write_bytes(directory / "b.h5", bytes);
    std::string message;
    EXPECT_EQ(test::status_of(
                  [&] {
                    const PvsStream stream(directory / "b.h5");
                    stream.read_objects(0, 30001);
                    for (uint32_t row = 0; row + 1 < stream.index().row_begin.size(); ++row)
                      stream.read_row(row);
                  },
                  &message),
              ExitStatus::bad_input)
        << index.at;
    EXPECT_NE(message.find(": its chunk index does not hold"), std::string::npos) << message;
    ++swapped;
  }
  EXPECT_GE(swapped, 6) << "vertices, triangles, their slices, bounds, steps and forms";
}

}  // namespace
}  // namespace veduta
