#include "viewer/stream/residency.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "tests/viewer/memory_source.h"

namespace veduta {
namespace {

constexpr uint64_t page_bytes = 100'000;  ///< of each page of the street, unless a test says otherwise
constexpr uint64_t rows_bytes = 20'000;   ///< more than all rows of a short street take

/// Reads what a residency wants, at once, and keeps books of what is here.
class Reader {
 public:
  Reader(uint32_t houses, uint64_t memory)
      : source(toy::long_street(houses)),
        pages(make_pages(source.index())),
        residency(source.index(), pages, memory),
        memory_bytes(memory),
        bytes(pages.size(), page_bytes) {}

  /// Looks, and reads until nothing more is wanted. \return what was read, in order.
  std::vector<StreamItem> look(const Gaze& gaze) {
    residency.look(gaze);
    return read();
  }
  std::vector<StreamItem> read() {
    std::vector<StreamItem> items;
    while (const std::optional<Residency::Next> next = residency.next()) {
      if (items.size() > 1000) {
        ADD_FAILURE() << "reading does not end";
        break;
      }
      read(next->item);
      items.push_back(next->item);
    }
    return items;
  }
  void read(const StreamItem& item) {
    if (item.kind == StreamItem::Kind::row) {
      lose(residency.row_arrived(item.number, source.read_row(item.number)));
      return;
    }
    const Residency::Arrival arrival = residency.page_arrived(item.number, bytes[item.number]);
    lose(arrival.gone);
    if (arrival.kept) here.insert(item.number);
    EXPECT_EQ(residency.pages_here(), here.size());
    EXPECT_TRUE(residency.bytes_here() <= memory_bytes || here.size() == 1) << residency.bytes_here();
  }
  void lose(const std::vector<StreamItem>& items) {
    for (const StreamItem& item : items) {
      gone.push_back(item);
      if (item.kind == StreamItem::Kind::row) continue;
      EXPECT_EQ(here.erase(item.number), 1u) << item.number;
    }
  }
  std::vector<uint32_t> pages_gone() const {
    std::vector<uint32_t> numbers;
    for (const StreamItem& item : gone)
      if (item.kind == StreamItem::Kind::page) numbers.push_back(item.number);
    return numbers;
  }

