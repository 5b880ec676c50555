// Between which heights the next prism gains most.
#pragma once

#include <cstdint>
#include <vector>

#include "worker/section_pieces.h"

namespace veduta {

/// What a prism is given before its outline is known.
struct PrismHeights {
  float lower, upper;
  double gain;  ///< sum over samples of what is covered then and was not, m
};

/// The heights at which a section over all of these samples that allow them would gain most. \param cells
/// some, each with upper above covered
PrismHeights best_heights(const SectionHeights& heights, const std::vector<uint32_t>& cells);

}  // namespace veduta
