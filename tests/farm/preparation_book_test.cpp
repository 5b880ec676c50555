#include "farm/preparation_book.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "scene/error.h"

namespace veduta {
namespace {

const WorkerId first{0, 0}, second{1, 0};

/// A book whose import is done.
PreparationBook imported(uint32_t tiles, uint32_t blocks) {
  PreparationBook book;
  EXPECT_EQ(book.grant(first), (PreparationPart{Stage::import, 0}));
  book.set_size(tiles, blocks);
  book.done(first);
  return book;
}

TEST(PreparationBook, StagesFollowEachOther) {
  PreparationBook book = imported(2, 1);
  std::vector<PreparationPart> parts;
  while (const auto part = book.grant(second)) parts.push_back(*part), book.done(second);
  EXPECT_EQ(parts, (std::vector<PreparationPart>{{Stage::flood, 0},
                                                 {Stage::flood, 1},
                                                 {Stage::cells, 0},
                                                 {Stage::cells, 1},
                                                 {Stage::shrink, 0},
                                                 {Stage::finish, 0}}));
  EXPECT_TRUE(book.complete());
}

TEST(PreparationBook, StageWaitsForThePartsInHands) {
  PreparationBook book = imported(2, 1);
  ASSERT_TRUE(book.grant(first));
  EXPECT_FALSE(book.grant(first)) << "it holds a part";
  ASSERT_TRUE(book.grant(second));
  book.done(first);
  EXPECT_FALSE(book.grant(first)) << "the other tile may still let air in";
  EXPECT_EQ(book.outstanding(), 1u);
  book.done(second);
  EXPECT_EQ(book.grant(first), (PreparationPart{Stage::cells, 0}));
}

TEST(PreparationBook, StagesWithoutPartsArePassedOver) {
  PreparationBook book = imported(0, 0);
  EXPECT_EQ(book.grant(first), (PreparationPart{Stage::finish, 0}));
}

TEST(PreparationBook, TileInHandsIsFloodedAgainAfterwards) {
  PreparationBook book = imported(2, 0);
  ASSERT_EQ(book.grant(first)->part, 0u);
  ASSERT_EQ(book.grant(second)->part, 1u);
  book.done(second, {0, 0});
  EXPECT_FALSE(book.grant(second)) << "tile 0 is in hands";
  EXPECT_EQ(book.outstanding(), 2u);
  book.done(first);
  EXPECT_EQ(book.grant(second), (PreparationPart{Stage::flood, 0}));
  book.done(second);
  EXPECT_EQ(book.stage(), Stage::cells);
}

TEST(PreparationBook, ThirdDeathInARowCondemns) {
  PreparationBook book = imported(1, 1);
  const auto die = [&](bool counts) {
    EXPECT_TRUE(book.grant(first));
    return book.lost(first, counts);
  };
  EXPECT_FALSE(book.lost(first, true)) << "it held nothing";
  EXPECT_FALSE(die(true));
  EXPECT_FALSE(die(true));
  EXPECT_FALSE(die(false)) << "it had not begun";
  ASSERT_TRUE(book.grant(first));
  book.done(first, {0});  // alive after all
  EXPECT_FALSE(die(true));
  EXPECT_FALSE(die(true));
  EXPECT_EQ(die(true), (PreparationPart{Stage::flood, 0}));
}

TEST(PreparationBook, ContinuesWithWhatIsLeftOfAStage) {
  PreparationBook book = imported(3, 2);
  for (int tile = 0; tile < 2; ++tile) {
    ASSERT_TRUE(book.grant(first));
    book.done(first);
  }
  EXPECT_TRUE(book.state().done.empty()) << "a flood is done when all of it is";
  ASSERT_TRUE(book.grant(first));
  book.done(first);
  ASSERT_EQ(book.grant(first), (PreparationPart{Stage::cells, 0}));
  ASSERT_EQ(book.grant(second), (PreparationPart{Stage::cells, 1}));
  book.done(second);
  PreparationBook continued(book.state());
  EXPECT_EQ(continued.grant(second), (PreparationPart{Stage::cells, 0}));
  EXPECT_EQ(continued.grant(first), (PreparationPart{Stage::cells, 2}));
  continued.done(first);
  continued.done(second);
  EXPECT_EQ(PreparationBook(continued.state()).grant(first), (PreparationPart{Stage::shrink, 0}));
}

TEST(PreparationBook, AnswersThatMakeNoSenseAreDefects) {
  PreparationBook book = imported(2, 1);
  EXPECT_THROW(book.done(first), Error) << "it was asked for nothing";
  ASSERT_TRUE(book.grant(first));
  EXPECT_THROW(book.done(first, {2}), Error) << "there is no such tile";
  ASSERT_TRUE(book.grant(second));
  book.done(second);
  ASSERT_EQ(book.stage(), Stage::cells);
  ASSERT_TRUE(book.grant(second));
  EXPECT_THROW(book.done(second, {0}), Error) << "the flood is over";
}

/// A square of tiles with walls between some of them, into which air comes at one tile. A flood takes the
/// neighbours' air as it is when the flood begins and writes its own when it ends, as processes on one file
/// system do.
class Floods {
 public:
  static constexpr uint32_t side = 5, tiles = side * side;
  explicit Floods(std::mt19937& random) : open_(tiles * tiles, false), air_(tiles, false) {
    source_ = static_cast<uint32_t>(random() % tiles);
    for (uint32_t a = 0; a < tiles; ++a)
      for (uint32_t b = 0; b < a; ++b)
        if (beside(a, b) && random() % 3 != 0) open_[a * tiles + b] = open_[b * tiles + a] = true;
  }
  bool begin(uint32_t tile) const {
    if (air_[tile] || tile == source_) return true;
    for (uint32_t other = 0; other < tiles; ++other)
      if (open_[tile * tiles + other] && air_[other]) return true;
    return false;
  }
  /// Names those that have not taken what there is to take now: also after a death, of which they were not
  /// told.
  std::vector<uint32_t> end(uint32_t tile, bool air) {
    std::vector<uint32_t> again;
    air_[tile] = air;
    for (uint32_t other = 0; other < tiles; ++other)
      if (air && open_[tile * tiles + other] && !air_[other]) again.push_back(other);
    return again;
  }
  bool settled() const {
    for (uint32_t tile = 0; tile < tiles; ++tile)
      if (begin(tile) != air_[tile]) return false;
    return true;
  }

