// R6: a run directory is continued by the same job alone, whoever runs it.
#include "tests/farm/bake_fixture.h"
#include "worker/settings.h"

namespace veduta {
namespace {

using namespace test;

class BakeIdentity : public Bake {
 protected:
  void SetUp() override { ASSERT_EQ(run(bake("--no-merge"), {{"FAKE_CELLS", "5"}}), 0) << output; }
  /// The configuration with one more key.
  std::string with(const std::string& key, const std::string& value) const {
    const size_t dot = key.rfind('.');
    const std::string table = key.substr(0, dot);
    return (table == "scene" ? "" : "[" + table + "]\n") + key.substr(dot + 1) + " = " + value + "\n";
  }
  /// Some value that the key may have and has not. Empty when none is known.
  std::string another_value(const std::string& key) const {
    const std::string model = "[scene]\nmodel = 'city.json'\n";
    const auto value_of = [&](const std::string& text) {
      for (const auto& [name, value] : list_settings(parse_settings(text, "x", directory)))
        if (name == key) return value;
      return std::string();
    };
    const std::string usual = value_of(model);
    for (const char* value : {"'fly'", "'y'", "'sections'", "'zoom'", "'EPSG:28992'", "[0, 0, 1, 1]", "2",
                              "0.5", "2.5", "32", "true", "false", "256"}) {
      try {
        if (value_of(model + with(key, value)) != usual) return value;
      } catch (const std::exception&) {
        // not a value of this key
      }
    }
    return {};
  }
};

TEST_F(BakeIdentity, EverySettingOfTheResultIsNamedWhenItDiffers) {
  int keys = 0;
  for (const auto& [key, value] : list_settings(Settings())) {
    if (key == "scene.model") continue;
    const std::string other = another_value(key);
    ASSERT_FALSE(other.empty()) << key << ": add a value that it may have";
    config = write_config("other.toml", with(key, other));
    EXPECT_EQ(run(bake()), 4) << key << " = " << other << ": " << output;
    EXPECT_NE(output.find("'" + key + "' is " + value + " there and "), std::string::npos) << output;
    EXPECT_EQ(std::count(output.begin(), output.end(), '\n'), 1) << output;
    ++keys;
  }
  EXPECT_GE(keys, 23);
  EXPECT_EQ(run(std::string(VEDUTA_PROGRAM) + " status --exit-code " + (directory / "run").string()), 0)
      << "nothing was changed: " << output;
}

TEST_F(BakeIdentity, OneByteOfTheSceneCounts) {
  std::ofstream(directory / "city.json") << "a model that the fake worker does not reaD";
  EXPECT_EQ(run(bake()), 4) << output;
  EXPECT_NE(output.find("'scene.model 1 content'"), std::string::npos) << output;
}

TEST_F(BakeIdentity, AnotherVersionOfTheAlgorithmIsRefused) {
  const fs::path file = directory / "run" / "fingerprint";
  std::string text = slurp(file);
  const std::string key = "algorithm version = ";
  const size_t at = text.find(key);
  ASSERT_NE(at, std::string::npos);
  text.insert(at + key.size(), "9");
  text[0] = text[0] == '0' ? '1' : '0';
  std::ofstream(file) << text;
  EXPECT_EQ(run(bake()), 4) << output;
  EXPECT_NE(output.find("'algorithm version' is 9"), std::string::npos) << output;
}

TEST_F(BakeIdentity, WorkersRanksThreadsAndTalkMayDiffer) {
  const auto expect_accepted = [&](const std::string& command, const Environment& environment = {}) {
    EXPECT_EQ(run(command, environment), 0) << command << "\n" << output;
  };
  expect_accepted(bake("--no-merge", "run", 3));
  expect_accepted(bake("-v --no-merge --cell-timeout 7 --rank-timeout 70"));
  expect_accepted(bake("-q --no-merge --gpu software"), {{"LP_NUM_THREADS", "1"}, {"OMP_NUM_THREADS", "1"}});
  fs::create_directories(directory / "elsewhere");
  fs::rename(directory / "city.json", directory / "elsewhere" / "city.json");
  fs::rename(directory / "demo.toml", directory / "elsewhere" / "demo.toml");
  config = (directory / "elsewhere" / "demo.toml").string();
  expect_accepted(bake("--no-merge"));
  if (has_mpirun()) expect_accepted(mpirun(2, bake("", "run", 1)));
}

}  // namespace
}  // namespace veduta
