// Small cities that are sensitive to one kind of error each.
#pragma once

#include <functional>
#include <string>

#include "tests/worker/occlusion_city.h"

namespace veduta::mutation {

struct Place {
  std::string name;
  std::function<void(test::OcclusionCity&)> build;
  std::string method = "panorama";
  uint64_t rays = 300'000;  ///< to verify with, shared by its cells
};

/// \throw Error(usage) when there is none of this name.
Place place(const std::string& name);

}  // namespace veduta::mutation
