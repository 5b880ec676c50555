// From a configuration to a city: the plan, then its buildings.
#pragma once

#include <functional>
#include <string>

#include "scene/city/city_model.h"
#include "scene/city/city_settings.h"

namespace veduta::city {

struct MadeCity {
  CityModel model;
  std::string plan_format;  ///< "GeoJSON"; empty: made up
  ImportReport report;      ///< of the plan: what was mended and left out
  FootprintCounts counts;   ///< of the plan
  double plan_s = 0, derive_s = 0;
};

/// Reads styles and plan, plans, and derives every building. The same settings and files give the same city.
/// \param progress is called now and then, from one thread at a time, with the buildings that are derived
/// \throw Error(bad_input) for a plan, a style or a terminal that cannot be used
MadeCity make_city(const CitySettings& settings,
                   const std::function<void(uint64_t done, uint64_t total)>& progress = {});

}  // namespace veduta::city
