// From plans and rules to buildings (thesis A.2).
#pragma once

#include <functional>
#include <vector>

#include "scene/city/city_model.h"
#include "scene/city/city_plan.h"
#include "scene/city/rules.h"

namespace veduta::city {

/// Derives one building: a facade for each edge of its outline, a roof, and the ground below, so that the
/// mesh is closed edge by edge (close_edges.h) and counter-clockwise seen from outside. Layers are of
/// `rules`. The same plan and rules give the same mesh. \throw Error(bad_input) when a rule never ends, or a
/// plan has no outline with area
Mesh derive_building(const BuildingPlan& plan, const RuleSet& rules);

/// Derives every building of a plan, on all cores; any number of them gives the same model. Layers that
/// styles have in common are one. \pre BuildingPlan::style < styles.size()
/// \param progress is called now and then, from one thread at a time \throw Error as derive_building does
CityModel build_city(const CityPlan& plan, const std::vector<RuleSet>& styles,
                     const std::function<void(uint64_t done, uint64_t total)>& progress = {});

}  // namespace veduta::city
