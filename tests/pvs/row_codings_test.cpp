#include "pvs/row_codings.h"

#include <gtest/gtest.h>

#include "scene/random.h"

namespace veduta {
namespace {

RowCodings codings(const PvsRow& row, uint64_t objects) {
  return row_codings(row.data(), row.data() + row.size(), objects);
}

void expect(const RowCodings& found, uint64_t three, uint64_t three_runs, uint64_t bits, uint64_t bits_runs) {
  EXPECT_EQ(found.three_bytes, three);
  EXPECT_EQ(found.three_bytes_runs, three_runs);
  EXPECT_EQ(found.bits, bits);
  EXPECT_EQ(found.bits_runs, bits_runs);
}

TEST(RowCodings, KnownAnswers) {
  expect(codings({}, 0), 0, 0, 0, 0);
  // 0 0 0 0 0 0 and 00.
  expect(codings({}, 2), 6, 2, 1, 2);
  // 85 objects are 255 zeros, one run; the 86th needs a second.
  expect(codings({}, 85), 255, 2, 11, 2);
  expect(codings({}, 86), 258, 4, 11, 2);
  // 0 0 1 is 0*2 1.
  expect(codings({{0, completely_visible}}, 1), 3, 3, 1, 1);
  // 0 0 0, 2 0 3, 0 -1 0, 0 0 0: 0*3 2 0*1 3 0*1 -1 0*4, eleven bytes; 0110 is one byte that is not 0.
  expect(codings({{1, {2, 0, 3}}, {2, {0, -1, 0}}}, 4), 12, 11, 1, 1);
  // 27 objects, number 9 and 26: bytes 00 02 00 04.
  expect(codings({{9, completely_visible}, {26, completely_visible}}, 27), 81, 6, 4, 6);
}

/// The obvious way: the bytes themselves.
uint64_t coded(const std::vector<uint8_t>& bytes) {
  uint64_t out = 0;
  for (size_t i = 0; i < bytes.size();) {
    size_t run = 0;
    while (i + run < bytes.size() && bytes[i + run] == 0 && run < 255) ++run;
    out += run > 0 ? 2 : 1;
    i += std::max<size_t>(run, 1);
  }
  return out;
}

TEST(RowCodings, AreThoseOfTheBytesWrittenOut) {
  Random random(7);
  for (int trial = 0; trial < 200; ++trial) {
    const auto objects = static_cast<uint32_t>(random.below(3000));
    const uint64_t sparse = 1 + random.below(400);
    PvsRow row;
    std::vector<uint8_t> three(3 * objects), bits((objects + 7) / 8);
    for (uint32_t o = 0; o < objects; ++o) {
      if (random.below(sparse) != 0) continue;
      const VisibilityIndex index{static_cast<int8_t>(random.below(5)), 0,
                                  static_cast<int8_t>(1 + random.below(2))};
      row.push_back({o, index});
      three[3 * o] = static_cast<uint8_t>(index.x);
      three[3 * o + 2] = static_cast<uint8_t>(index.z);
      bits[o / 8] |= static_cast<uint8_t>(1u << (o % 8));
    }
    expect(codings(row, objects), three.size(), coded(three), bits.size(), coded(bits));
  }
}

}  // namespace
}  // namespace veduta
