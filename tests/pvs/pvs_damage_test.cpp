// A damaged file is an error message or reads as what was written: never a crash, never silently something
// else, never a long wait (R9). VEDUTA_MUTANTS=3000 makes as many instead of the few of every day.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <random>

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

using test::TemporaryDirectory;

/// Reads a file of bytes. \return did it read? What it reads has to be what was written.
bool reads_as(const std::filesystem::path& file, const std::string& bytes, const PvsFile& written) {
  test::write_bytes(file, bytes);
  const auto begin = std::chrono::steady_clock::now();
  const auto took_long = [&] { return std::chrono::steady_clock::now() - begin > std::chrono::seconds(5); };
  try {
    const PvsFile got = read_pvs(file);
    EXPECT_FALSE(took_long());
    EXPECT_EQ(got.content_digest, written.content_digest);
    EXPECT_EQ(got.entries, written.entries);
    EXPECT_EQ(got.row_begin, written.row_begin);
    EXPECT_EQ(got.cell_row, written.cell_row);
    EXPECT_EQ(got.bake_us, written.bake_us);
    EXPECT_EQ(got.overestimate, written.overestimate);
    EXPECT_EQ(got.cell_status, written.cell_status);
    EXPECT_EQ(got.cell_worker, written.cell_worker);
    EXPECT_EQ(got.workers, written.workers);
    EXPECT_EQ(got.city.cells, written.city.cells);
    EXPECT_EQ(got.city.scene.vertices, written.city.scene.vertices);
    EXPECT_EQ(got.city.scene.triangles, written.city.scene.triangles);
    EXPECT_EQ(got.city.scene.origin, written.city.scene.origin);
    EXPECT_EQ(got.city.scene.crs, written.city.scene.crs);
    EXPECT_EQ(got.city.navigation.free.states, written.city.navigation.free.states);
    EXPECT_EQ(got.header.config, written.header.config);
    EXPECT_EQ(got.header.renderer, written.header.renderer);
    EXPECT_EQ(got.header.fingerprint, written.header.fingerprint);
    EXPECT_EQ(got.header.complete, written.header.complete);
    EXPECT_EQ(got.header.conservative, written.header.conservative);
    EXPECT_EQ(got.verification, written.verification);
    return true;
  } catch (const Error& error) {
    EXPECT_FALSE(took_long()) << error.what();
    EXPECT_EQ(error.status(), ExitStatus::bad_input) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return false;
  }
}

/// How many mutants to make: the usual number, or a share of those asked for.
int mutants(int usual, double share) {
  const char* const asked = std::getenv("VEDUTA_MUTANTS");
  return asked ? std::max(1, static_cast<int>(std::atoi(asked) * share)) : usual;
}

struct Written {
  TemporaryDirectory directory;
  std::string bytes;
  std::vector<size_t> used;  ///< bytes that are not zero: most zeros are room that HDF5 keeps for more
  std::vector<size_t> of_verification;  ///< and those of them that storing it wrote
  PvsFile content;
  Written() {
    write_pvs(directory / "a.h5", test::small_city(), test::small_header(), test::small_row_of_worker,
              test::small_workers);
    const std::string before = test::read_bytes(directory / "a.h5");
    store_verification(directory / "a.h5", read_pvs(directory / "a.h5"), test::small_verification());
    bytes = test::read_bytes(directory / "a.h5");
    content = read_pvs(directory / "a.h5");
    for (size_t i = 0; i < bytes.size(); ++i)
      if (bytes[i] != 0) {
        used.push_back(i);
        if (i >= before.size() || bytes[i] != before[i]) of_verification.push_back(i);
      }
  }
  template <typename Random>
  size_t any_used(Random& random) const {
    return used[std::uniform_int_distribution<size_t>(0, used.size() - 1)(random)];
  }
};

TEST(PvsDamage, BitFlips) {
  const Written written;
  std::mt19937 random(3);
  int refused = 0;
  for (int i = 0; i < mutants(300, 0.4) && !HasFailure(); ++i) {
    const size_t bit = 8 * written.any_used(random) + random() % 8;
    SCOPED_TRACE("bit " + std::to_string(bit));
    std::string bytes = written.bytes;
    bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ (1 << (bit % 8)));
    refused += !reads_as(written.directory / "flipped.h5", bytes, written.content);
  }
  RecordProperty("refused", refused);
  EXPECT_GT(refused, mutants(300, 0.4) / 3);
}

