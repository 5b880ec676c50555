// From a scene that fails to the least that fails in the same way: delta debugging (Zeller & Hildebrandt
// 2002) over objects and their pieces, then simpler numbers and settings.
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "tests/campaign/check_scene.h"

namespace veduta::campaign {

/// Delta debugging: a part of `all` that still fails and of which no single element can be left out. Takes
/// that `all` fails.
template <typename T, typename StillFails>
std::vector<T> fewest(std::vector<T> all, const StillFails& still_fails) {
  size_t size = (all.size() + 1) / 2;  // of what is left out at a time
  while (size > 0) {
    bool fewer = false;
    for (size_t first = 0; first < all.size();) {
      std::vector<T> rest = all;
      const size_t last = std::min(first + size, all.size());
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(first),
                 rest.begin() + static_cast<std::ptrdiff_t>(last));
      if (still_fails(rest))
        all = std::move(rest), fewer = true;
      else
        first = last;
    }
    if (!fewer || size > all.size()) size /= 2;
  }
  return all;
}

struct Minimal {
  CampaignScene scene;
  Outcome outcome;
  size_t checks = 0;
};

/// \param check  says what comes of a scene; called at most `most_checks` times, then it is left as it is.
Minimal minimise(const CampaignScene& scene, const Outcome& failure,
                 const std::function<Outcome(const CampaignScene&)>& check, size_t most_checks);

}  // namespace veduta::campaign