 private:
  static bool beside(uint32_t a, uint32_t b) {
    const auto distance = [](uint32_t p, uint32_t q) { return p > q ? p - q : q - p; };
    return std::max(distance(a / side, b / side), distance(a % side, b % side)) == 1;
  }
  std::vector<bool> open_, air_;
  uint32_t source_ = 0;
};

// Any schedule, with stops, and deaths before a part began, in its middle, and after its files were written.
TEST(PreparationBook, RandomSchedulesAndDeathsEndInTheSettledFlood) {
  constexpr uint32_t blocks = 7, workers = 4;
  uint64_t repeats = 0;
  for (uint32_t seed = 0; seed < 300; ++seed) {
    std::mt19937 random(seed);
    Floods floods(random);
    PreparationBook book;
    struct Hand {
      std::optional<PreparationPart> part;
      bool air = false;
    };
    std::vector<Hand> hands(workers);
    std::set<PreparationPart> in_hands, finished;
    std::vector<int> deaths(100, 0);  // in a row, of the stage's parts: never a third
    Stage last = Stage::import;
    int turns = 0;
    for (; !book.complete() && turns < 20000; ++turns) {
      if (random() % 100 == 0) {  // all stop at once, and go on with what is known to be done
        for (Hand& hand : hands) {
          if (hand.part && hand.part->stage == Stage::flood && random() % 2 == 0)
            floods.end(hand.part->part, hand.air);
          hand.part.reset();
        }
        in_hands.clear();
        std::fill(deaths.begin(), deaths.end(), 0);
        book = PreparationBook(book.state());
        continue;
      }
      const auto number = static_cast<uint32_t>(random() % workers);
      const WorkerId worker{static_cast<int>(number), 0};
      Hand& hand = hands[number];
      if (!hand.part) {
        hand.part = book.grant(worker);
        if (!hand.part) continue;
        const auto [stage, part] = *hand.part;
        ASSERT_TRUE(in_hands.insert({stage, part}).second) << "in two hands";
        ASSERT_GE(stage, last) << "stages in order";
        if (stage != last) std::fill(deaths.begin(), deaths.end(), 0);
        last = stage;
        ASSERT_TRUE(stage <= Stage::flood || floods.settled()) << "seed " << seed;
        if (stage == Stage::flood) hand.air = floods.begin(part);
        continue;
      }
      const auto [stage, part] = *hand.part;
      in_hands.erase({stage, part});
      hand.part.reset();
      const bool begun = random() % 8 != 0;
      if (random() % 4 == 0 && (!begun || deaths[part] < 2)) {
        if (begun && stage == Stage::flood && random() % 2 == 0) floods.end(part, hand.air);
        if (begun) ++deaths[part];
        ASSERT_FALSE(book.lost(worker, begun));
        continue;
      }
      deaths[part] = 0;
      if (stage == Stage::import) book.set_size(Floods::tiles, blocks);
      repeats += !finished.insert({stage, part}).second;
      book.done(worker, stage == Stage::flood ? floods.end(part, hand.air) : std::vector<uint32_t>());
    }
    EXPECT_TRUE(book.complete()) << "seed " << seed;
    EXPECT_TRUE(floods.settled()) << "seed " << seed;
    EXPECT_EQ(finished.size(), 1 + 2 * Floods::tiles + blocks + 1) << "seed " << seed;
  }
  EXPECT_GT(repeats, 1000u) << "floods were done again";
}

}  // namespace
}  // namespace veduta
