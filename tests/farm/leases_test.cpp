#include "farm/leases.h"

#include <gtest/gtest.h>

#include <random>

namespace veduta {
namespace {

const WorkerId first{0, 0}, second{1, 0};

void bake_all(LeaseBook& book, const Lease& lease, double now_s) {
  for (uint32_t i = 0; i < lease.count; ++i) book.cell_done(lease.id, lease.begin + i, now_s);
  book.lease_done(lease.id);
}

TEST(Leases, ShrinkTowardsTheEndAndCoverEverything) {
  LeaseBook book(std::vector<bool>(1000, false), 2);
  uint32_t last = LeaseBook::largest_lease, at = 0;
  while (!book.complete()) {
    const auto lease = book.grant(first, 0);
    ASSERT_TRUE(lease);
    EXPECT_EQ(lease->begin, at) << "in order";
    EXPECT_LE(lease->count, last);
    at += lease->count, last = lease->count;
    bake_all(book, *lease, 0);
  }
  EXPECT_EQ(last, 1u);
  EXPECT_FALSE(book.grant(first, 0));
}

TEST(Leases, CellsThatAreDoneAreNotGivenOut) {
  std::vector<bool> done(20, true);
  done[3] = done[4] = done[11] = false;
  LeaseBook book(done, 1);
  uint32_t given = 0;
  while (const auto lease = book.grant(first, 0)) {
    for (uint32_t i = 0; i < lease->count; ++i) EXPECT_FALSE(done[lease->begin + i]);
    given += lease->count;
    bake_all(book, *lease, 0);
  }
  EXPECT_EQ(given, 3u);
  EXPECT_TRUE(book.complete());
}

TEST(Leases, UnfinishedCellsOfALostLeaseComeBack) {
  LeaseBook book(std::vector<bool>(4, false), 1);
  const auto lease = book.grant(first, 0);
  ASSERT_TRUE(lease);
  EXPECT_FALSE(book.lease_lost(lease->id, true));
  std::vector<bool> seen(4, false);
  while (const auto again = book.grant(second, 0)) {
    for (uint32_t i = 0; i < again->count; ++i) seen[again->begin + i] = true;
    bake_all(book, *again, 0);
  }
  EXPECT_EQ(seen, std::vector<bool>(4, true));
}

/// Gives leases until `poison` has been condemned; a worker dies when it comes to that cell.
uint32_t deaths_until_condemned(LeaseBook& book, uint32_t poison) {
  uint32_t deaths = 0;
  while (const auto lease = book.grant(first, 0)) {
    bool died = false;
    for (uint32_t i = 0; i < lease->count && !died; ++i) {
      died = lease->begin + i == poison;
      if (!died) book.cell_done(lease->id, lease->begin + i, 0);
    }
    if (!died) {
      book.lease_done(lease->id);
      continue;
    }
    ++deaths;
    if (const auto condemned = book.lease_lost(lease->id, true)) {
      EXPECT_EQ(*condemned, poison);
      book.cell_done(0, *condemned, 0);
    }
  }
  return deaths;
}

TEST(Leases, PoisonCellIsCondemnedAfterThreeDeathsAloneAndNothingElseIsLost) {
  LeaseBook book(std::vector<bool>(300, false), 1);
  const uint32_t deaths = deaths_until_condemned(book, 17);
  EXPECT_TRUE(book.complete());
  EXPECT_GE(deaths, 3u);
  EXPECT_LE(deaths, 6u);
}

// The last cell: its worker is silent, so another one takes it too, and both are killed in the end.
TEST(Leases, DeathsOfTwoWorkersOverOneCellAreBothCounted) {
  LeaseBook book(std::vector<bool>(1, false), 2);
  const auto one = book.grant(first, 0), two = book.grant(second, 10);
  ASSERT_TRUE(one && two);
  EXPECT_FALSE(book.lease_lost(one->id, true));
  EXPECT_FALSE(book.grant(first, 1000)) << "it is in hands, and has killed";
  EXPECT_FALSE(book.lease_lost(two->id, true));
  const auto three = book.grant(first, 1000);
  ASSERT_TRUE(three);
  EXPECT_FALSE(book.grant(second, 2000)) << "nobody else goes the same way";
  EXPECT_EQ(book.lease_lost(three->id, true), 0u);
}

TEST(Leases, DeathsThatAreNotTheCellsFaultDoNotCount) {
  LeaseBook book(std::vector<bool>(1, false), 1);
  for (int i = 0; i < 10; ++i) EXPECT_FALSE(book.lease_lost(book.grant(first, 0)->id, false));
  EXPECT_FALSE(book.lease_lost(book.grant(first, 0)->id, true));
  EXPECT_FALSE(book.lease_lost(book.grant(first, 0)->id, true));
  EXPECT_TRUE(book.lease_lost(book.grant(first, 0)->id, true));
}

TEST(Leases, IdleWorkerTakesHalfOfWhatASlowOneHasLeftAndFirstAnswerCounts) {
  std::vector<bool> done(64 * 4, false);
  LeaseBook book(done, 1);
  const auto slow = book.grant(first, 0);
  ASSERT_EQ(slow->count, 64u);
  while (book.done_count() < 64 * 3) bake_all(book, *book.grant(second, 1), 1);
  const auto stolen = book.grant(second, 1);
  ASSERT_TRUE(stolen);
  EXPECT_EQ(stolen->begin, slow->begin + 32);
  EXPECT_EQ(stolen->count, 32u);
  bake_all(book, *stolen, 2);
  EXPECT_FALSE(book.cell_done(slow->id, stolen->begin, 3)) << "the second answer";
  for (uint32_t i = 0; i < 32; ++i) EXPECT_TRUE(book.cell_done(slow->id, slow->begin + i, 3));
  EXPECT_TRUE(book.complete());
}

TEST(Leases, LeaseThatNeverReachedItsWorkerGoesBackWhenTheWorkerAsksAgain) {
  LeaseBook book(std::vector<bool>(9, false), 1);
  for (int lost = 0; lost < 5; ++lost) {
    const auto lease = book.grant(first, 0);
    ASSERT_TRUE(lease);
    book.cell_done(lease->id, lease->begin, 0);
  }
  while (const auto lease = book.grant(first, 0)) bake_all(book, *lease, 0);
  EXPECT_TRUE(book.complete());
}

TEST(Leases, HungWorkerDoesNotStopTheBake) {
  LeaseBook book(std::vector<bool>(50, false), 2);
  ASSERT_TRUE(book.grant(first, 0));  // and never heard of again
  double now_s = 0;
  for (int turns = 0; !book.complete() && turns < 1000; ++turns, now_s += 1)
    if (const auto lease = book.grant(second, now_s)) bake_all(book, *lease, now_s);
  EXPECT_TRUE(book.complete());
}

TEST(Leases, RandomDeathsAlwaysEndComplete) {
  for (uint32_t seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    LeaseBook book(std::vector<bool>(120, false), 3);
    std::vector<std::pair<WorkerId, std::optional<Lease>>> workers;
    for (int i = 0; i < 3; ++i) workers.push_back({{i, 0}, std::nullopt});
    double now_s = 0;
    int turns = 0;
    for (; !book.complete() && turns < 20000; ++turns, now_s += 0.1) {
      auto& [worker, lease] = workers[random() % 3];
      if (!lease) {
        lease = book.grant(worker, now_s);
      } else if (random() % 5 == 0) {
        if (const auto condemned = book.lease_lost(lease->id, true)) book.cell_done(0, *condemned, now_s);
        lease.reset();
      } else {
        book.cell_done(lease->id, lease->begin, now_s);
        if (++lease->begin, --lease->count == 0) book.lease_done(lease->id), lease.reset();
      }
    }
    EXPECT_TRUE(book.complete()) << "seed " << seed << ", " << book.done_count() << " of "
                                 << book.cell_count();
  }
}

}  // namespace
}  // namespace veduta
