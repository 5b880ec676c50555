#include "pvs/crc32c.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace veduta {
namespace {

TEST(Crc32c, IsCastagnolis) {
  EXPECT_EQ(crc32c("123456789", 9), 0xE3069283u);
  EXPECT_EQ(crc32c_by_table("123456789", 9), 0xE3069283u);
  EXPECT_EQ(crc32c("", 0), 0u);
}

TEST(Crc32c, OfTheProcessorIsThatOfTheTable) {
  std::mt19937 random(1);
  std::vector<unsigned char> bytes(1000);
  for (unsigned char& byte : bytes) byte = static_cast<unsigned char>(random());
  for (size_t offset = 0; offset < 9; ++offset)
    for (size_t size = 0; size < 70; ++size)
      ASSERT_EQ(crc32c(&bytes[offset], size), crc32c_by_table(&bytes[offset], size)) << offset << " " << size;
  EXPECT_EQ(crc32c(bytes.data(), bytes.size()), crc32c_by_table(bytes.data(), bytes.size()));
}

}  // namespace
}  // namespace veduta
