// The programs that open a result, given damaged ones (R9): an error in one line or the answer for what was
// written, and never a signal or a long wait. The loader itself has tests/fuzz/pvs_mutants_test.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/farm/processes.h"
#include "tests/pvs/small_city.h"

namespace veduta {
namespace {

using test::Process;
using test::TemporaryDirectory;

class DamagedResult : public testing::Test {
 protected:
  void SetUp() override {
    write_pvs(directory_ / "a.h5", test::small_city(), test::small_header(), test::small_row);
    bytes_ = test::read_bytes(directory_ / "a.h5");
    for (size_t i = 0; i < bytes_.size(); ++i)
      if (bytes_[i] != 0) used_.push_back(i);
  }

  /// Bits flipped, bytes overwritten, or the end cut off.
  std::string mutant(int kind) {
    std::string bytes = bytes_;
    const size_t at = used_[random_() % used_.size()];
    if (kind % 3 == 0) bytes[at] = static_cast<char>(bytes[at] ^ (1 << (random_() % 8)));
    if (kind % 3 == 1)
      for (size_t i = at; i < std::min(at + 32, bytes.size()); ++i) bytes[i] = static_cast<char>(random_());
    if (kind % 3 == 2) bytes.resize(at);
    return bytes;
  }

  /// The exit status of a program that has 60 s; what it said goes to `said_`.
  int run(const std::string& command) {
    Process process("timeout -s KILL 60 " + command, {}, directory_ / "said");
    const int status = process.wait();
    said_ = process.output();
    return status;
  }

  void expect_answers(const std::string& before, const std::string& behind, int usual) {
    const char* const asked = std::getenv("VEDUTA_MUTANTS");
    const int count = asked ? std::max(usual, std::atoi(asked) / 30) : usual;
    const auto file = (directory_ / "a.h5").string();
    ASSERT_EQ(run(before + file + behind), 0) << said_;
    int refused = 0;
    for (int i = 0; i < count && !HasFailure(); ++i) {
      const std::string bytes = mutant(i);
      test::write_bytes(directory_ / "a.h5", bytes);
      const int status = run(before + file + behind);
      EXPECT_TRUE(status == 0 || status == static_cast<int>(ExitStatus::bad_input))
          << "mutant " << i << ": " << status << ": " << said_;
      EXPECT_TRUE(status == 0 || std::count(said_.begin(), said_.end(), '\n') == 1) << said_;
      refused += status != 0;
    }
    EXPECT_GT(refused, count / 3);
  }

  TemporaryDirectory directory_;
  std::string bytes_, said_;
  std::vector<size_t> used_;
  std::mt19937 random_{11};
};

TEST_F(DamagedResult, InfoSaysSo) {
  expect_answers(VEDUTA_PROGRAM " info ", " --json", 15);
}

TEST_F(DamagedResult, ExportSaysSo) {
  expect_answers(VEDUTA_PROGRAM " export ", " --cell 2 -o " + (directory_ / "plan.svg").string(), 12);
}

TEST_F(DamagedResult, ViewerSaysSo) {
  const std::string behind =
      " --headless --frames 1 --size 64x64 --gpu software --out " + (directory_ / "frames").string();
  if (run(VEDUTA_VIEW_PROGRAM " " + (directory_ / "a.h5").string() + behind) != 0)
    GTEST_SKIP() << "no frames can be drawn here: " << said_;
  expect_answers(VEDUTA_VIEW_PROGRAM " ", behind, 9);
}

}  // namespace
}  // namespace veduta