TEST(PvsDamage, BitFlipsInAVerification) {
  const Written written;
  ASSERT_GT(written.of_verification.size(), 3000u);
  std::mt19937 random(5);
  int refused = 0;
  for (int i = 0; i < mutants(400, 0.2) && !HasFailure(); ++i) {
    const size_t byte = written.of_verification[random() % written.of_verification.size()];
    SCOPED_TRACE("byte " + std::to_string(byte));
    std::string bytes = written.bytes;
    bytes[byte] = static_cast<char>(bytes[byte] ^ (1 << (random() % 8)));
    refused += !reads_as(written.directory / "flipped.h5", bytes, written.content);
  }
  EXPECT_GT(refused, mutants(400, 0.2) / 2);
}

TEST(PvsDamage, RunsOfRubbish) {
  const Written written;
  std::mt19937 random(4);
  int refused = 0;
  for (int i = 0; i < mutants(100, 0.2) && !HasFailure(); ++i) {
    const size_t length = std::uniform_int_distribution<size_t>(2, 64)(random);
    const size_t first = std::min(written.any_used(random), written.bytes.size() - length);
    SCOPED_TRACE("byte " + std::to_string(first));
    std::string bytes = written.bytes;
    for (size_t k = first; k < first + length; ++k) bytes[k] = static_cast<char>(random());
    refused += !reads_as(written.directory / "rubbish.h5", bytes, written.content);
  }
  EXPECT_GT(refused, mutants(100, 0.2) / 4);
}

/// HDF5 1.10 reads beyond its buffer when a chunk has fewer bytes than its checksum.
TEST(PvsDamage, ChunkShorterThanItsChecksum) {
  const Written written;
  const std::vector<test::ChunkIndex> indices = test::chunk_indices(written.bytes);
  EXPECT_GT(indices.size(), 30u);
  int refused = 0;
  for (const test::ChunkIndex& index : indices) {
    if (!index.has(written.bytes, 0)) continue;
    for (char size = 0; size <= 4; ++size) {
      std::string bytes = written.bytes;
      bytes.replace(index.stored_size(0), index.element_bytes - 12,
                    std::string{size} + std::string(index.element_bytes - 13, '\0'));
      index.mend_sum(bytes);
      EXPECT_FALSE(reads_as(written.directory / "short.h5", bytes, written.content)) << index.at;
      ++refused;
    }
  }
  EXPECT_GT(refused, 150);
}

/// Pages that a disk lost, repeated or mixed up: each is well-formed by itself.
TEST(PvsDamage, PagesMovedOrLost) {
  const Written written;
  std::mt19937 random(6);
  int refused = 0;
  for (int i = 0; i < mutants(60, 0.2) && !HasFailure(); ++i) {
    const size_t page = size_t{64} << random() % 7;
    const auto any_page = [&] { return written.any_used(random) / page * page; };
    const size_t from = any_page(), to = any_page();
    const size_t length = std::min(page, written.bytes.size() - std::max(from, to));
    SCOPED_TRACE(std::to_string(from) + " to " + std::to_string(to));
    std::string bytes = written.bytes;
    const std::string moved = i % 3 == 0 ? std::string(length, '\0') : written.bytes.substr(from, length);
    if (i % 3 == 1) bytes.replace(from, length, written.bytes.substr(to, length));
    bytes.replace(to, length, moved);
    if (bytes != written.bytes) refused += !reads_as(written.directory / "moved.h5", bytes, written.content);
  }
  EXPECT_GT(refused, 20);
}

TEST(PvsDamage, CutAnywhere) {
  const Written written;
  for (size_t i = 0; i < 60; ++i) {
    const size_t size = written.bytes.size() * i / 60;
    EXPECT_FALSE(reads_as(written.directory / "cut.h5", written.bytes.substr(0, size), written.content))
        << size;
  }
  EXPECT_FALSE(reads_as(written.directory / "cut.h5", written.bytes.substr(0, written.bytes.size() - 1),
                        written.content));
}

}  // namespace
}  // namespace veduta
