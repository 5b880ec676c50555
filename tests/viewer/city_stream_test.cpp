#include "viewer/stream/city_stream.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <future>
#include <mutex>
#include <set>
#include <thread>

#include "scene/error.h"
#include "tests/viewer/memory_source.h"

namespace veduta {
namespace {

using toy::MemorySource;

/// What the drawing thread does with a stream, without GL: it keeps the numbers of what it put up.
class Viewer {
 public:
  explicit Viewer(CityStream& from) : stream(from) {}
  void take(uint64_t most_bytes = UINT64_MAX) {
    const PageChanges changes = stream.changes(most_bytes);
    for (uint32_t page : changes.gone) EXPECT_EQ(here.erase(page), 1u) << page;
    for (const auto& page : changes.came) {
      EXPECT_TRUE(here.insert(page->number).second) << page->number;
      EXPECT_EQ(page->triangles, stream.pages()[page->number].triangles);
      bytes[page->number] = page->gpu_bytes();
    }
  }
  uint64_t gpu_bytes() const {
    uint64_t sum = 0;
    for (uint32_t page : here) sum += bytes.at(page);
    return sum;
  }

  CityStream& stream;
  std::set<uint32_t> here;
  std::unordered_map<uint32_t, uint64_t> bytes;
};

constexpr uint64_t page_bytes = 110'000;  ///< a house of the street takes less

TEST(CityStream, WalkingThroughACityLargerThanTheBudget) {
  const uint64_t budget = 9 * page_bytes;
  CityStream stream(std::make_unique<MemorySource>(toy::long_street(60)), budget);
  EXPECT_FALSE(stream.fits());
  Viewer viewer(stream);
  for (uint32_t cell = 3; cell < 57; ++cell) {
    stream.look(toy::standing_in(cell));
    stream.wait();
    viewer.take();
    const PvsRow* row = stream.row(cell);
    ASSERT_TRUE(row);
    ASSERT_EQ(row->size(), 6u);
    for (const PvsEntry& entry : *row)
      EXPECT_TRUE(viewer.here.count(entry.object)) << entry.object << " from cell " << cell;
    EXPECT_LE(viewer.gpu_bytes(), budget);
    EXPECT_LE(stream.status().bytes_here, budget);
    EXPECT_EQ(stream.status().pages_wanted, 6u);
    EXPECT_EQ(stream.status().pages_missing, 0u);
  }
}

TEST(CityStream, WhatFitsComesWhole) {
  CityStream stream(std::make_unique<MemorySource>(toy::long_street(20)), 100 * page_bytes);
  EXPECT_TRUE(stream.fits());
  Viewer viewer(stream);
  Gaze gaze = toy::standing_in(10);
  gaze.everything = true;
  stream.look(gaze);
  stream.wait();
  viewer.take();
  EXPECT_EQ(viewer.here.size(), 20u);
}

TEST(CityStream, ChangesComeInPortions) {
  CityStream stream(std::make_unique<MemorySource>(toy::long_street(20)), 100 * page_bytes);
  Gaze gaze = toy::standing_in(10);
  gaze.everything = true;
  stream.look(gaze);
  stream.wait();
  EXPECT_EQ(stream.changes(1).came.size(), 1u);  // one at least
  EXPECT_EQ(stream.changes(2 * page_bytes).came.size(), 2u);
  EXPECT_EQ(stream.changes(UINT64_MAX).came.size(), 17u);
  EXPECT_TRUE(stream.changes(UINT64_MAX).came.empty());
}

TEST(CityStream, WhatIsAheadComesWithoutWaiting) {
  CityStream stream(std::make_unique<MemorySource>(toy::long_street(60)), 20 * page_bytes);
  Gaze gaze = toy::standing_in(20);
  gaze.velocity_m_s = {10, 0, 0};
  do {
    stream.look(gaze);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  } while (!stream.row(22));  // nothing else asks for it
  SUCCEED();
}

TEST(CityStream, APageThatWasRefusedComesAgain) {
  CityStream stream(std::make_unique<MemorySource>(toy::long_street(60)), 9 * page_bytes);
  Viewer viewer(stream);
  for (uint32_t cell : {20u, 40u}) {
    stream.look(toy::standing_in(cell));
    stream.wait();
    viewer.take();
  }
  viewer.here.erase(40);
  stream.refuse(40);
  stream.wait();
  viewer.take();
  EXPECT_TRUE(viewer.here.count(40));
  EXPECT_EQ(stream.status().pages_missing, 0u);
}

/// A source whose reads of pages stand still until they are let go.
struct Gate {
  std::mutex lock;
  std::condition_variable changed;
  bool open = false;
  int begun = 0;

