// Covering what erosion leaves of sealed space with few convex prisms.
#pragma once

#include <vector>

#include "worker/sealed_columns.h"
#include "worker/section_pieces.h"

namespace veduta {

/// A convex piece of the plan and heights between which no exposed surface is in reach of the window there.
struct Section {
  PlanPolygon polygon;
  double lower_m = 0, upper_m = 0;  ///< before the window's height is taken off
  glm::dvec2 seed{0};               ///< a point of the polygon
};

struct CoverOptions {
  double keep = 0.95;     ///< share of the volume that is asked for, of each connected part of the plan
  double rise_m = 0;      ///< what is covered less than this by is left
  double least_m3 = 0;    ///< a section that gains less is left out
  double margin_m = 0;    ///< kept from exposed pieces
  glm::dvec3 reach_m{0};  ///< half the window
};

/// Greedily, the section that gains most first; each around the point farthest from all that stands in the
/// way at its height. `heights` is used up: covered tells afterwards what is covered.
std::vector<Section> cover_with_sections(SectionHeights& heights, const SectionPieces& pieces,
                                         const SealedColumns& columns, const CoverOptions& options);

}  // namespace veduta
