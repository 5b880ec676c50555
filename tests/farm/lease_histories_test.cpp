// Random histories of a farm: workers that answer, in order or not, late or never, die and come back.
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "farm/leases.h"
#include "tests/farm/lease_reference.h"

namespace veduta {
namespace {

using test::LeaseReference;

/// Both books, told the same: whatever they answer must be the same.
class BothBooks {
 public:
  BothBooks(const std::vector<bool>& done, uint32_t workers) : fast_(done, workers), slow_(done, workers) {}

  std::optional<Lease> grant(WorkerId worker, double now_s) {
    const auto lease = fast_.grant(worker, now_s), expected = slow_.grant(worker, now_s);
    EXPECT_EQ(lease.has_value(), expected.has_value());
    if (lease && expected) {
      EXPECT_EQ(lease->id, expected->id);
      EXPECT_EQ(lease->begin, expected->begin);
      EXPECT_EQ(lease->count, expected->count);
    }
    return lease;
  }
  bool cell_done(uint64_t lease, uint32_t cell, double now_s) {
    const bool first = fast_.cell_done(lease, cell, now_s);
    EXPECT_EQ(first, slow_.cell_done(lease, cell, now_s));
    return first;
  }
  void lease_done(uint64_t lease) { fast_.lease_done(lease), slow_.lease_done(lease); }
  std::optional<uint32_t> lease_lost(uint64_t lease, bool counts) {
    const auto condemned = fast_.lease_lost(lease, counts);
    EXPECT_EQ(condemned, slow_.lease_lost(lease, counts));
    return condemned;
  }
  void take_back(WorkerId worker) { fast_.take_back(worker), slow_.take_back(worker); }
  bool complete() const {
    EXPECT_EQ(fast_.complete(), slow_.complete());
    return fast_.complete();
  }

 private:
  LeaseBook fast_;
  LeaseReference slow_;
};

/// What kind of a farm it is.
struct Temper {
  double dies = 0, hangs = 0, disorderly = 0, late = 0, forgetful = 0, strange = 0;
};

class History {
 public:
  History(uint32_t seed, const Temper& temper)
      : random_(seed), temper_(temper), cells_(1 + random_() % 400), workers_(1 + random_() % 12) {
    std::vector<bool> done(cells_, false);
    if (seed % 3 == 0)
      for (uint32_t cell = 0; cell < cells_; ++cell) done[cell] = random_() % 4 == 0;
    answered_.assign(done.begin(), done.end());
    books_.emplace(done, static_cast<uint32_t>(workers_.size()));
  }

  /// Until everything is done. \return turns; 0: it never was.
  int run() {
    for (int turn = 1; turn < 100000; ++turn, now_s_ += chance(0.1) ? 2 : 0.01) {
      if (books_->complete()) return turn;
      act(static_cast<int>(random_() % workers_.size()));
      if (testing::Test::HasFailure()) return turn;
    }
    return 0;
  }
  uint32_t duplicates() const { return duplicates_; }
  uint32_t deaths() const { return deaths_; }
  const std::vector<int>& answered() const { return answered_; }

 private:
  struct Held {
    uint64_t id = 0;
    std::vector<uint32_t> left;
    bool hung = false;
  };
  bool chance(double p) { return std::uniform_real_distribution<>()(random_) < p; }

  void answer(uint64_t lease, uint32_t cell) {
    if (books_->cell_done(lease, cell, now_s_))
      ++answered_[cell];
    else
      ++duplicates_;
  }
  void lost(std::optional<Held>& held, bool counts) {
    ++deaths_;
    if (const auto condemned = books_->lease_lost(held->id, counts)) answer(0, *condemned);
    if (chance(temper_.late)) late_.push_back(*held);  // its answers were still on their way
    held.reset();
  }
  void act(int number) {
    std::optional<Held>& held = workers_[static_cast<size_t>(number)];
    const WorkerId worker{number / 3, number % 3};
    if (chance(temper_.strange)) answer(0, random_() % cells_);  // nobody was asked
    if (!late_.empty() && chance(0.1)) {
      Held& old = late_.back();
      answer(old.id, old.left.back());
      old.left.pop_back();
      if (old.left.empty()) late_.pop_back();
    }
    if (!held) return take(held, worker);
    if (held->hung) {
      if (chance(0.02)) lost(held, true);
      return;
    }
    if (chance(temper_.hangs)) held->hung = true;
    if (chance(temper_.dies)) return lost(held, chance(0.7));
    const size_t which = chance(temper_.disorderly) ? random_() % held->left.size() : 0;
    answer(held->id, held->left[which]);
    held->left.erase(held->left.begin() + static_cast<long>(which));
    if (!held->left.empty() && !chance(temper_.forgetful)) return;
    books_->lease_done(held->id);
    held.reset();
  }
  void take(std::optional<Held>& held, WorkerId worker) {
    const auto lease = books_->grant(worker, now_s_);
    if (!lease) return;
    if (chance(temper_.forgetful)) {  // the grant is lost on its way
      if (chance(0.5)) books_->take_back(worker);
      return;
    }
    held.emplace();
    held->id = lease->id;
    for (uint32_t i = 0; i < lease->count; ++i) held->left.push_back(lease->begin + i);
  }

  std::mt19937 random_;
  Temper temper_;
  uint32_t cells_;
  std::vector<std::optional<Held>> workers_;
  std::vector<Held> late_;
  std::optional<BothBooks> books_;
  std::vector<int> answered_;
  uint32_t duplicates_ = 0, deaths_ = 0;
  double now_s_ = 0;
};

/// Every cell is answered first exactly once, whatever happens, and as the slow book says.
void expect_same_and_complete(const Temper& temper) {
  for (uint32_t seed = 0; seed < 600; ++seed) {
    History history(seed, temper);
    EXPECT_GT(history.run(), 0) << "seed " << seed << ": never complete";
    for (const int times : history.answered()) EXPECT_EQ(times, 1) << "seed " << seed;
    if (testing::Test::HasFailure()) return;
  }
}

TEST(LeaseHistories, OrderlyWorkers) {
  expect_same_and_complete({});
}
TEST(LeaseHistories, WorkersThatDie) {
  expect_same_and_complete({.dies = 0.2});
}
TEST(LeaseHistories, WorkersThatHangUntilTheyAreKilled) {
  expect_same_and_complete({.hangs = 0.05});
}
TEST(LeaseHistories, AnswersOutOfOrderAndLate) {
  expect_same_and_complete({.dies = 0.05, .disorderly = 0.5, .late = 0.7, .strange = 0.01});
}
TEST(LeaseHistories, EverythingAtOnce) {
  expect_same_and_complete(
      {.dies = 0.05, .hangs = 0.03, .disorderly = 0.2, .late = 0.4, .forgetful = 0.05, .strange = 0.01});
}

/// A cell is in two hands at most, so without deaths it is baked at most twice.
TEST(LeaseHistories, NobodyDiesSoNoCellIsBakedMoreThanTwice) {
  for (uint32_t seed = 0; seed < 600; ++seed) {
    History history(seed, {.disorderly = 0.1});
    ASSERT_GT(history.run(), 0);
    EXPECT_LE(history.duplicates(), history.answered().size()) << "seed " << seed;
  }
}

}  // namespace
}  // namespace veduta
