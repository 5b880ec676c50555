// 3,000 damaged or hostile files through read_pvs and through PvsStream: each is refused in one line, or
// reads as what was written. VEDUTA_MUTANTS sets how many.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <random>

#include "tests/fuzz/corpus_cities.h"
#include "tests/fuzz/hdf5_blocks.h"
#include "tests/fuzz/memory_file.h"
#include "tests/fuzz/pieces.h"
#include "tests/fuzz/read_every_way.h"

#ifdef __SANITIZE_ADDRESS__
/// HDF5 1.10 leaks when it refuses a file. Our own leaks are still found.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libhdf5";
}
#endif

namespace veduta::test {
namespace {

using Random = std::mt19937;

int mutants(double share) {
#if defined(__SANITIZE_ADDRESS__)
  constexpr int usual = 600;
#else
  constexpr int usual = 3000;
#endif
  const char* const asked = std::getenv("VEDUTA_MUTANTS");
  return std::max(1, static_cast<int>((asked ? std::atoi(asked) : usual) * share));
}

double processor_s() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// A file that is right, and where in it damage may do something.
struct Original {
  std::string name, bytes;
  PvsFile content;
  std::vector<size_t> used;  ///< bytes that are not zero: most zeros are room that HDF5 keeps for more
  std::vector<Block> metadata, chunks;
  Pieces pieces;

  explicit Original(const std::filesystem::path& file)
      : name(file.filename()),
        bytes(read_bytes(file)),
        content(read_pvs(file)),
        metadata(metadata_blocks(bytes)),
        chunks(stored_chunks(file)),
        pieces(take_apart(file)) {
    for (size_t i = 0; i < bytes.size(); ++i)
      if (bytes[i] != 0) used.push_back(i);
  }
  size_t any_used(Random& random) const { return used[random() % used.size()]; }
  /// Some bytes around one that is used.
  Block any_run(size_t longest, Random& random) const {
    const size_t length = 1 + random() % longest;
    return {std::min(any_used(random), bytes.size() - length), length};
  }
};

class PvsMutants : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const TemporaryDirectory directory;
    write_corpus(directory.path());
    originals_ = new std::vector<Original>;
    for (const char* name : {"verified", "small", "wide", "no_rows_baked"})
      originals_->emplace_back(directory / (std::string(name) + ".pvs.h5"));
  }
  static void TearDownTestSuite() { delete originals_; }

  struct Found {
    int made = 0, whole = 0, opening = 0, streaming = 0;  ///< mutants; refused by each
  };

  /// Makes a share of all mutants and reads each of them.
  /// \param faithful  damage, which must not change what is read
  Found run(double share, unsigned seed, bool faithful,
            const std::function<void(const Original&, std::string&, Random&)>& mutate) {
    Random random(seed);
    Found found;
    for (int i = 0; i < mutants(share) && !HasFailure(); ++i) {
      const Original& original = (*originals_)[i % 4 == 3 ? 1 + random() % 3 : 0];
      SCOPED_TRACE("mutant " + std::to_string(i) + " of " + original.name);
      std::string bytes = original.bytes;
      mutate(original, bytes, random);
      if (bytes == original.bytes) continue;
      ++found.made;
      read(original, bytes, faithful, found);
    }
    std::printf("%d mutants: read_pvs refuses %d; PvsStream %d at its opening, %d later\n", found.made,
                found.whole, found.opening, found.streaming);
    return found;
  }

  void read(const Original& original, const std::string& bytes, bool faithful, Found& found) {
    const MemoryFile file(bytes);
    const double begin_s = processor_s();
    try {
      const Reading reading = read_every_way(file.path());
      found.whole += !reading.whole;
      if (bytes == original.bytes) {
        EXPECT_EQ(reading.whole_error + reading.stream_error, "");
      }
      found.opening += !reading.stream_opened;
      found.streaming += reading.stream_opened && !reading.streamed;
      if (reading.whole && faithful) {
        EXPECT_EQ(difference(*reading.whole, original.content), "");
      }
      if (reading.streamed && faithful) {
        EXPECT_EQ(difference(*reading.streamed, original.content), "");
      }
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what() << "; " << what_;
    }
    EXPECT_LT(processor_s() - begin_s, 20) << "a hang, or nearly";
    if (HasFailure()) write_bytes("failed.pvs.h5", bytes);
  }

  std::string what_;  ///< was done to make the mutant, where it can be said
  static std::vector<Original>* originals_;
};

std::vector<Original>* PvsMutants::originals_ = nullptr;

TEST_F(PvsMutants, OriginalsAreReadAsTheyWereWritten) {
  for (const Original& original : *originals_) {
    SCOPED_TRACE(original.name);
    Found found;
    read(original, original.bytes, true, found);
    EXPECT_EQ(found.whole + found.opening + found.streaming, 0);
    EXPECT_GT(original.metadata.size(), 40u);
    EXPECT_GT(original.chunks.size(), 20u);
    std::string mended = original.bytes;
    mend_metadata(mended, original.metadata);
    for (const Block& chunk : original.chunks) mend_chunk(mended, chunk);
    EXPECT_EQ(mended, original.bytes);
  }
}

