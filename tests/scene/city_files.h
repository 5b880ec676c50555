// Rules and terminals that a test writes, in a directory of its own that goes away with it.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "scene/city/rules.h"
#include "scene/error.h"

namespace veduta::city {

/// A unit square on z = 0: the simplest terminal.
inline const std::string flat_obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";

class CityFiles : public testing::Test {
 protected:
  CityFiles() {
    std::string pattern = (std::filesystem::temp_directory_path() / "veduta-city-XXXXXX").string();
    directory_ = mkdtemp(pattern.data());
    write("window.obj", "g glass\n" + flat_obj);
    write("balcony.obj", "g rail\n" + flat_obj);
  }
  ~CityFiles() override {
    std::error_code ignored;
    std::filesystem::remove_all(directory_, ignored);
  }

  std::filesystem::path write(const std::string& name, const std::string& content) const {
    std::ofstream(directory_ / name, std::ios::binary) << content;
    return directory_ / name;
  }
  RuleSet load(const std::string& inside_of_rules) const {
    return load_rules(write("style.xml", "<Rules>" + inside_of_rules + "</Rules>"));
  }
  void expect_refused(const std::filesystem::path& path, const std::string& message) const {
    try {
      load_rules(path);
      ADD_FAILURE() << path << " was read; expected: " << message;
    } catch (const Error& error) {
      const std::string what = error.what();
      EXPECT_EQ(error.status(), ExitStatus::bad_input) << what;
      EXPECT_EQ(what.find('\n'), std::string::npos) << what;
      EXPECT_LT(what.size(), 700u) << what;
      EXPECT_NE(what.find(message), std::string::npos) << what << "\ndoes not say: " << message;
      EXPECT_TRUE(what.starts_with(directory_.string())) << what;
    }
  }

  std::filesystem::path directory_;
};

/// Rules of the thesis, figures A.4 and A.5, as printed.
inline const std::string figure_a4 = R"(
<Floor>
  <Split Balcony="+" Window="+">
    <Random minWidth="2" minHeight="3">
      <Face Balcony="+" Window="+"></Face>
    </Random>
  </Split>
  ...
</Floor>
)";
inline const std::string figure_a5 = R"(
<Face>
<Window Balcony="+" Window="+">
  <Fixed>
    <xProportions x1="2" x2="4" x3="2"></xProportions>
    <yProportions y1="3" y2="4" y3="3"></yProportions>
    <Elements>
      <Wall></Wall>
      <Wall></Wall>
      <Wall></Wall>
      <Wall></Wall>
      <Window></Window>
      <Wall></Wall>
      <Wall></Wall>
      <Wall></Wall>
      <Wall></Wall>
    </Elements>
  </Fixed>
</Window>
<Balcony>
  <Fixed>
    <xProportions x1="1" x2="4" x3="1"></xProportions>
    <yProportions y1="4" y2="1"></yProportions>
    <Elements>
      <Wall></Wall>
      <Wall></Wall>
      <Balcony></Balcony>
      <Wall></Wall>
      <Wall></Wall>
      <Wall></Wall>
    </Elements>
  </Fixed>
</Balcony>
...
</Face>
)";
inline const std::string figure_terminals =
    R"(<Terminals><Window file="window.obj"/><Balcony file="balcony.obj"/></Terminals>)";

}  // namespace veduta::city
