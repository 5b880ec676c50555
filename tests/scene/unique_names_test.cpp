#include "scene/unique_names.h"

#include <gtest/gtest.h>

namespace veduta {
namespace {

TEST(UniqueNames, ANameThatWasGivenGetsTheNextFreeNumber) {
  UniqueNames unique('#');
  EXPECT_EQ(unique("a"), "a");
  EXPECT_EQ(unique("a#3"), "a#3");
  EXPECT_EQ(unique("a"), "a#2");
  EXPECT_EQ(unique("a"), "a#4");
  EXPECT_EQ(unique("b"), "b");
  EXPECT_EQ(unique("a#2"), "a#2#2");
}

}  // namespace
}  // namespace veduta