  toy::MemorySource source;
  std::vector<PageSpan> pages;
  Residency residency;
  uint64_t memory_bytes;
  std::vector<uint64_t> bytes;
  std::set<uint32_t> here;       ///< pages
  std::vector<StreamItem> gone;  ///< in order
};

StreamItem row(uint32_t number) {
  return {StreamItem::Kind::row, number};
}
StreamItem page(uint32_t number) {
  return {StreamItem::Kind::page, number};
}
std::set<uint32_t> listed_in(uint32_t cell) {
  return {0, cell - 2, cell - 1, cell, cell + 1, cell + 2};
}

TEST(Residency, AHouseOfTheTestsStreetIsAPage) {
  const Reader reader(20, 0);
  ASSERT_EQ(reader.pages.size(), 20u);
  EXPECT_LT(most_gpu_bytes(reader.pages[0].triangles), page_bytes);
}

TEST(Residency, FirstTheRowThenItsPagesNearestFirstThenRowsBesideThenTheirPages) {
  Reader reader(20, 12 * page_bytes);
  EXPECT_FALSE(reader.residency.fits());
  const std::vector<StreamItem> read = reader.look(toy::standing_in(10));
  const std::vector<StreamItem> expected{row(10), page(10), page(9), page(11), page(8), page(12),
                                         page(0), row(9),   row(11), page(7),  page(13)};
  EXPECT_EQ(read, expected);
  EXPECT_EQ(reader.residency.wanted_now().pages, 6u);
  EXPECT_EQ(reader.residency.wanted_now().missing, 0u);
}

TEST(Residency, RowsOfBothEyes) {
  Reader reader(20, 12 * page_bytes);
  Gaze gaze = toy::standing_in(10);
  gaze.position_m.x = 100.02f;
  gaze.eye_offset_m = {0.032f, 0, 0};
  const std::vector<StreamItem> read = reader.look(gaze);
  EXPECT_EQ(read[0], row(9));
  EXPECT_EQ(read[1], row(10));
  EXPECT_EQ(reader.residency.wanted_now().pages, 7u);  // 7 to 12, and 0
}

TEST(Residency, WhatIsAheadIsHereBeforeItIsNeeded) {
  Reader reader(40, 16 * page_bytes);
  Gaze gaze = toy::standing_in(10);
  gaze.velocity_m_s = {10, 0, 0};
  reader.look(gaze);
  for (uint32_t cell : {10u, 11u, 12u, 13u}) EXPECT_TRUE(reader.residency.row_here(cell)) << cell;
  for (uint32_t p = 8; p <= 15; ++p) EXPECT_TRUE(reader.here.count(p)) << p;
}

TEST(Residency, WalkingThroughACityLargerThanTheBudget) {
  const uint64_t budget = 9 * page_bytes + rows_bytes;
  Reader reader(60, budget);
  for (uint32_t cell = 3; cell < 57; ++cell) {
    reader.look(toy::standing_in(cell));
    for (uint32_t p : listed_in(cell)) EXPECT_TRUE(reader.here.count(p)) << p << " from cell " << cell;
    EXPECT_LE(reader.residency.bytes_here(), budget);
  }
  EXPECT_FALSE(reader.pages_gone().empty());
}

TEST(Residency, TheLongestUnusedGoesFirst) {
  Reader reader(60, 16 * page_bytes + rows_bytes);
  for (uint32_t cell : {20u, 40u}) reader.look(toy::standing_in(cell));
  EXPECT_EQ(reader.here.size(), 15u);  // seven to either side of each, and house 0
  ASSERT_TRUE(reader.gone.empty());
  reader.look(toy::standing_in(42));
  EXPECT_EQ(reader.pages_gone(), (std::vector<uint32_t>{23}));  // of the seven of cell 20, wanted least there
  reader.look(toy::standing_in(47));
  for (uint32_t p : reader.pages_gone()) EXPECT_LE(p, 23u) << "though it was used later";
}

TEST(Residency, ASmallStepMakesNothingComeAndGo) {
  // All of 60 pages are wanted, 20 find room: as the eye goes to and fro by a metre or two, the set stays.
  Reader reader(60, 20 * page_bytes + rows_bytes);
  Gaze gaze = toy::standing_in(30);
  gaze.everything = true;
  reader.look(gaze);
  EXPECT_EQ(reader.here.size(), 20u);
  reader.gone.clear();
  for (int i = 0; i < 40; ++i) {  // and drifts by 5 m
    gaze.position_m.x += i % 2 ? 2.25f : -2.0f;
    for (const StreamItem& item : reader.look(gaze)) EXPECT_EQ(item.kind, StreamItem::Kind::row);
  }
  EXPECT_TRUE(reader.pages_gone().empty());
  // A long way is another matter.
  gaze.position_m.x += 150;
  reader.look(gaze);
  for (uint32_t p = 42; p <= 48; ++p) EXPECT_TRUE(reader.here.count(p)) << p;
  EXPECT_FALSE(reader.pages_gone().empty());
}

TEST(Residency, EverythingIsAllPagesNearestFirst) {
  Reader reader(30, 10 * page_bytes + rows_bytes);
  Gaze gaze = toy::standing_in(15);
  gaze.everything = true;
  reader.look(gaze);
  EXPECT_EQ(reader.residency.wanted_now().pages, 30u);
  EXPECT_EQ(reader.residency.wanted_now().missing, 20u);
  for (uint32_t p = 12; p <= 18; ++p) EXPECT_TRUE(reader.here.count(p)) << p;
}

TEST(Residency, AnEyeOutsideAllCellsSeesEverything) {
  Reader reader(30, 100 * page_bytes);
  Gaze gaze = toy::standing_in(15);
  gaze.position_m.y = -5.03f;
  reader.look(gaze);
  EXPECT_EQ(reader.residency.wanted_now().pages, 30u);
  gaze.position_m.y = -4.99f;  // an eye is outside, its midpoint is not
  gaze.eye_offset_m = {0, 0.03f, 0};
  reader.look(gaze);
  EXPECT_EQ(reader.residency.wanted_now().pages, 30u);
  gaze.eye_offset_m = {};
  reader.look(gaze);
  EXPECT_EQ(reader.residency.wanted_now().pages, 6u);
}

TEST(Residency, WhatFitsIsReadWholeInTheEnd) {
  Reader reader(30, 40 * page_bytes);
  EXPECT_TRUE(reader.residency.fits());
  const std::vector<StreamItem> read = reader.look(toy::standing_in(15));
  EXPECT_EQ(read[0], row(15));
  EXPECT_EQ(reader.here.size(), 30u);
  EXPECT_TRUE(reader.gone.empty());
}

TEST(Residency, APageIsKeptHoweverLarge) {
  Reader reader(20, page_bytes / 2);
  reader.look(toy::standing_in(10));
  EXPECT_EQ(reader.here, std::set<uint32_t>{10});
  reader.look(toy::standing_in(17));
  EXPECT_EQ(reader.here, std::set<uint32_t>{17});
}

TEST(Residency, APageThatTurnsOutTooLargeIsReadOnceAndLeftOut) {
  Reader reader(20, 4 * page_bytes);
  reader.look(toy::standing_in(4));
  reader.bytes[17] = 5 * page_bytes;
  const std::vector<StreamItem> read = reader.look(toy::standing_in(15));
  EXPECT_EQ(std::count(read.begin(), read.end(), page(17)), 1);
  EXPECT_FALSE(reader.here.count(17)) << "nearer ones were here before it";
  EXPECT_LE(reader.residency.bytes_here(), 4 * page_bytes);
  // Where it is the first that is wanted, it is the one that is kept.
  reader.look(toy::standing_in(4));
  reader.look(toy::standing_in(17));
  EXPECT_EQ(reader.here, std::set<uint32_t>{17});
  reader.look(toy::standing_in(11));
  EXPECT_FALSE(reader.here.count(17));
  EXPECT_TRUE(reader.here.count(11));
}

TEST(Residency, APageThatCannotBePutUpComesAgainWhenOthersWent) {
  Reader reader(60, 16 * page_bytes + rows_bytes);
  for (uint32_t cell : {20u, 40u}) reader.look(toy::standing_in(cell));
  reader.here.erase(40);
  reader.lose(reader.residency.page_refused(40));
  EXPECT_EQ(reader.pages_gone().size(), 1u);
  EXPECT_LE(reader.pages_gone()[0], 23u);
  EXPECT_EQ(reader.read(), (std::vector<StreamItem>{page(40)}));
}

TEST(Residency, APageThatCannotBePutUpWhereNothingIsWantedLessWaits) {
  Reader reader(20, 6 * page_bytes + rows_bytes);
  reader.look(toy::standing_in(10));
  reader.gone.clear();
  reader.here.erase(0);  // wanted least of the six
  reader.lose(reader.residency.page_refused(0));
  EXPECT_TRUE(reader.gone.empty());
  for (const StreamItem& item : reader.read()) EXPECT_NE(item, page(0));
  reader.look(toy::standing_in(13));
  EXPECT_TRUE(reader.here.count(0)) << "others went: it is tried again";
}

TEST(Residency, APageThatNeverCanBePutUpIsGivenUp) {
  Reader reader(60, 40 * page_bytes);
  for (uint32_t cell : {20u, 30u, 40u}) reader.look(toy::standing_in(cell));
  int refusals = 0;
  while (reader.here.count(40) && refusals < 100) {
    ++refusals;
    reader.here.erase(40);
    reader.lose(reader.residency.page_refused(40));
    reader.read();
  }
  EXPECT_LE(refusals, 8);
  EXPECT_GE(refusals, 2);
}

TEST(Residency, BooksHoldOnARandomWalkThroughPagesOfAllSizes) {
  std::mt19937 random(7);
  for (int round = 0; round < 20; ++round) {
    const uint64_t budget = (2 + random() % 20) * page_bytes + rows_bytes;
    Reader reader(50, budget);
    for (uint64_t& bytes : reader.bytes) bytes = 1000 + random() % page_bytes;
    Gaze gaze = toy::standing_in(25);
    for (int step = 0; step < 60; ++step) {
      gaze.position_m.x =
          std::clamp(gaze.position_m.x + static_cast<float>(random() % 41) - 20, 1.0f, 499.0f);
      gaze.velocity_m_s.x = static_cast<float>(random() % 41) - 20;
      gaze.everything = random() % 8 == 0;
      reader.look(gaze);
      if (random() % 4 == 0 && !reader.here.empty()) {
        const uint32_t refused = *reader.here.begin();
        reader.here.erase(refused);
        reader.lose(reader.residency.page_refused(refused));
        reader.read();
      }
      uint64_t bytes = 0;
      for (uint32_t p : reader.here) bytes += reader.bytes[p];
      ASSERT_LE(bytes, reader.residency.bytes_here());
      ASSERT_LE(reader.residency.bytes_here(), bytes + rows_bytes);
      for (uint32_t p = 0; p < 50; ++p) ASSERT_EQ(reader.residency.page_here(p), reader.here.count(p) > 0);
    }
  }
}

}  // namespace
}  // namespace veduta
