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

/// Reads styles and plan, plans, and derives every building. \param stage is called with what is about to
/// happen: "deriving 6,144 buildings". The same settings and files give the same city.
/// \throw Error(bad_input) for a plan, a style or a terminal that cannot be used
MadeCity make_city(const CitySettings& settings, const std::function<void(const std::string&)>& stage);

}  // namespace veduta::city