TEST_F(PvsMutants, BitFlips) {
  const Found found = run(0.2, 1, true, [](const Original& original, std::string& bytes, Random& random) {
    for (unsigned flips = 1 + (random() % 4 == 0 ? random() % 8 : 0); flips-- > 0;) {
      char& byte = bytes[original.any_used(random)];
      byte = static_cast<char>(byte ^ (1 << random() % 8));
    }
  });
  EXPECT_GT(found.whole, found.made / 3);
  EXPECT_GT(found.opening, found.made / 4);
}

TEST_F(PvsMutants, RunsOfZerosOnesAndRubbish) {
  const Found found = run(0.1, 2, true, [](const Original& original, std::string& bytes, Random& random) {
    const Block run = original.any_run(size_t{1} << random() % 12, random);
    const unsigned kind = random() % 3;
    for (size_t k = run.at; k < run.at + run.length; ++k)
      bytes[k] = static_cast<char>(kind == 0 ? 0 : kind == 1 ? 0xff : random());
  });
  EXPECT_GT(found.whole, found.made / 3);
}

TEST_F(PvsMutants, CutsInsertionsAndDeletions) {
  const Found found = run(0.1, 3, true, [](const Original& original, std::string& bytes, Random& random) {
    const Block run = original.any_run(64, random);
    switch (random() % 3) {
      case 0:
        bytes.resize(random() % bytes.size());
        break;
      case 1:
        bytes.insert(run.at, run.length, static_cast<char>(random()));
        break;
      default:
        bytes.erase(run.at, run.length);
    }
  });
  EXPECT_EQ(found.whole, found.made);
  EXPECT_EQ(found.opening + found.streaming, found.made);
}

TEST_F(PvsMutants, PagesMovedSwappedOrLost) {
  const Found found = run(0.1, 4, true, [](const Original& original, std::string& bytes, Random& random) {
    const size_t page = size_t{64} << random() % 7;
    const size_t a = original.any_used(random) / page * page, b = original.any_used(random) / page * page;
    const size_t length = std::min(page, bytes.size() - std::max(a, b));
    const std::string of_a = bytes.substr(a, length);
    if (random() % 2 == 0) bytes.replace(a, length, bytes.substr(b, length));
    bytes.replace(b, length, of_a);
  });
  EXPECT_GT(found.whole, found.made / 2);
}

TEST_F(PvsMutants, ChunksSwapped) {
  const Found found = run(0.05, 5, true, [](const Original& original, std::string& bytes, Random& random) {
    const Block a = original.chunks[random() % original.chunks.size()];
    const Block b = original.chunks[random() % original.chunks.size()];
    const size_t length = std::min(a.length, b.length);
    const std::string of_a = bytes.substr(a.at, length);
    bytes.replace(a.at, length, bytes.substr(b.at, length));
    bytes.replace(b.at, length, of_a);
  });
  EXPECT_GT(found.whole, found.made / 2);
}

/// What unpacks to something else, though its checksum holds: digests are left.
TEST_F(PvsMutants, PackedBytesChangedUnderTheirChecksum) {
  const Found found = run(0.1, 6, false, [](const Original& original, std::string& bytes, Random& random) {
    const Block chunk = original.chunks[random() % original.chunks.size()];
    for (unsigned flips = 1 + random() % 3; flips-- > 0;) {
      char& byte = bytes[chunk.at + random() % (chunk.length - 4)];
      byte = static_cast<char>(byte ^ (1 << random() % 8));
    }
    mend_chunk(bytes, chunk);
  });
  EXPECT_GT(found.whole, found.made * 9 / 10);
}

/// Hostile: HDF5 believes it.
TEST_F(PvsMutants, MetadataChangedUnderItsChecksum) {
  const Found found = run(0.15, 7, false, [](const Original& original, std::string& bytes, Random& random) {
    const Block block = original.metadata[random() % original.metadata.size()];
    for (unsigned changes = 1 + random() % 3; changes-- > 0;) {
      char& byte = bytes[block.at + random() % (block.length - 4)];
      byte = static_cast<char>(random() % 2 == 0 ? byte ^ (1 << random() % 8) : static_cast<int>(random()));
    }
    mend_metadata(bytes, {block});
  });
  EXPECT_GT(found.whole, found.made / 3);
}

/// Every checksum and digest holds: another file, and a wrong one most of the time.
TEST_F(PvsMutants, ValuesChangedUnderTheirDigests) {
  const TemporaryDirectory directory;
  const Found found = run(0.2, 8, false, [&](const Original& original, std::string& bytes, Random& random) {
    Pieces pieces = original.pieces;
    std::string what;
    for (unsigned changes = 1 + random() % 2; changes-- > 0;) what += change(pieces, random) + "; ";
    what_ = what;
    put_together(directory / "changed.pvs.h5", pieces);
    bytes = read_bytes(directory / "changed.pvs.h5");
  });
  EXPECT_GT(found.whole, found.made / 3);
  EXPECT_LT(found.whole, found.made);
}

}  // namespace
}  // namespace veduta::test
