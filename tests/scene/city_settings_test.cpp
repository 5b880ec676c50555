#include "scene/city/city_settings.h"

#include "scene/error.h"
#include "tests/scene/temporary_models.h"

namespace veduta::city {
namespace {

class CitySettingsFile : public TemporaryModels {
 protected:
  CitySettingsFile() {
    write("plan.geojson", "{}");
    write("brick.xml", "<rules/>");
  }
  CitySettings parse(const std::string& text) const {
    return parse_city_settings(text, "city.toml", directory_);
  }
  void expect_refused(const std::string& text, const std::string& message,
                      ExitStatus status = ExitStatus::usage) const {
    try {
      parse(text);
      ADD_FAILURE() << "accepted: " << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), status) << error.what();
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
  const std::string rules = "[[rules]]\nfile = \"brick.xml\"\n";
  const std::string streets = "[streets]\nblocks = [2, 3]\n";
};

TEST_F(CitySettingsFile, ReadsAPlanWithItsKeys) {
  const CitySettings read = parse(
      "seed = 7\n[plan]\nfile = \"plan.geojson\"\nuse = [\"floors\"]\ncrs = \"EPSG:3946\"\nunit = 0.5\n"
      "floors_field = \"NB\"\nheight_field = \"H\"\nfloor_height = 3.2\nmargin = 5\n" +
      rules + "weight = 2.5\nfloors = [2, 4]\n");
  EXPECT_EQ(read.seed, 7u);
  EXPECT_EQ(read.plan_file, directory_ / "plan.geojson");
  EXPECT_TRUE(read.footprints.use_floors);
  EXPECT_FALSE(read.footprints.use_heights);
  EXPECT_FALSE(read.footprints.use_ground);
  EXPECT_EQ(read.plan_import.crs, "EPSG:3946");
  EXPECT_EQ(read.plan_import.unit_m, 0.5);
  EXPECT_EQ(read.plan_import.floors_field, "NB");
  EXPECT_EQ(read.plan_import.height_field, "H");
  EXPECT_EQ(read.footprints.floor_height_m, 3.2);
  EXPECT_EQ(read.footprints.margin_m, 5);
  ASSERT_EQ(read.styles.size(), 1u);
  EXPECT_EQ(read.styles[0].file, directory_ / "brick.xml");
  EXPECT_EQ(read.styles[0].architecture.weight, 2.5);
  EXPECT_EQ(read.styles[0].architecture.floors, (std::array{2, 4}));
}

TEST_F(CitySettingsFile, ReadsStreetsWithTheirKeys) {
  const CitySettings read = parse(
      "[streets]\nblocks = [2, 3]\nbuildings_per_block = 8\nlot = [20, 22.5]\nstreet = 12\navenue = 30\n"
      "avenue_every = 3\npavement = 3\nvariants = 4\n" +
      rules + "depth = [8, 12.5]\ngap = 1\ncourtyard = 0.5\n");
  EXPECT_TRUE(read.plan_file.empty());
  EXPECT_EQ(read.streets.blocks, (std::array{2, 3}));
  EXPECT_EQ(read.streets.buildings_per_block, 8);
  EXPECT_EQ(read.streets.lot, (std::array{20.0, 22.5}));
  EXPECT_EQ(read.streets.street, 12);
  EXPECT_EQ(read.streets.avenue, 30);
  EXPECT_EQ(read.streets.avenue_every, 3);
  EXPECT_EQ(read.streets.pavement, 3);
  EXPECT_EQ(read.streets.variants, 4);
  EXPECT_EQ(read.styles[0].architecture.depth, (std::array{8.0, 12.5}));
  EXPECT_EQ(read.styles[0].architecture.gap, 1);
  EXPECT_EQ(read.styles[0].architecture.courtyard, 0.5);
}

TEST_F(CitySettingsFile, NamesTheNearestKeyToAnUnknownOne) {
  expect_refused("sed = 1\n" + streets + rules, "city.toml: line 1: unknown key 'sed'; did you mean 'seed'?");
  expect_refused(streets + "pavment = 1\n" + rules, "line 3: unknown key 'streets.pavment'");
  expect_refused(streets + "pavment = 1\n" + rules, "did you mean 'streets.pavement'?");
  expect_refused(streets + rules + "wieght = 1\n", "did you mean 'rules.weight'?");
}

TEST_F(CitySettingsFile, RefusesValuesOfAnotherKindOrOutOfRange) {
  expect_refused("seed = -1\n" + streets + rules, "line 1: 'seed' must be a whole number");
  expect_refused("seed = 1.5\n" + streets + rules, "'seed' must be a whole number");
  expect_refused(streets + "street = \"wide\"\n" + rules, "line 3: 'streets.street' must be a number from 1");
  expect_refused(streets + "street = nan\n" + rules, "'streets.street' must be a number");
  expect_refused(streets + "street = inf\n" + rules, "'streets.street' must be a number");
  expect_refused("[streets]\nblocks = [0, 1]\n" + rules, "'streets.blocks' must be a whole number from 1");
  expect_refused("[streets]\nblocks = [1]\n" + rules, "'streets.blocks' must be two numbers");
  expect_refused("[streets]\nbuildings_per_block = 3\n" + rules, "must be even");
  expect_refused(streets + rules + "floors = [4, 3]\n", "'rules.floors' must be [from, to]");
  expect_refused(streets + rules + "weight = 0\n", "each 'rules.weight' is 0");
  expect_refused(streets + rules + "depth = [10, 17]\n", "does not fit a 'streets.lot' of 18 m");
  expect_refused(streets + rules + "gap = 7.5\n", "leaves less than 2 m");
  expect_refused(streets + "pavement = 5\n" + rules, "twice leaves nothing of a street");
  expect_refused("[streets]\nblocks = [1000, 1000]\nbuildings_per_block = 1000\n" + rules, "10 million");
  expect_refused("[plan]\nfile = \"plan.geojson\"\nuse = [\"roofs\"]\n" + rules,
                 "'plan.use' holds \"roofs\"");
  expect_refused("[plan]\nfile = \"plan.geojson\"\nuse = \"floors\"\n" + rules,
                 "'plan.use' must be an array");
  expect_refused("[plan]\nfile = \"plan.geojson\"\n" + rules + "gap = 1\n", "'rules.gap' has no meaning");
  expect_refused("plan = 3\n" + rules, "'plan' must be a section");
  expect_refused(streets + "[rules]\nfile = \"brick.xml\"\n", "'rules' must be entries [[rules]]");
}

TEST_F(CitySettingsFile, RefusesWhatIsMissing) {
  expect_refused(rules, "give either [plan]");
  expect_refused("[plan]\nfile = \"plan.geojson\"\n" + streets + rules, "give either [plan]");
  expect_refused("[plan]\nmargin = 1\n" + rules, "'plan.file' is missing");
  expect_refused(streets, "'rules' is missing");
  expect_refused(streets + "[[rules]]\nweight = 1\n", "'rules.file' is missing");
  expect_refused("[plan]\nfile = \"no.geojson\"\n" + rules, "city.toml: line 2: 'plan.file' names",
                 ExitStatus::bad_input);
  expect_refused(streets + "[[rules]]\nfile = \"no.xml\"\n", "city.toml: line 4: 'rules.file' names",
                 ExitStatus::bad_input);
  expect_refused("= 3", "city.toml: line 1: ");
  EXPECT_THROW(load_city_settings(directory_ / "no.toml"), Error);
  std::ofstream(directory_ / "empty.toml").close();
  try {
    load_city_settings(directory_ / "empty.toml");
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::usage) << error.what();
  }
  EXPECT_THROW(load_city_settings(directory_), Error);
}

TEST_F(CitySettingsFile, HelpNamesEveryKey) {
  const std::string help = describe_city_settings();
  for (const char* const key : {"seed: ", "plan.file: ", "streets.variants: ", "rules.courtyard: "})
    EXPECT_NE(help.find(key), std::string::npos) << key;
  EXPECT_NE(help.find("streets.lot: [a, b], 4 to 1000; default [16, 18]"), std::string::npos) << help;
}

}  // namespace
}  // namespace veduta::city
