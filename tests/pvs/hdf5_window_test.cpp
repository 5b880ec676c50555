#include "pvs/hdf5_window.h"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <random>

#include "pvs/hdf5_output.h"
#include "tests/pvs/small_city.h"

namespace veduta::hdf5 {
namespace {

/// 10 blocks and a bit of /pvs/begin, value i * i in row i.
class Hdf5Window : public testing::Test {
 protected:
  Hdf5Window() {
    Output output(directory_ / "a.h5");
    output.group("/pvs");
    ColumnWriter writer(output, column::pvs_begin, 0);
    for (uint64_t i = 0; i < rows_; ++i) {
      const uint64_t value = i * i;
      writer.append(&value, 1);
    }
    writer.finish();
    output.close();
  }
  void expect_rows(ColumnWindow& window, uint64_t first, uint64_t count) const {
    const auto got = window.read<uint64_t>(first, count);
    ASSERT_EQ(got.size(), count);
    for (uint64_t i = 0; i < count; ++i) ASSERT_EQ(got[i], (first + i) * (first + i));
  }

  static constexpr uint64_t block_ = 32768, rows_ = 10 * block_ + 77;
  test::TemporaryDirectory directory_;
};

TEST_F(Hdf5Window, ReadsAnyRows) {
  const Input input(directory_ / "a.h5");
  BlockCache cache(1 << 20);
  ColumnWindow window(input, column::pvs_begin, cache);
  ASSERT_EQ(window.reader().rows(), rows_);
  ASSERT_EQ(window.reader().block_rows(), block_);
  std::mt19937 random(2);
  for (int i = 0; i < 200; ++i) {
    const uint64_t first = random() % rows_;
    expect_rows(window, first, random() % std::min<uint64_t>(rows_ - first + 1, 3 * block_));
  }
  expect_rows(window, 0, rows_);
  expect_rows(window, rows_ - 1, 1);
  expect_rows(window, rows_, 0);
}

TEST_F(Hdf5Window, UnpacksABlockOnceForReadsThatFollowOneAnother) {
  const Input input(directory_ / "a.h5");
  BlockCache cache(1 << 20);
  ColumnWindow window(input, column::pvs_begin, cache);
  for (uint64_t first = 0; first + 100 <= rows_; first += 100) expect_rows(window, first, 100);
  EXPECT_EQ(window.blocks_read(), 11u);
}

TEST_F(Hdf5Window, ComesBackToWhatItReadLately) {
  const Input input(directory_ / "a.h5");
  BlockCache cache(4 * 8 * block_);
  ColumnWindow window(input, column::pvs_begin, cache);
  for (int round = 0; round < 5; ++round)
    for (const uint64_t block : {2, 7, 3, 5}) expect_rows(window, block * block_ + 9, 5);
  EXPECT_EQ(window.blocks_read(), 4u);
  expect_rows(window, 0, 5);               // in place of the one that was not used for longest: 2
  expect_rows(window, 3 * block_ + 9, 5);  // still there
  EXPECT_EQ(window.blocks_read(), 5u);
  expect_rows(window, 2 * block_ + 9, 5);
  EXPECT_EQ(window.blocks_read(), 6u);
  EXPECT_EQ(cache.bytes(), 4 * 8 * block_);
}

TEST_F(Hdf5Window, KnowsWhichRowsItKeeps) {
  const Input input(directory_ / "a.h5");
  BlockCache cache(3 * 8 * block_);
  ColumnWindow window(input, column::pvs_begin, cache);
  EXPECT_FALSE(window.fetch_kept(0, 1));
  EXPECT_TRUE(window.fetch_kept(0, 0));
  expect_rows(window, block_ - 1, 2);
  EXPECT_TRUE(window.fetch_kept(0, 2 * block_));
  EXPECT_FALSE(window.fetch_kept(block_, block_ + 1)) << "the last of them is of another block";
  expect_rows(window, rows_ - 1, 1);
  EXPECT_TRUE(window.fetch_kept(rows_ - 77, 77));
  EXPECT_EQ(window.blocks_read(), 3u);
}

TEST_F(Hdf5Window, SharesItsMemoryWithOthers) {
  const Input input(directory_ / "a.h5");
  BlockCache cache(2 * 8 * block_);
  ColumnWindow one(input, column::pvs_begin, cache), other(input, column::pvs_begin, cache);
  expect_rows(one, 0, 5);
  expect_rows(other, 0, 5);
  expect_rows(one, 0, 5);
  expect_rows(other, block_, 5);  // in place of the other's first: one's is younger
  expect_rows(one, 0, 5);
  EXPECT_EQ(one.blocks_read(), 1u);
  expect_rows(other, 0, 5);
  EXPECT_EQ(other.blocks_read(), 3u);
}

TEST_F(Hdf5Window, ABlockThatIsDamagedIsNotKept) {
  {
    const hid_t file = H5Fopen((directory_ / "a.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    const hid_t data = H5Dopen2(file, "/pvs/begin", H5P_DEFAULT);
    const std::vector<char> rubbish(1000, 'x');
    const hsize_t second = block_;
    ASSERT_GE(H5Dwrite_chunk(data, H5P_DEFAULT, 0, &second, rubbish.size(), rubbish.data()), 0);
    H5Dclose(data);
    H5Fclose(file);
  }
  const Input input(directory_ / "a.h5");
  BlockCache cache(1 << 20);
  ColumnWindow window(input, column::pvs_begin, cache);
  expect_rows(window, 0, 5);
  for (int again = 0; again < 2; ++again)
    EXPECT_EQ(test::status_of([&] { window.read<uint64_t>(block_, 1); }), ExitStatus::bad_input);
  expect_rows(window, 7, 5);
  expect_rows(window, 2 * block_, 5);
  EXPECT_EQ(window.blocks_read(), 2u);
  EXPECT_EQ(cache.bytes(), 2 * 8 * block_);
}

}  // namespace
}  // namespace veduta::hdf5
