// Which rows of the file hold for the eyes (thesis §5.1.4: two eyes may be in two cells).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pvs/pvs_file.h"
#include "viewer/stereo.h"

namespace veduta {

/// How far an eye may be outside the cell of its midpoint, m: what the bake was told (`stereo.eye_margin_m`
/// of the configuration that the file carries). 0 when the file does not say.
double baked_eye_margin_m(const std::string& config);

/// What the eyes can see together.
struct ActiveCells {
  int64_t cell = -1;              ///< of the midpoint; -1: outside every cell
  bool everything = false;        ///< an eye is where no row holds: nothing may be left out
  std::vector<PvsEntry> entries;  ///< by ascending object; an object may have two, whose union is visible
};

/// When the eyes are within the margin of their midpoint, its cell's row serves both; else the rows of both
/// eyes' cells are united.
ActiveCells active_cells(const PvsFile& file, const Pose& pose, const Optics& optics, StereoMode mode,
                         double eye_margin_m);

}  // namespace veduta
