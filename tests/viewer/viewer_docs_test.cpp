// docs/viewer.md says what the program does: every mode, key, option and column is in it.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>

#include "tests/pvs/small_city.h"
#include "viewer/stereo.h"
#include "viewer/view_cli.h"
#include "viewer/window/controls.h"

namespace veduta {
namespace {

const std::filesystem::path docs = std::filesystem::path(VEDUTA_TEST_DATA) / "../../docs";

class ViewerDocs : public testing::Test {
 protected:
  bool says(const std::string& text) const { return text_.find(text) != std::string::npos; }
  size_t rows_with(const std::string& begin) const {
    size_t count = 0;
    for (size_t at = text_.find("\n" + begin); at != std::string::npos; at = text_.find("\n" + begin, at + 1))
      ++count;
    return count;
  }
  const std::string text_ = test::read_bytes(docs / "viewer.md");
};

TEST_F(ViewerDocs, EveryStereoModeHasItsRow) {
  ASSERT_FALSE(text_.empty());
  for (const std::string& word : stereo_mode_words()) EXPECT_EQ(rows_with("| `" + word + "` | "), 1u) << word;
}

TEST_F(ViewerDocs, EveryKeyHasItsRow) {
  std::string rows;
  for (const KeyBinding& key : key_bindings())
    rows += std::string("| `") + key.name + "` | " + key.does + " |\n";
  EXPECT_TRUE(says("\n| key | |\n|---|---|\n" + rows + "\n")) << "the table of keys should be:\n" << rows;
}

TEST_F(ViewerDocs, EveryOptionIsThere) {
  testing::internal::CaptureStdout();
  const char* const words[] = {"veduta-view", "--help"};
  ASSERT_EQ(view_main(2, words), 0);
  const std::string help = testing::internal::GetCapturedStdout();
  const std::regex word("--[a-z-]+");
  std::set<std::string> options;
  for (std::sregex_iterator at(help.begin(), help.end(), word), end; at != end; ++at)
    options.insert(at->str());
  for (const char* others : {"--help", "--json", "--store"})
    options.erase(others);  // the last two: veduta verify's
  for (const std::string& option : options) EXPECT_TRUE(says("`" + option) || says(" " + option)) << option;
  EXPECT_GT(options.size(), 10u);
}

TEST_F(ViewerDocs, EveryPictureIsThere) {
  const std::regex picture(R"(!\[[^\]]+\]\(([^)]+)\))");
  size_t pictures = 0;
  for (std::sregex_iterator at(text_.begin(), text_.end(), picture), end; at != end; ++at, ++pictures)
    EXPECT_TRUE(std::filesystem::exists(docs / (*at)[1].str())) << (*at)[1];
  EXPECT_GT(pictures, 0u);
}

}  // namespace
}  // namespace veduta
