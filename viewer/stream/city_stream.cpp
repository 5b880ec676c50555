// One thread owns source and residency. What it shares with the thread that draws is behind one lock, which
// either side holds only to move pointers: reading, planning and freeing happen outside it.
#include "viewer/stream/city_stream.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <unordered_map>
#include <utility>

#include "viewer/stream/residency.h"

namespace veduta {
namespace {

using RowPointer = std::unique_ptr<const PvsRow>;

constexpr int nicer = 5;  ///< software GL draws on all cores: reading ahead must not take a frame's time

void give_way_to_drawing() {
  // Linux keeps a priority for each thread. Where this fails, frames are a little less even.
  const auto thread = static_cast<id_t>(::gettid());
  ::setpriority(PRIO_PROCESS, thread, ::getpriority(PRIO_PROCESS, thread) + nicer);
}

}  // namespace

struct CityStream::Shared {
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

// The reading thread.

void CityStream::Shared::run() {
  give_way_to_drawing();
  try {
    serve();
  } catch (...) {
    const std::lock_guard hold(lock);
    error = std::current_exception();
    settled_some.notify_all();
  }
}

void CityStream::Shared::serve() {
  uint64_t seen = 0;
  bool idle = true;
  for (;;) {
    {
      std::unique_lock hold(lock);
      if (idle) asked_more.wait(hold, [&] { return stop || asked != seen; });
      if (stop) return;
    }
    seen = take_questions();
    const std::optional<Residency::Next> next = residency.next();
    publish({});
    if (!next || !next->now) {
      const std::lock_guard hold(lock);
      settled = seen;
      settled_some.notify_all();
    }
    idle = !next;
    if (next) read(next->item);
  }
}

uint64_t CityStream::Shared::take_questions() {
  std::vector<uint32_t> not_put_up;
  Gaze now;
  uint64_t seen = 0;
  {
    const std::lock_guard hold(lock);
    not_put_up.swap(refused);
    now = gaze;
    seen = asked;
  }
  residency.look(now);
  for (uint32_t page : not_put_up) {
    std::vector<StreamItem> going = residency.page_refused(page);
    // Another that was not put up is not to be taken down.
    std::erase_if(going, [&](const StreamItem& item) {
      return item.kind == StreamItem::Kind::page &&
             std::find(not_put_up.begin(), not_put_up.end(), item.number) != not_put_up.end();
    });
    publish(going);
  }
  return seen;
}

void CityStream::Shared::read(const StreamItem& item) {
  if (item.kind == StreamItem::Kind::row) {
    auto row = std::make_unique<const PvsRow>(source->read_row(item.number));
    const std::vector<StreamItem> going = residency.row_arrived(item.number, *row);
    publish(going, nullptr, {item.number, std::move(row)});
  } else {
    const PageSpan& span = pages[item.number];
    auto page = std::make_unique<Page>(
        make_page(source->read_objects(span.first_object, span.last_object), span.first_object, item.number));
    const Residency::Arrival arrival = residency.page_arrived(item.number, page->bytes());
    publish(arrival.gone, arrival.kept ? std::move(page) : nullptr);
  }
}

void CityStream::Shared::let_go(const std::vector<StreamItem>& items,
                                std::vector<std::unique_ptr<Page>>& trash) {
  for (const StreamItem& item : items) {
    if (item.kind == StreamItem::Kind::row) {
      row_changes.push_back({item.number, nullptr});
      continue;
    }
    const auto waiting =
        std::find_if(came.begin(), came.end(), [&](const auto& page) { return page->number == item.number; });
    if (waiting != came.end()) {  // nobody has seen it
      trash.push_back(std::move(*waiting));
      came.erase(waiting);
    } else if (std::erase(refused, item.number) == 0) {
      gone.push_back(item.number);
    }
  }
}

void CityStream::Shared::publish(const std::vector<StreamItem>& going, std::unique_ptr<Page> page,
                                 std::pair<uint32_t, RowPointer> row) {
  const Residency::Wanted wanted = residency.wanted_now();
  std::vector<std::unique_ptr<Page>> trash;  // freed when the lock is open again
  const std::lock_guard hold(lock);
  let_go(going, trash);
  if (page) came.push_back(std::move(page));
  if (row.second) row_changes.push_back(std::move(row));
  status = {residency.pages_here(), wanted.pages, wanted.missing, residency.bytes_here()};
}

// The drawing thread.

void CityStream::Shared::take_rows() {
  std::vector<std::pair<uint32_t, RowPointer>> changes;
  {
    const std::lock_guard hold(lock);
    changes.swap(row_changes);
  }
  for (auto& [number, row] : changes) {
    if (row)
      rows[number] = std::move(row);
    else
      rows.erase(number);
  }
}

CityStream::CityStream(const std::filesystem::path& file, uint64_t memory_bytes)
    : CityStream(open_source(file), memory_bytes) {}

CityStream::CityStream(std::unique_ptr<const CitySource> source, uint64_t memory_bytes)
    : shared_(std::make_unique<Shared>(std::move(source), memory_bytes)) {
  shared_->thread = std::thread(&Shared::run, shared_.get());
}

CityStream::~CityStream() {
  {
    const std::lock_guard hold(shared_->lock);
    shared_->stop = true;
  }
  shared_->asked_more.notify_all();
  shared_->thread.join();
}

const PvsIndex& CityStream::index() const {
  return shared_->source->index();
}
const std::vector<PageSpan>& CityStream::pages() const {
  return shared_->pages;
}
uint64_t CityStream::memory_bytes() const {
  return shared_->memory_bytes;
}
bool CityStream::fits() const {
  return shared_->fits;
}

void CityStream::look(const Gaze& gaze) {
  {
    const std::lock_guard hold(shared_->lock);
    shared_->rethrow();
    if (shared_->asked == 0 || gaze != shared_->gaze) {
      shared_->gaze = gaze;
      ++shared_->asked;
    }
  }
  shared_->asked_more.notify_one();
  shared_->take_rows();
}

const PvsRow* CityStream::row(uint32_t cell) const {
  const auto here = shared_->rows.find(index().cell_row[cell]);
  return here == shared_->rows.end() ? nullptr : here->second.get();
}

PageChanges CityStream::changes(uint64_t most_bytes) {
  PageChanges changes;
  const std::lock_guard hold(shared_->lock);
  changes.gone.swap(shared_->gone);
  uint64_t bytes = 0;
  std::deque<std::unique_ptr<Page>>& came = shared_->came;
  while (!came.empty()) {
    bytes += came.front()->gpu_bytes();
    if (!changes.came.empty() && bytes > most_bytes) break;
    changes.came.push_back(std::move(came.front()));
    came.pop_front();
  }
  return changes;
}

void CityStream::refuse(uint32_t page) {
  {
    const std::lock_guard hold(shared_->lock);
    if (std::erase(shared_->gone, page) > 0) return;  // it had to go anyway
    shared_->refused.push_back(page);
    ++shared_->asked;
  }
  shared_->asked_more.notify_one();
}

void CityStream::wait() {
  {
    std::unique_lock hold(shared_->lock);
    shared_->settled_some.wait(hold, [&] { return shared_->error || shared_->settled == shared_->asked; });
    shared_->rethrow();
  }
  shared_->take_rows();
}

CityStream::Status CityStream::status() const {
  const std::lock_guard hold(shared_->lock);
  return shared_->status;
}

}  // namespace veduta
