#include "viewer/window/name_search.h"

#include <gtest/gtest.h>

namespace veduta {
namespace {

std::vector<Object> named(const std::vector<std::string>& names) {
  std::vector<Object> objects;
  for (const std::string& name : names) objects.push_back({name, Kind::building, 0, 0});
  return objects;
}

using Numbers = std::vector<uint32_t>;

TEST(NameSearch, FindsAPartOfANameWhateverItsCase) {
  const NameSearch search(named({"Old Tower", "Church", "tower of London", "TOWERS", "town hall"}));
  const NameSearch::Found found = search.find("Tower", 10);
  EXPECT_EQ(found.objects, (Numbers{2, 3, 0})) << "names that begin so come first";
  EXPECT_EQ(found.all, 3u);
  EXPECT_EQ(search.find("hur", 10).objects, Numbers{1});
  EXPECT_TRUE(search.find("castle", 10).objects.empty());
  EXPECT_TRUE(search.find("", 10).objects.empty());
}

TEST(NameSearch, AMatchLiesInOneName) {
  const NameSearch search(named({"ab", "ab", "", "b a"}));
  EXPECT_EQ(search.find("ba", 10).all, 0u);
  EXPECT_EQ(search.find("b", 10).objects, (Numbers{3, 0, 1}));
  EXPECT_EQ(search.find(std::string("b\0a", 3), 10).all, 0u) << "not across the end of a name";
}

TEST(NameSearch, ANameCountsOnce) {
  EXPECT_EQ(NameSearch(named({"aaaa", "xaaa"})).find("a", 10).all, 2u);
}

TEST(NameSearch, CountsAllAndGivesTheFirst) {
  std::vector<std::string> names;
  for (int i = 0; i < 1000; ++i) names.push_back((i % 10 ? "house " : "a house ") + std::to_string(i));
  const NameSearch::Found found = NameSearch(named(names)).find("house", 3);
  EXPECT_EQ(found.all, 1000u);
  EXPECT_EQ(found.objects, (Numbers{1, 2, 3}));
  EXPECT_EQ(NameSearch(named(names)).find("a house", 200).objects.size(), 100u);
}

TEST(NameSearch, NamesOfAnyBytes) {
  const NameSearch search(named({std::string("a\0b", 3), "\xff\xfe", "Łódź"}));
  EXPECT_EQ(search.find("b", 10).objects, Numbers{0});
  EXPECT_EQ(search.find("\xfe", 10).objects, Numbers{1});
  EXPECT_EQ(search.find("ód", 10).objects, Numbers{2});
}

TEST(NameSearch, ACityWithoutObjects) {
  EXPECT_EQ(NameSearch(std::vector<Object>{}).find("a", 10).all, 0u);
  EXPECT_EQ(NameSearch().find("a", 10).all, 0u);
}

}  // namespace
}  // namespace veduta
