// Small cities that are sensitive to one kind of error each.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/worker/occlusion_city.h"

namespace veduta::mutation {

struct Place {
  std::string name;
  std::function<void(test::OcclusionCity&)> build;
  std::string method = "panorama";
  uint64_t rays_per_cell = 300'000;
};

/// \throw Error(usage) when there is none of this name.
Place place(const std::string& name);

/// Of all places, in a fixed order.
std::vector<std::string> place_names();

}  // namespace veduta::mutation
