// The SVG is read by an XML parser: every object that lies in the window is there, in its class, where it is.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <pugixml.hpp>
#include <regex>
#include <sstream>

#include "export/export.h"
#include "export/plan_page.h"
#include "tests/export/toy_result.h"

namespace veduta {
namespace {

using test::TemporaryDirectory;

struct Shape {
  std::string kind, title;
  double west = INFINITY, east = -INFINITY, north = INFINITY, south = -INFINITY;  ///< quarters of a px
};

pugi::xml_document parsed(const std::filesystem::path& file) {
  pugi::xml_document document;
  const auto result = document.load_file(file.c_str());
  EXPECT_TRUE(result) << result.description();
  return document;
}

Shape shape_of(const pugi::xml_node& path) {
  Shape shape{path.attribute("class").value(), path.child_value("title")};
  const std::string way = path.attribute("d").value();
  const std::regex step("([Ml])(-?\\d+) (-?\\d+)");
  double x = 0, y = 0;
  for (std::sregex_iterator at(way.begin(), way.end(), step), end; at != end; ++at) {
    const bool from_there = (*at)[1] == "l";
    x = (from_there ? x : 0) + std::stod((*at)[2]);
    y = (from_there ? y : 0) + std::stod((*at)[3]);
    shape.west = std::min(shape.west, x), shape.east = std::max(shape.east, x);
    shape.north = std::min(shape.north, y), shape.south = std::max(shape.south, y);
  }
  return shape;
}

std::map<std::string, Shape> shapes_of(const pugi::xml_document& document) {
  std::map<std::string, Shape> shapes;
  for (const pugi::xpath_node& node : document.select_nodes("//g[@class='map']/path")) {
    const Shape shape = shape_of(node.node());
    shapes[shape.title.substr(0, shape.title.rfind(" ("))] = shape;
  }
  return shapes;
}

TEST(Plan, ShowsWhatIsVisibleAndHowMuch) {
  TemporaryDirectory directory;
  const PvsFile file = test::write_toy_result(directory / "city.pvs.h5");
  export_result(PvsStream(directory / "city.pvs.h5"), 1, directory / "plan.svg");
  const pugi::xml_document document = parsed(directory / "plan.svg");
  const auto shapes = shapes_of(document);
  ASSERT_EQ(shapes.size(), 5u) << "all but the one without triangles";
  EXPECT_EQ(shapes.at("terrain 1").kind, "g1");
  EXPECT_EQ(shapes.at("huis \xc3\xa9 <1> & \"2\"").kind, "o5");
  // x = -4 of 6: slices 5 and 6; z = 3 of 3: the top one. 1 - (2/3) (2/3) = 5/9 of the blocks.
  EXPECT_EQ(shapes.at("terrace").kind, "o3");
  EXPECT_EQ(shapes.at("terrace").title,
            "terrace (building): x -4, y 0, z 3 of 6 x 1 x 3 slices, 56 % of its blocks visible");
  // x = 1 of 2, z = 12 of 20: 1 - 1/2 * 11/20.
  EXPECT_EQ(shapes.at("tower").kind, "o3");
  EXPECT_EQ(shapes.at("shed").kind, "o0");
  EXPECT_EQ(shapes.at("shed").title, "shed (vegetation): hidden");
  EXPECT_EQ(std::string(document.select_node("//rect[@class='cell']/title").node().child_value()), "cell 1");
  EXPECT_EQ(std::string(document.select_node("//text[@class='title']").node().child_value()),
            "Cell 1 sees 4 of 6 objects");

  // One scale for all: the terrain is 140 m long, the terrace 72 and starts 30 m east of it, 37 m to the
  // south.
  const Shape &ground = shapes.at("terrain 1"), &terrace = shapes.at("terrace");
  const double per_m = (ground.east - ground.west) / 140;
  EXPECT_NEAR(per_m, 24, 0.5);
  EXPECT_NEAR((terrace.east - terrace.west) / per_m, 72, 0.1);
  EXPECT_NEAR((terrace.west - ground.west) / per_m, 30, 0.1);
  EXPECT_NEAR((terrace.north - ground.north) / per_m, 37, 0.1);
  EXPECT_NEAR((ground.south - ground.north) / per_m, 110, 0.1);
}

TEST(Plan, OfACellThatSeesNothingShowsTheCell) {
  TemporaryDirectory directory;
  test::write_toy_result(directory / "city.pvs.h5");
  export_result(PvsStream(directory / "city.pvs.h5"), 0, directory / "plan.svg");
  const pugi::xml_document document = parsed(directory / "plan.svg");
  EXPECT_EQ(document.select_nodes("//rect[@class='cell']/title").size(), 1u);
  for (const auto& [name, shape] : shapes_of(document))
    EXPECT_TRUE(shape.kind == "g0" || shape.kind == "o0") << name;
}

TEST(Plan, SharesOfBlocks) {
  EXPECT_DOUBLE_EQ(visible_share({0, 0, 1}, {6, 4, 3}), 1);
  EXPECT_DOUBLE_EQ(visible_share({0, 0, 3}, {6, 4, 3}), 1.0 / 3);
  EXPECT_DOUBLE_EQ(visible_share({2, 0, 0}, {6, 4, 3}), 2.0 / 6);
  EXPECT_DOUBLE_EQ(visible_share({-2, 0, 0}, {6, 4, 3}), 4.0 / 6);
  EXPECT_DOUBLE_EQ(visible_share({0, -3, 2}, {6, 4, 3}), 1 - 1.0 / 3 * 3.0 / 4);
  EXPECT_EQ(share_class(0), 0);
  EXPECT_EQ(share_class(0.01), 1);
  EXPECT_EQ(share_class(0.25), 1);
  EXPECT_EQ(share_class(0.26), 2);
  EXPECT_EQ(share_class(0.75), 3);
  EXPECT_EQ(share_class(0.99), 4);
  EXPECT_EQ(share_class(1), 5);
}

}  // namespace
}  // namespace veduta
