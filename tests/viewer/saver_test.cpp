#include "viewer/window/saver.h"

#include <gtest/gtest.h>

#include "scene/error.h"
#include "tests/pvs/small_city.h"

namespace veduta {
namespace {

using test::TemporaryDirectory;
using test::write_bytes;

TEST(Saver, CountsOnFromWhatIsThereAndWhatItPromised) {
  const TemporaryDirectory directory;
  write_bytes(directory / "shot_0001.png", "old");
  Saver saver(directory.path());
  EXPECT_EQ(saver.next_file("shot", ".png"), directory / "shot_0002.png");
  EXPECT_EQ(saver.next_file("shot", ".png"), directory / "shot_0003.png");
  EXPECT_EQ(saver.next_file("path", ".csv"), directory / "path_0001.csv");
}

TEST(Saver, WritesIntoANewFolderAndSaysSo) {
  const TemporaryDirectory directory;
  Saver saver(directory / "a/b");
  EXPECT_FALSE(saver.busy());
  const std::filesystem::path file = saver.next_file("shot", ".txt");
  saver.save(file, [](const std::filesystem::path& to) { write_bytes(to, "seen"); });
  EXPECT_EQ(saver.wait(), "saved " + file.string());
  EXPECT_EQ(test::read_bytes(file), "seen");
  EXPECT_EQ(saver.wait(), std::nullopt);
  EXPECT_FALSE(saver.busy());
}

TEST(Saver, AFailureIsALineNotAnEnd) {
  const TemporaryDirectory directory;
  write_bytes(directory / "file", "no folder");
  Saver saver(directory / "file");
  saver.save(saver.next_file("shot", ".txt"), [](const auto&) {});
  saver.save(saver.next_file("shot", ".txt"), [](const auto&) {});
  const auto report = saver.wait();
  ASSERT_TRUE(report);
  EXPECT_EQ(report->rfind("not saved: ", 0), 0u) << *report;
  Saver other(directory.path());
  other.save(other.next_file("shot", ".txt"),
             [](const auto&) { throw Error(ExitStatus::input_output, "the disk is full"); });
  EXPECT_EQ(other.wait(), "not saved: the disk is full");
}

}  // namespace
}  // namespace veduta
