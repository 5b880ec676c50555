// What a stream's two threads share. One thread owns source and residency. What it shares with the thread
// that draws is behind one lock, which either side holds only to move pointers: reading, planning and freeing
// happen outside it.
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <unordered_map>
#include <utility>
#include <vector>

#include "viewer/stream/city_stream.h"
#include "viewer/stream/residency.h"

namespace veduta {

struct CityStream::Shared {
  using RowPointer = std::unique_ptr<const PvsRow>;

  Shared(std::unique_ptr<const CitySource> from, uint64_t memory)
      : source(std::move(from)),
        pages(make_pages(source->index())),
        memory_bytes(memory),
        residency(source->index(), pages, memory),
        fits(residency.fits()) {}

  const std::unique_ptr<const CitySource> source;
  const std::vector<PageSpan> pages;
  const uint64_t memory_bytes;
  Residency residency;  ///< the reading thread's own
  const bool fits;

  // The drawing thread's own.
  std::unordered_map<uint32_t, RowPointer> rows;

  // Behind the lock.
  std::mutex lock;
  std::condition_variable asked_more, settled_some;
  bool stop = false;
  Gaze gaze;
  std::vector<uint32_t> refused;
  uint64_t asked = 0;    ///< how often gaze and refused changed
  uint64_t settled = 0;  ///< of these, how many have all that a picture needs
  std::exception_ptr error;
  std::deque<std::unique_ptr<Page>> came;
  std::vector<uint32_t> gone;                                ///< pages that were handed out
  std::vector<std::pair<uint32_t, RowPointer>> row_changes;  ///< no pointer: it goes
  Status status;

  std::thread thread;  ///< last: it uses all of the above

  void run();
  void serve();
  uint64_t take_questions();
  void read(const StreamItem& item);
  void let_go(const std::vector<StreamItem>& items, std::vector<std::unique_ptr<Page>>& trash);
  void publish(const std::vector<StreamItem>& going, std::unique_ptr<Page> page = nullptr,
               std::pair<uint32_t, RowPointer> row = {});
  void rethrow() const {
    if (error) std::rethrow_exception(error);
  }
  void take_rows();
};

}  // namespace veduta
