// `veduta export` as it is typed: what it writes and prints, and one line and a status for what is wrong.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/export/toy_result.h"
#include "tests/farm/processes.h"

namespace veduta {
namespace {

class ExportCommand : public testing::Test {
 protected:
  void SetUp() override { test::write_toy_result(directory_ / "city.pvs.h5"); }

  /// In the directory, with "city.pvs.h5" in it. \return the exit status.
  int run(const std::string& words) {
    test::Process process(
        "timeout -s KILL 60 env -C '" + directory_.path().string() + "' " VEDUTA_PROGRAM " " + words, {},
        directory_ / "said");
    const int status = process.wait();
    said_ = process.output();
    return status;
  }

  void expect_refused(const std::string& words, ExitStatus status, const std::string& says) {
    SCOPED_TRACE(words);
    EXPECT_EQ(run("export " + words), static_cast<int>(status));
    EXPECT_EQ(std::count(said_.begin(), said_.end(), '\n'), 1) << said_;
    EXPECT_NE(said_.find(says), std::string::npos) << said_;
  }

  test::TemporaryDirectory directory_;
  std::string said_;
};

TEST_F(ExportCommand, WritesWhatTheNameSays) {
  const std::pair<const char*, const char*> beginnings[] = {{"a.obj", "# Veduta: "},
                                                            {"a.gltf", "{"},
                                                            {"a.glb", "glTF"},
                                                            {"a.svg", "<svg "},
                                                            {"A.JSONL", "{\"cell\":1,"}};
  for (const auto& [name, beginning] : beginnings) {
    ASSERT_EQ(run("export city.pvs.h5 --cell 1 -o " + std::string(name)), 0) << said_;
    EXPECT_TRUE(test::read_bytes(directory_ / name).starts_with(beginning)) << name;
    EXPECT_TRUE(said_.starts_with(std::string(name) + ": cell 1, 4 objects, ")) << said_;
  }
  ASSERT_EQ(run("export city.pvs.h5 -o all.jsonl"), 0);
  EXPECT_TRUE(said_.starts_with("all.jsonl: 3 cells, 10 objects, ")) << said_;
  ASSERT_EQ(run("-q export city.pvs.h5 -o all.jsonl"), 0);
  EXPECT_EQ(said_, "");
}

TEST_F(ExportCommand, TakesAPointForACell) {
  ASSERT_EQ(run("export city.pvs.h5 --at 15 -5 1.5 -o a.obj"), 0) << said_;
  ASSERT_EQ(run("export city.pvs.h5 --cell 1 -o b.obj"), 0) << said_;
  std::string a = test::read_bytes(directory_ / "a.obj"), b = test::read_bytes(directory_ / "b.obj");
  a.replace(a.find("mtllib a"), 8, "mtllib b");
  EXPECT_EQ(a, b);
}

TEST_F(ExportCommand, RefusesInOneLine) {
  expect_refused("city.pvs.h5 --cell 1 -o a.blend", ExitStatus::usage, ".gltf");
  expect_refused("city.pvs.h5 -o a.glb", ExitStatus::usage, "--cell or --at");
  expect_refused("city.pvs.h5 --cell 3 -o a.glb", ExitStatus::usage, "cells 0 to 2");
  expect_refused("city.pvs.h5 --cell -1 -o a.glb", ExitStatus::usage, "--cell");
  expect_refused("city.pvs.h5 --cell one -o a.glb", ExitStatus::usage, "--cell");
  expect_refused("city.pvs.h5 --at 33 -5 6 -o a.glb", ExitStatus::usage, "nearest is cell 2, 5 m away");
  expect_refused("city.pvs.h5 --at nan 0 0 -o a.glb", ExitStatus::usage, "finite");
  expect_refused("city.pvs.h5 --at 1 2 -o a.glb", ExitStatus::usage, "--at");
  expect_refused("city.pvs.h5 --at 1 2 3 --cell 1 -o a.glb", ExitStatus::usage, "excludes");
  expect_refused("missing.pvs.h5 --cell 1 -o a.glb", ExitStatus::bad_input, "missing.pvs.h5");
  expect_refused("said --cell 1 -o a.glb", ExitStatus::bad_input, "said");
  expect_refused("city.pvs.h5 --cell 1 -o nowhere/a.glb", ExitStatus::input_output, "nowhere");
  test::write_bytes(directory_ / "a.glb", "old");
  expect_refused("city.pvs.h5 --cell 9 -o a.glb", ExitStatus::usage, "cells");
  EXPECT_EQ(test::read_bytes(directory_ / "a.glb"), "old");
}

}  // namespace
}  // namespace veduta
