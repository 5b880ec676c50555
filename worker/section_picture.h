// A picture for people of what the preparation made: a plan and a section of seeds, octree, sealed space,
// cells and shrunk occluders (how to read it: docs/shrinking.md).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "worker/occluders.h"
#include "worker/seed_region.h"

namespace veduta {

/// A square of a city from close.
struct SectionContent {
  SeedRegion region;
  std::string title;
  Box square;              ///< what is shown, m, within the region: the plan's square, the section's height
  glm::vec3 cut{0};        ///< the plan is cut at its z, the section along x at its y
  std::vector<Box> cells;  ///< view-cells
  std::vector<Box> free_leaves;   ///< leaves of the octree of navigable space
  std::vector<Box> solid_leaves;  ///< leaves of the octree of what surfaces pass
  WindowOccluders occluders;      ///< its first ring is filled, its last outlined
};

/// SVG: the plan, the section below it, a scale bar and a legend.
std::string draw_section(const SectionContent& content);
/// \throw Error(input_output); then there is no file, or the one before.
void write_section(const std::filesystem::path& file, const SectionContent& content);

}  // namespace veduta
