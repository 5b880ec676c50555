#include "viewer/view_cli.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <vector>

#include "gl/egl_context.h"
#include "pvs/pvs_file.h"
#include "scene/error.h"
#include "tests/viewer/toy_city.h"

namespace veduta {
namespace {

class ViewCliTest : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string at(const std::string& name) const { return (folder_ / name).string(); }
  int run(std::vector<std::string> words) {
    words.insert(words.begin(), "veduta-view");
    std::vector<const char*> argv;
    for (const std::string& word : words) argv.push_back(word.c_str());
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    const int status = view_main(static_cast<int>(argv.size()), argv.data());
    testing::internal::GetCapturedStdout();
    said_ = testing::internal::GetCapturedStderr();
    return status;
  }
  // The error is one line.
  void expect_one_line() const { EXPECT_EQ(std::count(said_.begin(), said_.end(), '\n'), 1) << said_; }

  void write_street() { write_file(toy::make_street().file); }
  void write_file(PvsFile file) {
    file.header.fingerprint = "toy";
    write_pvs(at("toy.h5"), file.city, file.header, [&](uint32_t cell) {
      return BakedCell{CellStatus::baked, 1, PvsRow(file.row(cell).begin(), file.row(cell).end())};
    });
  }

  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("veduta_view_cli_test_" + std::to_string(getpid()));
  std::string said_;
};

TEST_F(ViewCliTest, WrongUseIsStatus2InOneLine) {
  const std::vector<std::vector<std::string>> wrong{
      {},
      {at("toy.h5"), "--headless"},
      {at("toy.h5"), "--compare"},
      {at("toy.h5"), "--play"},
      {at("toy.h5"), "--headless", "--out", at("o"), "--stereo", "quad-buffer"},
      {at("toy.h5"), "--headless", "--out", at("o"), "--pvs", "half"},
      {at("toy.h5"), "--headless", "--out", at("o"), "--cull", "twice"},
      {at("toy.h5"), "--headless", "--out", at("o"), "--memory", "1"},
      {at("toy.h5"), "--headless", "--out", at("o"), "--stereo", "hologram"},
      {at("toy.h5"), "--headless", "--out", at("o"), "--size", "big"},
      {at("toy.h5"), "--headless", "--out", at("o"), "--size", "10x0"},
      {at("toy.h5"), "--headless", "--out", at("o"), "--frames", "0"},
      {at("toy.h5"), "--headless", "--out", at("o"), "--iod", "-1"},
      {at("toy.h5"), "--headless", "--out", at("o"), "--gpu", "fast"},
      {at("toy.h5"), "--headless", "--out", at("o"), "--unknown"}};
  for (const auto& words : wrong) {
    EXPECT_EQ(run(words), 2) << said_;
    expect_one_line();
  }
  EXPECT_FALSE(std::filesystem::exists(at("o")));
  EXPECT_EQ(run({"--help"}), 0);
}

TEST_F(ViewCliTest, AMissingOrDamagedFileIsStatus65) {
  EXPECT_EQ(run({at("none.h5"), "--headless", "--out", at("o")}), 65);
  expect_one_line();
  std::ofstream(at("noise.h5")) << "this is no city";
  EXPECT_EQ(run({at("noise.h5"), "--headless", "--out", at("o")}), 65);
  expect_one_line();
}

TEST_F(ViewCliTest, DrawsPicturesAndStatistics) {
  try {
    const EglContext context("auto");
  } catch (const Error& error) {
    GTEST_SKIP() << error.what();
  }
  write_street();
  std::ofstream(at("path.csv")) << "x,y,z,yaw_deg,pitch_deg\n0,0,1.7,0,0\n-50,0,9,0,0\n-60,0,9,0,0\n";
  ASSERT_EQ(run({at("toy.h5"), "--headless", "--out", at("deep/out"), "--path", at("path.csv"), "--stats",
                 at("stats.csv"), "--size", "64x48", "--stereo", "side-by-side"}),
            0)
      << said_;
  EXPECT_NE(said_.find("outside every view-cell"), std::string::npos) << said_;
  expect_one_line();  // once, though two frames are outside
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(at("deep/out")))
    names.insert(entry.path().filename());
  EXPECT_EQ(names, (std::set<std::string>{"frame_0000.png", "frame_0001.png", "frame_0002.png"}));
  std::ifstream stats(at("stats.csv"));
  std::string line;
  std::getline(stats, line);
  EXPECT_EQ(
      line,
      "frame,cell,objects,triangles,draws,ms,cull_ms,interval_ms,all_drawn,waiting,x,y,z,yaw_deg,pitch_deg");
  std::getline(stats, line);
  EXPECT_EQ(line.substr(0, 6), "0,0,4,") << line;
  std::getline(stats, line);
  EXPECT_EQ(line.substr(0, 7), "1,-1,5,") << line;

  EXPECT_EQ(run({at("toy.h5"), "--headless", "--out", at("tour"), "--size", "64x48"}), 0) << said_;
  EXPECT_TRUE(std::filesystem::exists(at("tour/frame_0000.png")));

  std::ofstream(at("bad.csv")) << "x,y,z,yaw_deg,pitch_deg\n0,0,high,0,0\n";
  EXPECT_EQ(run({at("toy.h5"), "--headless", "--out", at("o"), "--path", at("bad.csv")}), 65);
  EXPECT_NE(said_.find("bad.csv: line 2: "), std::string::npos) << said_;
  EXPECT_EQ(run({at("toy.h5"), "--headless", "--out", at("toy.h5"), "--size", "64x48"}), 74)
      << "a file is in the way";
  expect_one_line();
}

/// The tower stands behind the wall: a row that lacks it is another picture, one that has it is the same.
TEST_F(ViewCliTest, ComparesWithTheWholeCity) {
  try {
    const EglContext context("auto");
  } catch (const Error& error) {
    GTEST_SKIP() << error.what();
  }
  write_street();
  std::ofstream(at("path.csv")) << "x,y,z,yaw_deg,pitch_deg\n0,0,1.7,0,0\n0.5,0.5,1.7,20,0\n";
  for (const char* mode : {"mono", "side-by-side", "anaglyph", "checkerboard"})
    EXPECT_EQ(run({at("toy.h5"), "--compare", "--out", at("same"), "--path", at("path.csv"), "--size",
                   "160x120", "--stereo", mode}),
              0)
        << mode << said_;
  EXPECT_TRUE(std::filesystem::is_empty(at("same")));

  toy::Street street = toy::make_street();
  PvsFile& file = street.file;
  file.entries.pop_back();
  file.row_begin.back() = file.entries.size();
  write_file(file);
  EXPECT_EQ(
      run({at("toy.h5"), "--compare", "--out", at("other"), "--path", at("path.csv"), "--size", "160x120"}),
      1);
  EXPECT_TRUE(std::filesystem::exists(at("other/frame_0000_pvs.png")));
  EXPECT_TRUE(std::filesystem::exists(at("other/frame_0000_all.png")));
}

}  // namespace
}  // namespace veduta
