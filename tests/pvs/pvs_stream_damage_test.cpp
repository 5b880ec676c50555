// A damaged file that is read piece by piece is an error message or reads as what was written.
// VEDUTA_MUTANTS=3000 makes as many instead of the few of every day.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>

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

enum class Found { nothing, at_opening, while_reading };

/// Reads all of a file in pieces, backwards so that order does not help. What it reads has to be what was
/// written.
Found read(const std::filesystem::path& path, const std::string& bytes, const PvsFile& written) {
  test::write_bytes(path, bytes);
  bool opened = false;
  try {
    PvsStream stream(path);
    opened = true;
    stream.read_navigation();
    test::expect_same_index(stream.index(), written);
    for (size_t row = written.row_begin.size() - 1; row-- > 0;)
      test::expect_same_row(stream, written, static_cast<uint32_t>(row));
    for (auto i = static_cast<uint32_t>(written.city.scene.objects.size()); i-- > 0;)
      test::expect_same_objects(stream, written, i, i + 1);
    return Found::nothing;
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_EQ(error.status(), ExitStatus::bad_input) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_NE(message.find(path.string() + ": /"), std::string::npos) << message;
    return opened ? Found::while_reading : Found::at_opening;
  }
}

class PvsStreamDamage : public testing::Test {
 protected:
  PvsStreamDamage() {
    const std::filesystem::path file = directory_ / "a.h5";
    write_pvs(file, test::small_city(), test::small_header(), test::small_row_of_worker, test::small_workers);
    store_verification(file, read_pvs(file), test::small_verification());
    bytes_ = test::read_bytes(file);
    content_ = read_pvs(file);
    for (size_t i = 0; i < bytes_.size(); ++i)
      if (bytes_[i] != 0) used_.push_back(i);  // most zeros are room that HDF5 keeps for more
  }
  static int mutants(int usual, double share) {
    const char* const asked = std::getenv("VEDUTA_MUTANTS");
    return asked ? std::max(1, static_cast<int>(std::atoi(asked) * share)) : usual;
  }
  Found read_mutant(const std::string& bytes) { return read(directory_ / "mutant.h5", bytes, content_); }

  test::TemporaryDirectory directory_;
  std::string bytes_;
  std::vector<size_t> used_;
  PvsFile content_;
};

TEST_F(PvsStreamDamage, BitFlips) {
  std::mt19937 random(13);
  int at_opening = 0, while_reading = 0;
  const int all = mutants(300, 0.6);
  for (int i = 0; i < all && !HasFailure(); ++i) {
    const size_t byte = used_[random() % used_.size()];
    SCOPED_TRACE("byte " + std::to_string(byte));
    std::string bytes = bytes_;
    bytes[byte] = static_cast<char>(bytes[byte] ^ (1 << (random() % 8)));
    const Found found = read_mutant(bytes);
    at_opening += found == Found::at_opening;
    while_reading += found == Found::while_reading;
  }
  EXPECT_GT(at_opening, all / 4);
  EXPECT_GT(while_reading, 0);
}

TEST_F(PvsStreamDamage, RunsOfRubbish) {
  std::mt19937 random(14);
  int found = 0;
  const int all = mutants(150, 0.4);
  for (int i = 0; i < all && !HasFailure(); ++i) {
    const size_t length = 2 + random() % 63;
    const size_t first = std::min(used_[random() % used_.size()], bytes_.size() - length);
    SCOPED_TRACE("byte " + std::to_string(first));
    std::string bytes = bytes_;
    for (size_t k = first; k < first + length; ++k) bytes[k] = static_cast<char>(random());
    found += read_mutant(bytes) != Found::nothing;
  }
  EXPECT_GT(found, all / 4);
}

TEST_F(PvsStreamDamage, CutAnywhere) {
  for (size_t i = 0; i < 40; ++i)
    EXPECT_NE(read_mutant(bytes_.substr(0, bytes_.size() * i / 40)), Found::nothing) << i;
}

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
