#include "viewer/city_pages.h"

#include <limits>

namespace veduta {

CityPages::CityPages(CityStream& stream, int samples, bool allow_one_pass)
    : stream_(stream),
      painter_(stream.index(), stream.memory_bytes(), samples, allow_one_pass),
      lister_(stream.index(), stream.pages()) {}

void CityPages::look(const Gaze& gaze, uint64_t most_bytes) {
  stream_.look(gaze);
  take_changes(most_bytes);
}

void CityPages::fetch(const Gaze& gaze) {
  stream_.look(gaze);
  stream_.wait();
  while (take_changes(std::numeric_limits<uint64_t>::max())) stream_.wait();
}

bool CityPages::take_changes(uint64_t most_bytes) {
  PageChanges changes = stream_.changes(most_bytes);
  for (const uint32_t page : changes.gone) painter_.remove(page), lister_.remove(page);
  for (const std::unique_ptr<Page>& page : changes.came) {
    if (const auto place = painter_.add(*page))
      lister_.add(page->number, *place, std::move(page->ranges));
    else
      stream_.refuse(page->number);
  }
  return !changes.came.empty() || !changes.gone.empty();
}

}  // namespace veduta