  void pass() {
    std::unique_lock hold(lock);
    ++begun;
    changed.notify_all();
    changed.wait(hold, [&] { return open; });
  }
  void wait_until_begun() {
    std::unique_lock hold(lock);
    changed.wait(hold, [&] { return begun > 0; });
  }
  void let_go() {
    const std::lock_guard hold(lock);
    open = true;
    changed.notify_all();
  }
  void close() {
    const std::lock_guard hold(lock);
    open = false;
    begun = 0;
  }
};

class GatedSource : public MemorySource {
 public:
  GatedSource(PvsFile file, Gate& gate) : MemorySource(std::move(file)), gate_(gate) {}
  City read_objects(uint32_t first, uint32_t last) const override {
    gate_.pass();
    return MemorySource::read_objects(first, last);
  }

 private:
  Gate& gate_;
};

TEST(CityStream, AReadThatTakesForEverHoldsNobodyUp) {
  Gate gate;
  CityStream stream(std::make_unique<GatedSource>(toy::long_street(60), gate), 20 * page_bytes);
  stream.look(toy::standing_in(10));
  gate.wait_until_begun();
  // Were one of these to wait for the disk, the test would stand still.
  for (uint32_t i = 0; i < 1000; ++i) {
    stream.look(toy::standing_in(10 + i % 40));
    EXPECT_TRUE(stream.changes(UINT64_MAX).came.empty());
    stream.refuse(10);
    (void)stream.status();
    EXPECT_TRUE(stream.row(10));  // it came before the first page
  }
  gate.let_go();
  stream.look(toy::standing_in(30));
  stream.wait();
  EXPECT_TRUE(stream.row(30));
  EXPECT_EQ(stream.status().pages_missing, 0u);
}

TEST(CityStream, WhatWasRefusedIsNotTakenDownForWhatComesAtThatMoment) {
  Gate gate;
  gate.let_go();
  CityStream stream(std::make_unique<GatedSource>(toy::long_street(60), gate), 9 * page_bytes);
  Viewer viewer(stream);
  for (uint32_t cell : {10u, 13u, 16u}) {  // until the budget is full
    stream.look(toy::standing_in(cell));
    stream.wait();
    viewer.take();
  }
  gate.close();
  stream.look(toy::standing_in(40));
  gate.wait_until_begun();
  viewer.take();
  for (uint32_t page : viewer.here) stream.refuse(page);
  viewer.here.clear();
  gate.let_go();
  stream.wait();
  viewer.take();  // checks that what goes was here
  for (uint32_t page = 38; page <= 42; ++page) EXPECT_TRUE(viewer.here.count(page)) << page;
}

TEST(CityStream, EndsInTheMiddleOfARead) {
  Gate gate;
  auto stream = std::make_unique<CityStream>(std::make_unique<GatedSource>(toy::long_street(60), gate),
                                             20 * page_bytes);
  stream->look(toy::standing_in(10));
  gate.wait_until_begun();
  std::thread ends([&] { stream.reset(); });
  gate.let_go();
  ends.join();
}

TEST(CityStream, EndsBeforeAnythingWasAsked) {
  const CityStream stream(std::make_unique<MemorySource>(toy::long_street(3)), page_bytes);
  EXPECT_EQ(stream.status().pages_here, 0u);
}

class DamagedSource : public MemorySource {
 public:
  using MemorySource::MemorySource;
  City read_objects(uint32_t first, uint32_t last) const override {
    if (first <= 13 && 13 < last) throw Error(ExitStatus::bad_input, "street.h5: /scene/triangles: damaged");
    return MemorySource::read_objects(first, last);
  }
};

TEST(CityStream, DamageIsToldByTheNextLook) {
  CityStream stream(std::make_unique<DamagedSource>(toy::long_street(60)), 8 * page_bytes);
  stream.look(toy::standing_in(5));
  stream.wait();
  const auto expect_error = [](const std::function<void()>& action) {
    try {
      action();
      FAIL() << "nothing was thrown";
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::bad_input);
      EXPECT_STREQ(error.what(), "street.h5: /scene/triangles: damaged");
    }
  };
  stream.look(toy::standing_in(13));
  expect_error([&] { stream.wait(); });
  expect_error([&] { stream.look(toy::standing_in(13)); });
  expect_error([&] { stream.look(toy::standing_in(5)); });
  EXPECT_FALSE(stream.row(13) && stream.row(13)->empty());
}

TEST(CityStream, AFileThatIsNotThere) {
  try {
    const CityStream stream("/nowhere/city.pvs.h5", 1 << 20);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::bad_input);
    EXPECT_NE(std::string(error.what()).find("/nowhere/city.pvs.h5"), std::string::npos);
  }
}

}  // namespace
}  // namespace veduta
