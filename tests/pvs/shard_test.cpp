#include "pvs/shard.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <cmath>
#include <csignal>
#include <random>

#include "scene/error.h"
#include "tests/pvs/small_city.h"

namespace veduta {
namespace {

using test::read_bytes;
using test::status_of;
using test::TemporaryDirectory;
using test::write_bytes;

const std::string job = "0123456789abcdef0123456789abcdef";

CellRecord record(uint32_t cell) {
  CellRecord r{cell, CellStatus::baked, 100 + cell, {}, 1 + static_cast<float>(cell) / 16};
  for (uint32_t i = 0; i <= cell % 5; ++i) r.row.push_back({7 * i + cell, {static_cast<int8_t>(i), 0, 1}});
  return r;
}

/// A shard of `count` records; the byte after each.
std::vector<uint64_t> write_shard(const std::filesystem::path& file, uint32_t count) {
  ShardWriter writer(file, job, "llvmpipe");
  std::vector<uint64_t> ends{writer.bytes()};
  for (uint32_t c = 0; c < count; ++c) {
    writer.append(record(c));
    ends.push_back(writer.bytes());
  }
  writer.sync();
  return ends;
}

struct Read {
  ShardScan scan;
  std::vector<CellRecord> records;
  std::vector<uint64_t> offsets;
};

Read read(const std::filesystem::path& file, const std::string& fingerprint = job) {
  Read out;
  out.scan = scan_shard(file, fingerprint, [&](CellRecord&& r, uint64_t offset) {
    out.records.push_back(std::move(r));
    out.offsets.push_back(offset);
  });
  return out;
}

TEST(Shard, GivesBackWhatWasAppended) {
  TemporaryDirectory directory;
  const auto ends = write_shard(directory / "a", 50);
  const Read got = read(directory / "a");
  EXPECT_EQ(got.scan.renderer, "llvmpipe");
  EXPECT_EQ(got.scan.records, 50u);
  EXPECT_EQ(got.scan.valid_bytes, ends.back());
  EXPECT_EQ(got.scan.torn_bytes, 0u);
  ASSERT_EQ(got.records.size(), 50u);
  for (uint32_t c = 0; c < 50; ++c) {
    EXPECT_EQ(got.records[c].cell, c);
    EXPECT_EQ(got.records[c].bake_us, 100 + c);
    EXPECT_EQ(got.records[c].overestimate, record(c).overestimate);
    EXPECT_TRUE(got.records[c].same_answer(record(c)));
    EXPECT_TRUE(ShardReader(directory / "a").read(got.offsets[c]).same_answer(record(c)));
  }
  EXPECT_EQ(status_of([&] { ShardReader(directory / "a").read(got.offsets[3] + 1); }), ExitStatus::bad_input);
  EXPECT_EQ(status_of([&] { ShardReader(directory / "a").read(1u << 30); }), ExitStatus::bad_input);
}

TEST(Shard, DecodesExactlyOneRecord) {
  const auto bytes = encode(record(4));
  EXPECT_TRUE(decode_cell_record(bytes.data(), bytes.size()).same_answer(record(4)));
  for (size_t size = 0; size < bytes.size(); ++size)
    EXPECT_EQ(status_of([&] { decode_cell_record(bytes.data(), size); }), ExitStatus::bad_input) << size;
  CellRecord unordered = record(4);
  std::swap(unordered.row[0], unordered.row[1]);
  const auto wrong = encode(unordered);
  EXPECT_EQ(status_of([&] { decode_cell_record(wrong.data(), wrong.size()); }), ExitStatus::bad_input);
  for (const float value : {0.999f, -1.0f, NAN, INFINITY}) {
    CellRecord unfounded = record(4);
    unfounded.overestimate = value;
    const auto encoded = encode(unfounded);
    EXPECT_EQ(status_of([&] { decode_cell_record(encoded.data(), encoded.size()); }), ExitStatus::bad_input)
        << value;
  }
}

TEST(Shard, TheSameAnswerMayHaveAnotherBound) {
  CellRecord other = record(4);
  other.overestimate = 3;
  EXPECT_TRUE(other.same_answer(record(4)));
  other.row.pop_back();
  EXPECT_FALSE(other.same_answer(record(4)));
}

/// R3: every length of the last three records, at least 250 of them.
TEST(Shard, CutAnywhereInTheLastThreeRecordsKeepsTheOthers) {
  TemporaryDirectory directory;
  auto ends = write_shard(directory / "short", 9);
  {
    ShardWriter writer(directory / "a", job, "llvmpipe");
    for (uint32_t c = 0; c < 12; ++c) {
      CellRecord r = record(c);
      if (c >= 9)
        for (uint32_t i = 0; i < 12; ++i) r.row.push_back({1000 + i, completely_visible});
      writer.append(r);
      if (c >= 9) ends.push_back(writer.bytes());
    }
  }
  const std::string whole = read_bytes(directory / "a");
  ASSERT_GE(whole.size() - ends[9], 250u);
  for (uint64_t size = ends[9]; size < whole.size(); ++size) {
    write_bytes(directory / "cut", whole.substr(0, size));
    const Read got = read(directory / "cut");
    uint32_t expected = 9;
    while (ends[expected + 1] <= size) ++expected;
    ASSERT_EQ(got.records.size(), expected) << size;
    ASSERT_EQ(got.scan.torn_bytes, size - ends[expected]) << size;
    // A page that was not written in time leaves zeros up to the length that was.
    write_bytes(directory / "zeros", whole.substr(0, size) + std::string(whole.size() - size, '\0'));
    ASSERT_EQ(read(directory / "zeros").records.size(), expected) << size;
  }
}

TEST(Shard, CutInItsHeaderIsEmpty) {
  TemporaryDirectory directory;
  const auto ends = write_shard(directory / "a", 1);
  const std::string whole = read_bytes(directory / "a");
  for (uint64_t size = 0; size < ends[0]; ++size) {
    write_bytes(directory / "cut", whole.substr(0, size));
    const Read got = read(directory / "cut");
    EXPECT_EQ(got.scan.records, 0u);
    EXPECT_EQ(got.scan.torn_bytes, size);
  }
}

/// R3.
TEST(Shard, EveryBitFlipIsSeen) {
  TemporaryDirectory directory;
  write_shard(directory / "a", 10);
  const std::string whole = read_bytes(directory / "a");
  std::mt19937 random(1);
  int refused = 0, torn = 0;
  for (int i = 0; i < 300; ++i) {
    std::string flipped = whole;
    const size_t bit = std::uniform_int_distribution<size_t>(0, 8 * whole.size() - 1)(random);
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << (bit % 8)));
    write_bytes(directory / "flipped", flipped);
    try {
      const Read got = read(directory / "flipped");
      ASSERT_GT(got.scan.torn_bytes, 0u) << "bit " << bit;
      for (const CellRecord& r : got.records) ASSERT_TRUE(r.same_answer(record(r.cell))) << "bit " << bit;
      ++torn;
    } catch (const Error& error) {
      ASSERT_EQ(error.status(), ExitStatus::bad_input) << error.what();
      ++refused;
    }
  }
  // Damage before the last record must be refused, not cut.
  EXPECT_GT(refused, 200);
  EXPECT_GT(torn, 0);
}

