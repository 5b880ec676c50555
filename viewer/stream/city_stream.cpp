// The thread that draws: what it asks and takes.
#include "viewer/stream/city_stream.h"

#include "viewer/stream/city_stream_shared.h"

namespace veduta {

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
