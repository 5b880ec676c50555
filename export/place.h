// Where a file's coordinates are, and what is known of a cell: in words, and as names that all exports share.
#pragma once

#include <string>

#include "pvs/pvs_stream.h"

namespace veduta {

/// "m from (78000.125, 458000.5, -2.25) of EPSG:7415", on one line.
std::string place_in_words(const PvsIndex& index);

/// "cell from (0, -10, 1) to (10, 0, 2), baked"
std::string cell_in_words(const PvsIndex& index, uint32_t cell);

/// "baked", "coarse", "all_visible"
const char* status_name(CellStatus status);

}  // namespace veduta
