#include "farm/sweep_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "scene/error.h"
#include "tests/pvs/small_city.h"

namespace veduta {
namespace {

std::vector<std::string> names(const std::vector<GridPoint>& grid) {
  std::vector<std::string> result;
  for (const GridPoint& point : grid) {
    SweepPoint named;
    named.changed = point.changed;
    result.push_back(point_name(named));
  }
  return result;
}

Settings base() {
  Settings settings;
  settings.scene.model = {"/city.obj"};
  return settings;
}

std::vector<GridPoint> grid_of(const std::string& text) {
  const test::TemporaryDirectory directory;
  test::write_bytes(directory / "grid.toml", text);
  return read_grid(directory / "grid.toml", base());
}

void expect_refused(const std::string& text, ExitStatus status, const std::string& words) {
  try {
    grid_of(text);
    FAIL() << "taken: " << text;
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), status);
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("grid.toml"), std::string::npos) << error.what();
  }
}

TEST(SweepGrid, TheConfigurationComesFirst) {
  for (const auto& grid : {default_grid(base()), grid_of("")}) {
    ASSERT_FALSE(grid.empty());
    EXPECT_TRUE(grid.front().changed.empty());
    EXPECT_EQ(list_settings(grid.front().settings), list_settings(base()));
  }
}

TEST(SweepGrid, EveryKnobOfTheIssueIsTurnedByDefault) {
  const auto grid = default_grid(base());
  for (const char* key : {"occlusion.resolution", "occlusion.subdivide", "cells.size", "slices.max",
                          "shrink.method", "navigation.seed_size"})
    EXPECT_TRUE(std::any_of(grid.begin(), grid.end(), [&](const GridPoint& point) {
      return point.changed.size() == 1 && point.changed.front().first == key;
    })) << key;
  // By itself it would take hours with as many parts as are the default.
  EXPECT_TRUE(std::any_of(grid.begin(), grid.end(), [](const GridPoint& point) {
    return point.settings.occlusion.method == "zoom" && point.settings.occlusion.subdivide <= 2;
  }));
}

TEST(SweepGrid, ValuesBeyondTheirRangeAreLeftOut) {
  Settings settings = base();
  settings.occlusion.resolution = 64;
  for (const GridPoint& point : default_grid(settings)) EXPECT_GE(point.settings.occlusion.resolution, 64);
}

TEST(SweepGrid, EveryCombinationOfAGridAndNothingTwice) {
  const auto grid = grid_of(
      "[[grid]]\nocclusion.subdivide = [2, 8]\nocclusion.resolution = [512, 1024]\n"
      "[[grid]]\nocclusion.resolution = [512]\n");
  EXPECT_EQ(grid.size(), 4u);  // 8 and 1024 are the defaults, 8 and 512 come twice
  const auto all = names(grid);
  EXPECT_EQ(all.front(), "default");
  const auto both = std::find_if(grid.begin(), grid.end(), [](const GridPoint& p) {
    return p.settings.occlusion.subdivide == 2 && p.settings.occlusion.resolution == 512;
  });
  ASSERT_NE(both, grid.end());
  EXPECT_EQ(both->changed.size(), 2u);
}

TEST(SweepGrid, WhatIsNoGridIsRefused) {
  expect_refused("grid = 3\n", ExitStatus::usage, "line 1");
  expect_refused("[[grid]]\nocclusion.subdivide = 2\n", ExitStatus::usage, "line 2");
  expect_refused("[[grid]]\nocclusion.subdivide = []\n", ExitStatus::usage, "list");
  expect_refused("[[grid]]\nocclusion.subdivid = [2]\n", ExitStatus::usage,
                 "did you mean 'occlusion.subdivide'");
  expect_refused("[[grid]]\nocclusion.subdivide = [3]\n", ExitStatus::usage, "power of two");
  expect_refused("[[grid]]\nscene.model = ['a']\n", ExitStatus::usage, "no key that a grid can vary");
  expect_refused("[[grid]\n", ExitStatus::usage, "line 1");
  std::string long_list = "[[grid]]\nslices.max = [1";
  for (int n = 2; n <= 127; ++n) long_list += ", " + std::to_string(n);
  expect_refused(long_list + "]\nocclusion.subdivide = [1, 2, 4, 8, 16, 32, 1, 2, 4]\n", ExitStatus::usage,
                 "1000 points");
  EXPECT_THROW(read_grid("/nowhere/grid.toml", base()), Error);
}

}  // namespace
}  // namespace veduta
