#include "viewer/path.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "scene/error.h"

namespace veduta {
namespace {

class PathTest : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& text) {
    std::ofstream(folder_ / "path.csv") << text;
    return folder_ / "path.csv";
  }
  // What the error says, and that it is one of bad input.
  std::string refusal(const std::filesystem::path& file) {
    try {
      read_path(file);
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::bad_input);
      return error.what();
    }
    return "accepted";
  }
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("veduta_path_test_" + std::to_string(getpid()));
};

const std::string header = "x,y,z,yaw_deg,pitch_deg\n";

TEST_F(PathTest, ReadsPoses) {
  const std::vector<Pose> path = read_path(write(header + "1.5,-2,3e1,90,-10\r\n\n 4 , 5,6,0,0\n"));
  ASSERT_EQ(path.size(), 2u);
  EXPECT_EQ(path[0].position_m, glm::vec3(1.5f, -2, 30));
  EXPECT_EQ(path[0].yaw_deg, 90);
  EXPECT_EQ(path[0].pitch_deg, -10);
  EXPECT_EQ(path[1].position_m, glm::vec3(4, 5, 6));
}

TEST_F(PathTest, RefusesNonsenseByLine) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", "no eye point"},
      {header, "no eye point"},
      {"1,2,3,4,5\n", "line 1: expected the header"},
      {header + "1,2,3,4,5\n1,2,3,4\n", "line 3: expected 5 numbers"},
      {header + "1,2,3,4,5,6\n", "line 2: expected 5 numbers"},
      {header + "1,2,x,4,5\n", "line 2: \"x\" is not a finite number"},
      {header + "1,2,,4,5\n", "line 2: \"\" is not a finite number"},
      {header + "1,2,nan,4,5\n", "line 2: \"nan\" is not"},
      {header + "1,2,inf,4,5\n", "line 2: \"inf\" is not"},
      {header + "1,2,1e99,4,5\n", "line 2: \"1e99\" is not"},
      {header + "1,2,3,4,91\n", "line 2: pitch_deg is 91"}};
  for (const auto& [text, expected] : cases) {
    const std::string said = refusal(write(text));
    EXPECT_NE(said.find(expected), std::string::npos) << said;
    EXPECT_NE(said.find("path.csv: "), std::string::npos) << said;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  }
  EXPECT_NE(refusal(folder_ / "none.csv").find("cannot be opened"), std::string::npos);
}

TEST_F(PathTest, ResamplesAlongTheWholePathTurningTheShortWay) {
  const std::vector<Pose> path{{{0, 0, 0}, 350, 0}, {{10, 0, 0}, 10, 20}};
  const std::vector<Pose> five = resample(path, 5);
  ASSERT_EQ(five.size(), 5u);
  EXPECT_EQ(five[0].position_m.x, 0);
  EXPECT_FLOAT_EQ(five[2].position_m.x, 5);
  EXPECT_FLOAT_EQ(five[2].yaw_deg, 360);
  EXPECT_FLOAT_EQ(five[2].pitch_deg, 10);
  EXPECT_EQ(five[4].position_m.x, 10);
  EXPECT_EQ(resample(path, 1).front().position_m.x, 0);
  EXPECT_EQ(resample({path[0]}, 3).size(), 3u);
}

TEST_F(PathTest, WritesWhatItReads) {
  const std::vector<Pose> path{{{0.1f, -1e-7f, 78123.453f}, 179.99f, -89}, {{1e9f, 0, -3}, -180, 90}};
  write_path(folder_ / "written.csv", path);
  const std::vector<Pose> read = read_path(folder_ / "written.csv");
  ASSERT_EQ(read.size(), path.size());
  for (size_t i = 0; i < path.size(); ++i) {
    EXPECT_EQ(read[i].position_m, path[i].position_m);
    EXPECT_EQ(read[i].yaw_deg, path[i].yaw_deg);
    EXPECT_EQ(read[i].pitch_deg, path[i].pitch_deg);
  }
  EXPECT_THROW(write_path(folder_ / "missing" / "written.csv", path), Error);
}

}  // namespace
}  // namespace veduta
