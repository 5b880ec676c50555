// Rule sets: what is read, how attributes choose, and what is refused.
#include "scene/city/rules.h"

#include "city_files.h"

namespace veduta::city {
namespace {

class CityRules : public CityFiles {
 protected:
  // Names of the terminals of a state's only choice.
  static std::vector<std::string> terminals(const RuleSet& rules, const Choice& choice) {
    std::vector<std::string> names;
    for (const Successor& cell : choice.cells)
      names.push_back(cell.is_terminal ? rules.terminals[cell.index].name : "");
    return names;
  }
};

TEST_F(CityRules, FiguresOfTheThesisAsPrinted) {
  const RuleSet rules = load(figure_terminals + figure_a4 + figure_a5);
  EXPECT_EQ(rules.name, "style");
  const State& floor = rules.states[rules.start(1, 5, Side::front)];
  ASSERT_EQ(floor.choices.size(), 1u);
  const Split& split = rules.splits[floor.choices[0].split];
  EXPECT_EQ(split.type, Split::Type::random);
  EXPECT_EQ(split.min_width_m, 2);
  EXPECT_EQ(split.min_height_m, 3);
  ASSERT_FALSE(floor.choices[0].cells[0].is_terminal);
  const State& face = rules.states[floor.choices[0].cells[0].index];
  ASSERT_EQ(face.choices.size(), 2u);
  const Split& window = rules.splits[face.choices[0].split];
  ASSERT_EQ(window.columns.size(), 3u);
  EXPECT_EQ(window.columns[1].amount, 4);
  EXPECT_FALSE(window.columns[1].is_metres);
  EXPECT_EQ(terminals(rules, face.choices[0])[4], "Window");
  // Column by column, each from below: the balcony is in the middle column, below a lintel.
  const std::vector<std::string> balcony = terminals(rules, face.choices[1]);
  EXPECT_EQ(balcony, (std::vector<std::string>{"Wall", "Wall", "Balcony", "Wall", "Wall", "Wall"}));
  EXPECT_EQ(rules.splits[face.choices[1].split].rows[0].amount, 4);
}

// A rule is eliminated where it and the shape both have an attribute, and the values differ.
TEST_F(CityRules, AttributesEliminateRules) {
  const RuleSet rules = load(R"(
    <Floor><F><Fixed><xProportions x1="1" x2="1" x3="1"/><Elements><Face A="+"/><Face A="-"/><Face/></Elements>
    </Fixed></F></Floor>
    <Face><Plus A="+"><Wall/></Plus><Minus A="-"><Wall/></Minus><Both A="+|-"><Wall/></Both><Any><Wall/></Any></Face>)");
  const Choice& floor = rules.states[rules.start(0, 1, Side::front)].choices[0];
  const size_t expected[] = {3, 3, 4};
  for (size_t i = 0; i < 3; ++i) EXPECT_EQ(rules.states[floor.cells[i].index].choices.size(), expected[i]);
  EXPECT_NE(floor.cells[0].index, floor.cells[1].index);
}

TEST_F(CityRules, ShapesInheritAttributes) {
  const RuleSet rules = load(R"(
    <Floor><F><Bay/></F></Floor><Bay><B><Face/></B></Bay>
    <Face><Shop Floor="ground"><Wall/></Shop><Home Floor="middle|top"><Wall/></Home>
          <Noble Storey="2"><Wall/></Noble><Attic FromTop="0"><Wall/></Attic><Yard Side="court"><Wall/></Yard>
    </Face>)");
  const auto choices = [&](int floor, int floors, Side side) {
    const State& start = rules.states[rules.start(floor, floors, side)];
    const State& bay = rules.states[start.choices[0].cells[0].index];
    return rules.states[bay.choices[0].cells[0].index].choices.size();
  };
  EXPECT_EQ(choices(0, 5, Side::front), 1u);   // shop
  EXPECT_EQ(choices(1, 5, Side::street), 1u);  // home
  EXPECT_EQ(choices(2, 5, Side::front), 2u);   // home, noble
  EXPECT_EQ(choices(4, 5, Side::front), 2u);   // home, attic
  EXPECT_EQ(choices(2, 3, Side::court), 4u);   // home, noble, attic, yard
  EXPECT_EQ(choices(0, 1, Side::front), 2u);   // one floor is a ground floor: shop, attic
}

TEST_F(CityRules, FloorHeights) {
  const RuleSet rules =
      load(R"(<Building groundHeight="4" floorHeight="3" topHeight="2.5"/><Floor><F><Wall/></F></Floor>)");
  EXPECT_EQ(floor_heights_m(rules, 4, 0), (std::vector<double>{4, 3, 3, 2.5}));
  EXPECT_EQ(floor_heights_m(rules, 1, 0), (std::vector<double>{4}));
  EXPECT_EQ(floor_heights_m(rules, 4, 25), (std::vector<double>{8, 6, 6, 5}));
}

// What a file says itself stands in place of what it includes.
TEST_F(CityRules, IncludedRules) {
  write("base.xml", R"(<Rules name="base"><Building floorHeight="5"/><Roof type="hipped" pitch="30"/><Course/>
    <Terminals><Wall layer="wall_stone"/></Terminals>
    <Floor><F><Bay/></F></Floor><Bay><B><Wall/></B></Bay></Rules>)");
  const RuleSet rules = load(R"(<Include file="base.xml"/><Roof/>
    <Terminals><Glass/></Terminals><Bay><B><Glass/></B></Bay>)");
  EXPECT_EQ(rules.name, "style");
  EXPECT_EQ(rules.floor_height_m, 5);
  EXPECT_EQ(rules.roof.type, Roof::Type::flat);
  EXPECT_EQ(rules.courses.size(), 1u);
  EXPECT_EQ(rules.layers[rules.wall_layer], "wall_stone");
  const State& floor = rules.states[rules.start(0, 1, Side::front)];
  const State& bay = rules.states[floor.choices[0].cells[0].index];
  EXPECT_EQ(terminals(rules, bay.choices[0]), (std::vector<std::string>{"Glass"}));
}

TEST_F(CityRules, BadRules) {
  const std::string floor = "<Floor><F>\n<Fixed><Elements><Face/></Elements></Fixed></F></Floor>\n";
  const auto fixed = [](const std::string& inside) {
    return "<Floor><F><Fixed>\n" + inside + "</Fixed></F></Floor>";
  };
  const std::pair<std::string, std::string> table[] = {
      {"<Floor>", "line 1: is not well-formed XML"},
      {"", "line 1: no shape 'Floor'"},
      {"<Include file=\"" + std::string(300, 'a') + "\"/>", "line 1: 'aaa"},
      {"<Terminals><A file=\"" + std::string(300, 'a') + "\"/></Terminals>",
       "line 1: terminal 'A': there is no"},
      {floor, "line 2: 'Face' is neither a shape nor a terminal"},
      {"<Floor><F>\n<Wal/></F></Floor>",
       "line 2: 'Wal' is neither a shape nor a terminal, below the root or in <Terminals>; did you mean "
       "'Wall'?"},
      {"<Floor></Floor>", "line 1: no rule applies to shape 'Floor' with Floor=\"ground\""},
      {floor + "<Face><G Floor=\"ground\"><Wall/></G></Face>",
       "line 2: no rule applies to shape 'Face' with Floor=\"middle\""},
      {"<Floor><F><Wall/><Wall/></F></Floor>", "line 1: rule 'F' of 'Floor' holds 2 elements"},
      {"<Floor><F></F></Floor>", "line 1: rule 'F' of 'Floor' holds 0 elements"},
      {"<Floor><F><Floor/></F></Floor>", "rule 'F' of shape 'Floor' never ends"},
      {floor + "<Face>\n<G><Floor/></G></Face>", "never ends"},
      {floor + "<Face>\n<G><Random minWidth=\"2\"><Face/></Random></G></Face>",
       "line 4: rule 'G' of shape 'Face' never ends"},
      {"<Floor><F><Random minWidth=\"-2\"><Wall/></Random></F></Floor>",
       "minWidth=\"-2\" of <Random>; give a number"},
      {"<Floor><F><Random minWidth=\"0\"><Wall/></Random></F></Floor>", "give a number from 0.05"},
      {"<Floor><F><Random minWidth=\"two\"><Wall/></Random></F></Floor>", "minWidth=\"two\""},
      {"<Floor><F><Random minWidth=\"nan\"><Wall/></Random></F></Floor>", "minWidth=\"nan\""},
      {"<Floor><F><Random minWith=\"2\"><Wall/></Random></F></Floor>",
       "<Random> knows no attribute 'minWith'; did you mean 'minWidth'?"},
      {"<Floor><F><Random minWidth=\"2\"></Random></F></Floor>", "<Random> without a shape"},
      {"<Floor><F weight=\"-1\"><Wall/></F></Floor>", "weight=\"-1\""},
      {"<Floor><F weight=\"1\" probability=\"1\"><Wall/></F></Floor>", "both weight and probability"},
      {"<Floor><F weight=\"0\"><Wall/></F></Floor>", "no rule applies"},
      {fixed("<xProportions x1=\"1\" x2=\"1\"/><Elements><Wall/></Elements>"),
       "line 1: 1 elements for 2 columns of 1 rows; list 2"},
      {fixed("<xProportions x1=\"1\" x3=\"1\"/>"), "line 2: <xProportions> has 'x3' where 'x2' should be"},
      {fixed("<yProportions x1=\"1\"/>"), "line 2: <yProportions> has 'x1' where 'y1' should be"},
      {fixed("<xProportions x1=\"-1\"/>"), "line 2: x1=\"-1\"; give a positive number"},
      {fixed("<xProportions x1=\"0\"/>"), "line 2: x1=\"0\""},
      {fixed("<xProportions x1=\"1cm\"/>"), "line 2: x1=\"1cm\""},
      {fixed("<xProportions x1=\"inf\"/>"), "line 2: x1=\"inf\""},
      {fixed("<xProportions/>"), "line 2: <xProportions> without sizes"},
      {fixed("<xProportions x1=\"1m\" x2=\"2m\"/>"), "line 2: all sizes of <xProportions> are in metres"},
      {fixed("<xProportion x1=\"1\"/>"), "<Fixed> knows no <xProportion>; did you mean 'xProportions'?"},
      {fixed("<Elements><Wall/></Elements><Elements/>"), "line 2: a second <Elements>"},
      {fixed(""), "<Fixed> without <Elements>"},
      {fixed("<Elements><Wall><Wall/></Wall></Elements>"), "line 2: an element inside <Wall>"},
      {"<Floor><F Flor=\"ground\"><Wall/></F></Floor>",
       "no shape has the attribute 'Flor' of rule 'F'; did you mean 'Floor'?"},
      {"<Floor><F Floor=\"grond\"><Wall/></F></Floor>",
       "Floor=\"grond\" is never so; give one of: ground, middle, top"},
      {"<Floor><F Storey=\"two\"><Wall/></F></Floor>", "'two' does not count floors"},
      {"<Floor><F><Wall Floor=\"top\"/></F></Floor>", "terminal 'Wall' has the attribute 'Floor'"},
      {"<Floor><F><Face Colr=\"1\"/></F></Floor><Face><G><Wall/></G></Face>",
       "no rule asks for the attribute 'Colr'"},
      {"<Floor a=\"1\"><F><Wall/></F></Floor>", "<Floor> knows no attribute 'a'"},
      {"<Floor><F><Wall/></F></Floor>\n<Floor/>", "line 2: <Floor> is there twice"},
      {"<Wall><F><Wall/></F></Wall>" + floor, "'Wall' is a terminal as well as a shape"},
      {"<Terminals>\n<Window file=\"no.obj\"/></Terminals>", "line 2: terminal 'Window': there is no file '"},
      {"<Terminals><Window/>\n<Window/></Terminals>", "line 2: terminal 'Window' is there twice"},
      {"<Terminals><Window fil=\"a\"/></Terminals>",
       "<Window> knows no attribute 'fil'; did you mean 'file'?"},
      {"<Roof type=\"gable\"/>", "type=\"gable\" of <Roof>; give one of: flat, gabled, hipped, mansard"},
      {"<Roof pitch=\"90\"/>", "pitch=\"90\" of <Roof>; give a number from 1 to 85"},
      {"<Building floorHeight=\"0\"/>", "floorHeight=\"0\""},
      {"<Course floor=\"first\"/>", "floor=\"first\" of <Course>"},
      {"<Course place=\"left\"/>", "place=\"left\" of <Course>; give one of: top, bottom"},
      {"<Include file=\"none.xml\"/>", "'none.xml' is not a file"},
      {"<Include file=\"style.xml\"/>", "more than 8 deep"},
  };
  for (const auto& [content, message] : table)
    expect_refused(write("style.xml", "<Rules>" + content + "</Rules>"), message);
  expect_refused(write("style.xml", "<Style/>"), "line 1: the root is <Style>");
  expect_refused(write("style.xml", "no XML"), "line 1: ");
  expect_refused(directory_ / "none.xml", "does not exist");
}

// Every way of cutting a file short, and many changed bytes: an error or a rule set, never a crash.
TEST_F(CityRules, CutAndChangedFilesNeverCrash) {
  const std::string good =
      "<Rules><Building floorHeight=\"3\"/><Course depth=\"0.2\"/><Roof type=\"hipped\"/>" +
      figure_terminals + figure_a4 + figure_a5 + "</Rules>";
  const auto loads = [&](const std::string& content) {
    try {
      load_rules(write("style.xml", content));
      return true;
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::bad_input) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      return false;
    }
  };
  ASSERT_TRUE(loads(good));
  for (size_t length = 0; length < good.size(); ++length)
    EXPECT_FALSE(loads(good.substr(0, length))) << length;
  uint32_t state = 1;
  int refused = 0;
  for (int round = 0; round < 800; ++round) {
    std::string changed = good;
    state = state * 1664525u + 1013904223u;
    changed[(state >> 8) % changed.size()] = "<>/=\"0123456789 -abFx&"[(state >> 4) % 22];
    refused += !loads(changed);
  }
  EXPECT_GT(refused, 400);
}

}  // namespace
}  // namespace veduta::city
