// A scene of the campaign: what is in it and how it is baked, as a value.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/campaign/solids.h"
#include "worker/settings.h"

namespace veduta::campaign {

struct CampaignScene {
  uint64_t number = 0;   ///< that it was generated from
  glm::dvec2 origin{0};  ///< m; added to x and y of all that is below
  std::vector<Thing> things;
  glm::dvec2 lower{-1}, upper{1};  ///< of the region in which cells are made
  Settings settings;               ///< without model and region

  /// With region, and with the model that write_scene writes.
  Settings resolved(const std::filesystem::path& folder) const;
};

/// Writes scene.obj and bake.toml, with which `veduta bake` makes the same bake.
void write_scene(const CampaignScene& scene, const std::filesystem::path& folder);

}  // namespace veduta::campaign