TEST(Shard, DamageInTheMiddleNamesFileAndByte) {
  TemporaryDirectory directory;
  const auto ends = write_shard(directory / "a", 10);
  std::string bytes = read_bytes(directory / "a");
  bytes[ends[4] + 9] = static_cast<char>(bytes[ends[4] + 9] ^ 4);
  write_bytes(directory / "a", bytes);
  std::string message;
  EXPECT_EQ(status_of([&] { read(directory / "a"); }, &message), ExitStatus::bad_input);
  EXPECT_NE(message.find((directory / "a").string()), std::string::npos) << message;
  EXPECT_NE(message.find("byte " + std::to_string(ends[4]) + ":"), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos);
  EXPECT_NE(message.find("move it out of the run directory and run the bake again"), std::string::npos);
}

TEST(Shard, TailOfZerosIsTorn) {
  TemporaryDirectory directory;
  write_shard(directory / "a", 3);
  write_bytes(directory / "zeros", read_bytes(directory / "a") + std::string(4096, '\0'));
  const Read got = read(directory / "zeros");
  EXPECT_EQ(got.records.size(), 3u);
  EXPECT_EQ(got.scan.torn_bytes, 4096u);
  write_bytes(directory / "only", std::string(300, '\0'));
  EXPECT_EQ(read(directory / "only").scan.torn_bytes, 300u);
  write_bytes(directory / "empty", "");
  EXPECT_EQ(read(directory / "empty").scan.records, 0u);
  EXPECT_EQ(read(directory / "empty").scan.torn_bytes, 0u);
}

TEST(Shard, RefusesOtherJobsAndOtherFiles) {
  TemporaryDirectory directory;
  write_shard(directory / "a", 3);
  std::string message;
  EXPECT_EQ(status_of([&] { read(directory / "a", "another"); }, &message), ExitStatus::other_job);
  EXPECT_NE(message.find((directory / "a").string()), std::string::npos);
  write_bytes(directory / "text", "this is a letter to a friend, and no shard at all");
  EXPECT_EQ(status_of([&] { read(directory / "text"); }), ExitStatus::bad_input);
  EXPECT_EQ(status_of([&] { read(directory / "none"); }), ExitStatus::input_output);
}

TEST(Shard, DoesNotOverwriteAndReportsWhereItCannotWrite) {
  TemporaryDirectory directory;
  write_shard(directory / "a", 1);
  EXPECT_EQ(status_of([&] { ShardWriter(directory / "a", job, ""); }), ExitStatus::input_output);
  EXPECT_EQ(status_of([&] { ShardWriter("/dev/full", job, ""); }), ExitStatus::input_output);
  EXPECT_EQ(status_of([&] { ShardWriter(directory / "no" / "a", job, ""); }), ExitStatus::input_output);
}

/// In a child, because a limit on the file size cannot be taken back.
TEST(Shard, FullDiskCutsBackToTheLastWholeRecord) {
  TemporaryDirectory directory;
  const pid_t child = ::fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{1000, 1000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    ShardWriter writer(directory / "a", job, "llvmpipe");
    uint32_t cell = 0;
    const ExitStatus status = status_of([&] {
      for (; cell < 1000; ++cell) writer.append(record(cell));
    });
    const bool good =
        status == ExitStatus::input_output && std::filesystem::file_size(directory / "a") == writer.bytes();
    ::_exit(good ? static_cast<int>(cell) : 255);
  }
  int state = 0;
  ::waitpid(child, &state, 0);
  ASSERT_TRUE(WIFEXITED(state));
  ASSERT_NE(WEXITSTATUS(state), 255);
  const Read got = read(directory / "a");
  EXPECT_GT(got.records.size(), 3u);
  EXPECT_EQ(got.records.size(), static_cast<size_t>(WEXITSTATUS(state)));
  EXPECT_EQ(got.scan.torn_bytes, 0u);
}

}  // namespace
}  // namespace veduta
