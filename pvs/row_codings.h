// What a row would take in the codings that others use: set beside what it takes in the file.
#pragma once

#include <cstdint>

#include "pvs/visibility.h"

namespace veduta {

/// Bytes. Nothing is shared between cells and nothing packed further.
struct RowCodings {
  uint64_t three_bytes = 0;  ///< x, y, z of every object, zeros for one that is not visible (thesis §4.1.3)
  uint64_t three_bytes_runs = 0;  ///< of that, runs of zeros counted
  uint64_t bits = 0;       ///< a bit an object, which knows nothing of slices; object 0 is bit 0 of byte 0
  uint64_t bits_runs = 0;  ///< of that, runs of zeros counted, as Quake's `vis` stores it
};

/// Runs of zeros are coded as Quake does it: 1 to 255 bytes of 0 become two, 0 and their number; other bytes
/// stay. Takes time of the entries, not of the objects. \pre objects ascend and are less than `objects`.
RowCodings row_codings(const PvsEntry* first, const PvsEntry* last, uint64_t objects);

}  // namespace veduta
