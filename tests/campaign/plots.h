// The kinds of things that stand around a viewer in a scene of the campaign.
#pragma once

#include <vector>

#include "tests/campaign/dice.h"
#include "tests/campaign/solids.h"
#include "worker/settings.h"

namespace veduta::campaign {

enum class Plot : uint8_t {
  block,       ///< a turned box, prism, gabled house or L
  wall,        ///< across the line of sight, of any thickness
  slit_wall,   ///< two walls with a slit between, of a tenth of a seed to four seeds, or of half a pixel
  fence,       ///< of thin pillars
  tower,       ///< boxes on boxes, with a spire or without
  row_houses,  ///< that touch, overlap or leave narrow gaps; one object or several
  courtyard,   ///< four wings, with an archway or without
  arcade,      ///< a wall on pillars
  overhang,    ///< a slab on legs
  thin_wall,   ///< a sheet or a centimetre
  spikes,
  stacked,    ///< a slab over a box, with a slit between or without
  open_box,   ///< without a lid
  nested,     ///< a building inside another
  sliver,     ///< a needle of a prism
  far_away,   ///< a large block on the far rings
  over_cell,  ///< something that cuts the cell, stands in it or hangs over it
  count
};

/// Where a plot is built: at `at`, its front towards the viewer at 0.
struct Site {
  const Settings& settings;
  glm::dvec2 at{0};
  double ground_m = 0;  ///< what stands there begins at it or below
};

/// \return the objects of one plot, named after it.
std::vector<Thing> build(Plot plot, const Site& site, Dice& dice);

}  // namespace veduta::campaign
