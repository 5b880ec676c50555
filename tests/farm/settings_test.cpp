#include "worker/settings.h"

#include <gtest/gtest.h>

#include "scene/error.h"

namespace veduta {
namespace {

Settings parse(const std::string& text) {
  return parse_settings(text, "demo.toml", "/base");
}

/// The message of the usage error that a text leads to; "" when it is accepted.
std::string refusal(const std::string& text) {
  try {
    parse(text);
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::usage);
    return error.what();
  }
  return "";
}

const std::string model = "[scene]\nmodel = 'a.json'\n";

using Corners = std::vector<std::array<double, 2>>;

TEST(Settings, DefaultsAndRelativeModels) {
  const Settings settings = parse(model);
  EXPECT_EQ(settings.scene.model, std::vector<std::string>{"/base/a.json"});
  EXPECT_EQ(settings.cells.size_m, 10.0);
  EXPECT_TRUE(settings.cells.region.empty());
}

TEST(Settings, EveryKeyIsRead) {
  const Settings s = parse(
      "[scene]\nmodel = ['/x/a.json', 'sub/../b.obj']\nterrain_tile = 32\nup = 'y'\nunit = 0.001\n"
      "crs = 'EPSG:3946'\nheight_field = 'H'\nfloors_field = 'F \"n\"'\nfloor_height = "
      "2.5\n[navigation]\nmode = "
      "'fly'\nseed_size = 0.5\n"
      "eye_height = 2\nfly_lowest = -1\nfly_highest = 25.5\n"
      "[cells]\nsize = 5\nheight = 2.5\nlargest = 8\nregion = [1, 2.5, 3, 4]\n[slices]\nmax = "
      "4\n[shrink]\nmethod = 'sealed'\n"
      "[occlusion]\nmethod = 'panorama'\nresolution = 256\nsubdivide = 4\n[stereo]\neye_margin = 0\n");
  EXPECT_EQ(s.scene.model, (std::vector<std::string>{"/x/a.json", "/base/b.obj"}));
  EXPECT_EQ(s.scene.terrain_tile_m, 32);
  EXPECT_EQ(s.scene.up, "y");
  EXPECT_EQ(s.scene.unit_m, 0.001);
  EXPECT_EQ(s.scene.crs, "EPSG:3946");
  EXPECT_EQ(s.scene.height_field, "H");
  EXPECT_EQ(s.scene.floors_field, "F \"n\"");
  EXPECT_EQ(s.scene.floor_height_m, 2.5);
  EXPECT_EQ(to_toml(parse(to_toml(s))), to_toml(s));
  EXPECT_EQ(s.navigation.seed_size_m, 0.5);
  EXPECT_EQ(s.navigation.eye_height_m, 2);
  EXPECT_EQ(s.cells.size_m, 5);
  EXPECT_EQ(s.cells.height_m, 2.5);
  EXPECT_EQ(s.navigation.mode, "fly");
  EXPECT_EQ(s.navigation.fly_lowest_m, -1);
  EXPECT_EQ(s.navigation.fly_highest_m, 25.5);
  EXPECT_EQ(s.cells.largest, 8);
  EXPECT_EQ(s.cells.region, (Corners{{1, 2.5}, {3, 2.5}, {3, 4}, {1, 4}}));
  EXPECT_EQ(s.slices.max, 4);
  EXPECT_EQ(s.occlusion.resolution, 256);
  EXPECT_EQ(s.occlusion.subdivide, 4);
  EXPECT_EQ(s.stereo.eye_margin_m, 0);
}

TEST(Settings, WhatIsWrittenReadsBackTheSame) {
  const Settings settings =
      parse("[scene]\nmodel = ['/a \"b\"\\\\c.json']\n[cells]\nsize = 0.1\nregion = [0.1, 0.2, 1e7, 2e7]\n");
  const std::string text = to_toml(settings);
  EXPECT_EQ(to_toml(parse(text)), text);
  EXPECT_EQ(parse(text).cells.region, settings.cells.region);
  EXPECT_EQ(to_toml(parse(to_toml(parse(model)))), to_toml(parse(model)));
}

TEST(Settings, RegionsAreBoxesOrPolygons) {
  const auto region = [](const char* text) { return parse(model + "[cells]\nregion = " + text); };
  const auto value = [](const Settings& settings) {
    for (const auto& [key, text] : list_settings(settings))
      if (key == "cells.region") return text;
    return std::string();
  };
  const Settings polygon = region("[[0, 0], [10.5, 0], [3, 7], [0, 0.1]]");
  EXPECT_EQ(polygon.cells.region, (Corners{{0, 0}, {10.5, 0}, {3, 7}, {0, 0.1}}));
  EXPECT_EQ(value(polygon), "[[0.0, 0.0], [10.5, 0.0], [3.0, 7.0], [0.0, 0.1]]");
  EXPECT_EQ(parse(to_toml(polygon)).cells.region, polygon.cells.region);
  EXPECT_EQ(value(region("[1, 2, 3, 4]")), "[1.0, 2.0, 3.0, 4.0]");
  EXPECT_EQ(value(region("[]")), "[]");
  for (const auto& [wrong, word] : {std::pair{"[[0, 0], [1, 1]]", "3"},
                                    {"[[0, 0], [1, 1], [0]]", "two numbers"},
                                    {"[[0, 0], [1, nan], [0, 1]]", "finite"},
                                    {"[[0, 0], [1, inf], [0, 1]]", "finite"},
                                    {"[[0, 0], ['a', 1], [0, 1]]", "number"},
                                    {"[[0, 0], 1, [0, 1]]", "two numbers"},
                                    {"[0, [0, 0], 1, [0, 1]]", "number"},
                                    {"'here'", "polygon"},
                                    {"[[]]", "two numbers"}}) {
    const std::string message = refusal(model + "[cells]\nregion = " + wrong + "\n");
    EXPECT_EQ(message.rfind("demo.toml: line 4: 'cells.region'", 0), 0u) << message;
    EXPECT_NE(message.find(word), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(Settings, FlyingNeedsARangeOfHeights) {
  EXPECT_EQ(
      refusal(model + "[navigation]\nfly_lowest = 60\n"),
      "demo.toml: 'navigation.fly_lowest' is 60; it must be below 'navigation.fly_highest', which is 60");
}

TEST(Settings, UnknownKeyNamesLineAndNearest) {
  EXPECT_EQ(refusal(model + "\n\n[cells]\nheight = 1\nsise = 3\n"),
            "demo.toml: line 7: unknown key 'cells.sise'; did you mean 'cells.size'?");
  EXPECT_EQ(refusal(model + "[cell]\nsize = 3\n"),
            "demo.toml: line 3: unknown key 'cell'; did you mean 'cells'?");
}

TEST(Settings, WrongTypesAndRangesNameTheLine) {
  for (const char* wrong :
       {"[cells]\nsize = 'ten'\n", "[cells]\nsize = nan\n", "[cells]\nsize = inf\n", "[cells]\nsize = -1\n",
        "[cells]\nsize = true\n", "[slices]\nmax = 1.5\n", "[slices]\nmax = 128\n",
        "[occlusion]\nresolution = 500\n", "[occlusion]\nresolution = 8192\n", "[occlusion]\nsubdivide = 0\n",
        "[navigation]\nmode = 'swim'\n", "[cells]\nlargest = 3\n", "[navigation]\nmode = 3\n",
        "[cells]\nregion = [0, 0, 0, 1]\n", "[cells]\nregion = [0, 0, 1]\n",
        "[cells]\nregion = [0, 0, 1, nan]\n", "[cells]\nregion = 4\n"})
    EXPECT_NE(refusal(model + wrong).find("demo.toml: line 4: '"), std::string::npos)
        << wrong << refusal(model + wrong);
}

TEST(Settings, WhatTheFilesDoNotSay) {
  for (const char* wrong : {"up = 'x'\n", "up = 3\n", "unit = -1\n", "unit = 'mm'\n", "crs = 28992\n",
                            "height_field = 3\n", "floor_height = 0\n"})
    EXPECT_NE(refusal(model + wrong).find("demo.toml: line 3: 'scene."), std::string::npos) << wrong;
}

TEST(Settings, ModelIsRequired) {
  EXPECT_NE(refusal("").find("'scene.model' is missing"), std::string::npos);
  EXPECT_NE(refusal("[scene]\nmodel = []\n").find("is empty"), std::string::npos);
  EXPECT_NE(refusal("[scene]\nmodel = ['a', 3]\n").find("line 2"), std::string::npos);
  EXPECT_NE(refusal("scene = 3\n").find("must be a section"), std::string::npos);
}

TEST(Settings, BrokenTomlNamesTheLine) {
  EXPECT_EQ(refusal("[scene]\nmodel = \n").rfind("demo.toml: line 2: ", 0), 0u);
  EXPECT_NE(refusal(model + "model = 'b'\n"), "");
}

TEST(Settings, MissingFileIsInputOutput) {
  // The last is too long to be asked about at all.
  for (const std::string& file : {std::string("/nowhere/demo.toml"), "/tmp/" + std::string(300, 'x')}) try {
      load_settings(file);
      ADD_FAILURE() << file;
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::input_output);
    }
  EXPECT_THROW(load_settings("/tmp"), Error);
}

TEST(Settings, HelpNamesEveryKey) {
  for (const auto& [key, value] : list_settings(parse(model)))
    EXPECT_NE(describe_settings().find(key + ":"), std::string::npos);
}

}  // namespace
}  // namespace veduta
