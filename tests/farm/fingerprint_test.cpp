#include "farm/fingerprint.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "scene/error.h"

namespace veduta {
namespace {

class FingerprintTest : public testing::Test {
 protected:
  FingerprintTest() { std::filesystem::create_directories(directory / "elsewhere"); }
  ~FingerprintTest() override { std::filesystem::remove_all(directory); }
  std::string model(const std::string& name, const std::string& content) const {
    std::ofstream(directory / name) << content;
    return (directory / name).string();
  }
  const std::filesystem::path directory =
      std::filesystem::temp_directory_path() / ("veduta-fingerprint-" + std::to_string(getpid()));
};

TEST_F(FingerprintTest, ContentCountsPathsDoNot) {
  Settings here, there, other;
  here.scene.model = {model("a.json", "city")};
  there.scene.model = {model("elsewhere/b.json", "city")};
  other.scene.model = {model("c.json", "citz")};
  EXPECT_EQ(make_fingerprint(here).hash, make_fingerprint(there).hash);
  EXPECT_NE(make_fingerprint(here).hash, make_fingerprint(other).hash);
  EXPECT_EQ(make_fingerprint(here).hash.size(), 32u);
}

TEST_F(FingerprintTest, EveryFileOfAModelCounts) {
  std::filesystem::create_directories(directory / "city/part");
  model("city/a.obj", "a");
  model("city/part/b.obj", "b");
  model("city/plan.shp", "plan");
  Settings folder, plan;
  folder.scene.model = {(directory / "city").string()};
  plan.scene.model = {(directory / "city/plan.shp").string()};
  const std::string stored = make_fingerprint(folder).text();
  EXPECT_NO_THROW(require_same_job("out/x", stored, make_fingerprint(folder)));
  const auto expect_other = [&](const char* what) {
    try {
      require_same_job("out/x", stored, make_fingerprint(folder));
      ADD_FAILURE() << what;
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::other_job);
      EXPECT_NE(std::string(error.what()).find("'scene.model 1 content'"), std::string::npos);
    }
  };
  model("city/part/b.obj", "changed");
  expect_other("a changed file");
  model("city/part/b.obj", "b");
  EXPECT_EQ(make_fingerprint(folder).text(), stored);
  std::filesystem::rename(directory / "city/part/b.obj", directory / "city/part/c.obj");
  expect_other("a renamed file");
  std::filesystem::rename(directory / "city/part/c.obj", directory / "city/part/b.obj");
  const std::string of_plan = make_fingerprint(plan).hash;
  model("city/plan.dbf", "heights");
  expect_other("one more file");
  EXPECT_NE(make_fingerprint(plan).hash, of_plan) << "what lies beside a plan counts";
}

TEST_F(FingerprintTest, EverySettingCountsAndIsNamed) {
  Settings stored;
  stored.scene.model = {model("a.json", "city")};
  const Fingerprint before = make_fingerprint(stored);
  EXPECT_NO_THROW(require_same_job("out/x", before.text(), make_fingerprint(stored)));
  const std::string base = to_toml(stored);
  for (const auto& [from, to, key] : std::vector<std::array<std::string, 3>>{
           {"size = 10.0", "size = 11.0", "cells.size"},
           {"resolution = 1024", "resolution = 256", "occlusion.resolution"},
           {"eye_margin = 0.0325", "eye_margin = 0.03", "stereo.eye_margin"},
           {"up = \"auto\"", "up = \"y\"", "scene.up"},
           {"crs = \"\"", "crs = \"EPSG:28992\"", "scene.crs"},
           {"region = []", "region = [0, 0, 1, 1]", "cells.region"}}) {
    std::string text = base;
    const size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    try {
      require_same_job("out/x", before.text(), make_fingerprint(parse_settings(text, "x", "/")));
      ADD_FAILURE() << key;
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::other_job);
      EXPECT_NE(std::string(error.what()).find("'" + key + "'"), std::string::npos) << error.what();
    }
  }
}

TEST_F(FingerprintTest, MissingModelIsBadInput) {
  Settings settings;
  for (const std::filesystem::path& wrong :
       {directory / "no.json", directory / "elsewhere/none", directory / std::string(300, 'x')}) {
    settings.scene.model = {wrong.string()};
    try {
      make_fingerprint(settings);
      ADD_FAILURE() << wrong;
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::bad_input);
    }
  }
}

}  // namespace
}  // namespace veduta
