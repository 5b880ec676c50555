#include "farm/grants.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>

namespace veduta {
namespace {

class Grants : public testing::Test {
 protected:
  ~Grants() override { std::filesystem::remove_all(file); }
  /// The cells that are in hands by this log, of 100.
  std::vector<uint32_t> held(const std::string& log) const {
    std::ofstream(file, std::ios::binary) << log;
    const std::vector<bool> cells = cells_in_hands(file, 100);
    std::vector<uint32_t> numbers;
    for (uint32_t cell = 0; cell < cells.size(); ++cell)
      if (cells[cell]) numbers.push_back(cell);
    return numbers;
  }
  static std::string lease(int rank, int slot, uint64_t begin, uint64_t count) {
    return R"({"begin":)" + std::to_string(begin) + R"(,"count":)" + std::to_string(count) +
           R"(,"event":"lease","lease":7,"level":"info","rank":)" + std::to_string(rank) + R"(,"slot":)" +
           std::to_string(slot) + ",\"t\":1.5}\n";
  }
  static std::string started() {
    return R"({"attempt":2,"event":"started","level":"info"})"
           "\n";
  }
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("veduta-grants-" + std::to_string(getpid()));
  using Cells = std::vector<uint32_t>;
};

TEST_F(Grants, LastLeaseOfEachWorkerOfTheLastAttempt) {
  EXPECT_EQ(held(started() + lease(0, 0, 50, 9) + started() + lease(0, 0, 3, 2) + lease(1, 0, 10, 2) +
                 lease(0, 1, 20, 1) + lease(0, 0, 5, 3)),
            (Cells{5, 6, 7, 10, 11, 20}));
  EXPECT_EQ(held(started() + lease(0, 0, 50, 9) + started()), Cells{})
      << "it died before it gave anything out";
  EXPECT_EQ(held(lease(0, 0, 98, 9)), (Cells{98, 99})) << "no start, and beyond the city";
}

TEST_F(Grants, SharedCellsCountOnce) {
  EXPECT_EQ(held(started() + lease(0, 0, 4, 4) + lease(0, 1, 6, 2)), (Cells{4, 5, 6, 7}));
}

TEST_F(Grants, MissingOrUnreadableLogIsAnEmptyOne) {
  EXPECT_TRUE(cells_in_hands(file.string() + ".none", 100).empty());
  EXPECT_TRUE(cells_in_hands(std::filesystem::temp_directory_path(), 100).empty());
  EXPECT_TRUE(cells_in_hands("/dev/zero", 100).empty());
  EXPECT_EQ(held(""), Cells{});
  EXPECT_EQ(held("\n\n\n"), Cells{});
}

TEST_F(Grants, TornAndForeignLinesArePassedOver) {
  const std::string good = started() + lease(0, 0, 5, 1);
  const std::string torn = lease(0, 1, 60, 4);
  for (size_t size = 0; size + 2 < torn.size(); ++size)
    EXPECT_EQ(held(good + torn.substr(0, size)), Cells{5});
  EXPECT_EQ(held(good + torn.substr(0, torn.size() - 1)), (Cells{5, 60, 61, 62, 63}))
      << "whole without its end";
  for (const char* bad :
       {R"("event":"lease")", R"(["lease"])", R"({"event":"lease"})", R"({"event":["lease"],"rank":0})",
        R"({"event":"lease","rank":-1,"slot":9,"begin":1,"count":1})",
        R"({"event":"lease","rank":1,"slot":9,"begin":"1","count":1})",
        R"({"event":"lease","rank":1,"slot":9,"begin":1.5,"count":1})",
        R"({"event":"lease","rank":1,"slot":9,"begin":4294967296,"count":1})",
        R"({"event":"lease","rank":1,"slot":9,"begin":1e99,"count":1})",
        R"({"event":"note","text":"{\"event\":\"lease\",\"rank\":1,\"slot\":9,\"begin\":1,\"count\":1}"})",
        R"({"event":"note","text":"\"started\""})"})
    EXPECT_EQ(held(good + bad + "\n"), Cells{5}) << bad;
  EXPECT_EQ(held(good + lease(0, 1, 4294967295u, 4294967295u)), Cells{5});
  EXPECT_EQ(held(good + std::string(10000, '[') + "\"lease\"\n"), Cells{5});
  EXPECT_EQ(held(good + std::string("\0\0\0\"lease\"\n\xff\xfe", 14)), Cells{5});
}

// Blocks are of 64 KiB: lines lie across their edges, and one is longer than many of them.
TEST_F(Grants, LongLogsAndLongLines) {
  std::string log = started() + lease(0, 0, 5, 1);
  for (int i = 0; i < 5000; ++i)
    log += R"({"event":"note","text":")" + std::string(static_cast<size_t>(i % 97), 'x') + "\"}\n";
  EXPECT_EQ(held(log), Cells{5});
  for (const size_t size : {4000, 4097, 65535, 65536, 65537, 1000000}) {
    const std::string line = R"({"event":"lease","x":")" + std::string(size, 'y');
    EXPECT_EQ(held(log + line + "\"}\n" + lease(2, 0, 7, 1)), (Cells{5, 7})) << size;
    EXPECT_EQ(held(log + line), Cells{5}) << size;
  }
  std::string many = started();
  for (uint32_t i = 0; i < 20000; ++i) many += lease(0, static_cast<int>(i % 3), i % 100, 1);
  EXPECT_EQ(held(many), (Cells{97, 98, 99}));
}

}  // namespace
}  // namespace veduta
