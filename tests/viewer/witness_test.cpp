// Looking at what a row lacks.
#include "viewer/witness.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <glm/geometric.hpp>

#include "gl/egl_context.h"
#include "scene/error.h"
#include "tests/viewer/memory_source.h"
#include "tests/viewer/toy_city.h"
#include "viewer/view_cli.h"

namespace veduta {
namespace {

/// The street without its tower, which rises behind the wall, and the ray that meets it.
class WitnessTest : public testing::Test {
 protected:
  WitnessTest() {
    file_.entries.pop_back();
    file_.row_begin = {0, file_.entries.size()};
    witness_.object = toy::Street::tower;
    const City& city = file_.city;
    witness_.triangle = city.scene.objects[witness_.object].triangle_begin + 5 * 8 + 6;  // of floor 6, to -x
    for (int k = 0; k < 3; ++k)
      witness_.hit += city.scene.vertices[city.scene.triangles[witness_.triangle][k]] / 3.0f;
    witness_.eye = {0.5f, -0.5f, 1.75f};
    witness_.direction = glm::normalize(witness_.hit - witness_.eye);
    options_.picture = {320, 240};
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void require_gl() {
    try {
      const EglContext context("auto");
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
  }
  std::string write_file() {
    std::filesystem::create_directories(folder_);
    const std::string path = folder_ / "toy.h5";
    file_.header.fingerprint = "toy";
    write_pvs(path, file_.city, file_.header, [&](uint32_t cell) {
      return BakedCell{CellStatus::baked, 1, PvsRow(file_.row(cell).begin(), file_.row(cell).end())};
    });
    return path;
  }
  static int look(const std::vector<std::string>& words) {
    std::vector<const char*> argv{"veduta-view", "--headless"};
    for (const std::string& word : words) argv.push_back(word.c_str());
    return view_main(static_cast<int>(argv.size()), argv.data());
  }
  WitnessPicture draw() const {
    return draw_witness(std::make_unique<toy::MemorySource>(file_), witness_, options_, 64u << 20);
  }
  ExitStatus status(const std::string& which, std::string* message = nullptr) {
    try {
      find_witness(toy::make_index(file_), "toy.h5", which);
    } catch (const Error& error) {
      if (message) *message = error.what();
      return error.status();
    }
    return ExitStatus::done;
  }

  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("veduta_witness_test_" + std::to_string(getpid()));
  PvsFile file_ = toy::make_street().file;
  Witness witness_;
  HeadlessOptions options_;
};

bool is_red(const Image& image, uint32_t x, uint32_t y) {
  const uint8_t* p = image.rgb.data() + size_t{3} * (y * image.width + x);
  return p[0] > 80 && p[1] == 0 && p[2] == 0;
}

TEST_F(WitnessTest, WhatTheRowLacksIsRedInTheMiddle) {
  require_gl();
  if (IsSkipped()) return;
  options_.begin.optics.vertical_fov_deg = fov_of(witness_, toy::MemorySource(file_));
  const WitnessPicture picture = draw();
  ASSERT_EQ(picture.image.width, 640u);
  uint64_t red = 0, red_left = 0;
  for (uint32_t y = 0; y < 240; ++y)
    for (uint32_t x = 0; x < 640; ++x)
      if (is_red(picture.image, x, y)) ++(x < 320 ? red_left : red);
  for (const uint32_t x : {479u, 480u})
    for (const uint32_t y : {119u, 120u}) EXPECT_TRUE(is_red(picture.image, x, y)) << x << ", " << y;
  EXPECT_EQ(red_left, 0u);
  EXPECT_GT(red, 320u * 240u / 50);
  EXPECT_LT(red, 320u * 240u);  // something around it is seen
  EXPECT_GE(picture.red_pixels, red);
  EXPECT_LT(picture.red_pixels, red + 2000);  // and its rim, which multi-sampling mixes
}

TEST_F(WitnessTest, ACompleteRowShowsNoRed) {
  require_gl();
  if (IsSkipped()) return;
  file_ = toy::make_street().file;
  options_.begin.optics.vertical_fov_deg = 120;
  EXPECT_EQ(draw().red_pixels, 0u);
}

TEST_F(WitnessTest, LooksAlongTheRay) {
  for (const glm::vec3 direction :
       {glm::vec3(1, 0, 0), {0, -1, 0}, {-0.6f, 0, 0.8f}, {0, 0, 1}, {0, 0, -1}}) {
    witness_.direction = direction;
    EXPECT_LT(glm::distance(axes(pose_of(witness_)).forward, direction), 1e-6f);
  }
}

TEST_F(WitnessTest, FindsExamples) {
  std::string message;
  EXPECT_EQ(status("0", &message), ExitStatus::usage);
  EXPECT_NE(message.find("veduta verify --store"), std::string::npos) << message;
  file_.verification.emplace();
  EXPECT_EQ(status("0", &message), ExitStatus::usage);
  EXPECT_NE(message.find("nothing to look at"), std::string::npos) << message;
  file_.verification->witnesses = {Witness{}, witness_};
  EXPECT_EQ(find_witness(toy::make_index(file_), "toy.h5", "1"), witness_);
  for (const char* wrong : {"2", "-1", "1x", "x", "", "99999999999999999999999"})
    EXPECT_EQ(status(wrong), ExitStatus::usage) << wrong;
}

TEST_F(WitnessTest, FindsExamplesInAReport) {
  std::filesystem::create_directories(folder_);
  const std::string report = folder_ / "a:b.json";
  const std::string example =
      R"({"cell":0,"object":4,"triangle":)" + std::to_string(witness_.triangle) +
      R"(,"eye_m":[0,0,1.7],"direction":[2,0,0],"hit_m":[40,0,20],"gap_m":0.25,"gap_from_eye_m":3})";
  const auto write = [&](const std::string& digest, const std::string& examples) {
    std::ofstream(report) << R"({"content_digest":")" << digest << R"(","examples":[)" << examples
                          << R"(],"narrow_gap_examples":[)" << examples << "]}";
  };
  file_.content_digest = "abc";
  write("abc", example);
  const Witness found = find_witness(toy::make_index(file_), "toy.h5", report + ":1");
  EXPECT_EQ(found.direction, glm::vec3(1, 0, 0));
  EXPECT_EQ(found.triangle, witness_.triangle);
  EXPECT_EQ(found.gap_m, 0.25f);
  EXPECT_EQ(status(report + ":2"), ExitStatus::usage);
  EXPECT_EQ(status(report + ":"), ExitStatus::usage);
  EXPECT_EQ(status((folder_ / "none.json").string() + ":0"), ExitStatus::bad_input);
  write("abd", example);
  EXPECT_EQ(status(report + ":0"), ExitStatus::bad_input);
  for (const char* bad :
       {"1", "{}", "{",
        R"({"cell":1,"object":4,"triangle":60,"eye_m":[0,0,1.7],"direction":[2,0,0],"hit_m":[4,0,2]})",
        R"({"cell":0,"object":0,"triangle":60,"eye_m":[0,0,1.7],"direction":[2,0,0],"hit_m":[4,0,2]})",
        R"({"cell":0,"object":4,"triangle":60,"eye_m":[0,0,1.7],"direction":[0,0,0],"hit_m":[4,0,2]})",
        R"({"cell":0,"object":4,"triangle":60,"eye_m":[0,0],"direction":[1,0,0],"hit_m":[4,0,2]})"}) {
    write("abc", bad);
    std::string message;
    EXPECT_EQ(status(report + ":0", &message), ExitStatus::bad_input) << bad;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST_F(WitnessTest, ByCommandLine) {
  require_gl();
  if (IsSkipped()) return;
  const std::string path = write_file(), out = folder_ / "out";
  EXPECT_EQ(look({path, "--out", out, "--witness", "0"}), 2) << "nothing is stored";
  const PvsFile written = read_pvs(path);
  Verification found;
  found.cells = {{0, 1000}};
  found.witnesses = {witness_};
  store_verification(path, written, found);
  EXPECT_EQ(look({path, "--out", out, "--witness", "0", "--stereo", "mono"}), 2) << "one or the other";
  EXPECT_EQ(look({path, "--out", out, "--witness", "0", "--size", "320x240"}), 0);
  EXPECT_TRUE(std::filesystem::exists(out + "/witness_0.png"));
}

}  // namespace
}  // namespace veduta
