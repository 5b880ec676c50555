// The thread that reads.
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <optional>

#include "viewer/stream/city_stream_shared.h"

namespace veduta {
namespace {

constexpr int nicer = 5;  ///< software GL draws on all cores: reading ahead must not take a frame's time

void give_way_to_drawing() {
  // Linux keeps a priority for each thread. Where this fails, frames are a little less even.
  const auto thread = static_cast<id_t>(::gettid());
  ::setpriority(PRIO_PROCESS, thread, ::getpriority(PRIO_PROCESS, thread) + nicer);
}

}  // namespace

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

}  // namespace veduta
