// Looking where a verification met what a row does not draw.
#pragma once

#include <cstdint>
#include <string>

#include "pvs/pvs_file.h"
#include "viewer/view.h"

namespace veduta {

/// Example N, from 0: "3" of the verification in the file, "report.json:3" of one that `veduta verify --json`
/// wrote (false invisible first, then narrow gaps). `name` stands for the file in messages.
/// \throw Error(usage) when there is no such example; Error(bad_input) for a report that is none, is damaged
///   or is about other cells.
Witness find_witness(const PvsFile& file, const std::string& name, const std::string& which);

/// From the eye along the ray.
Pose pose_of(const Witness& witness);

/// Degrees, so that the triangle fills a good part of the picture and something around it is seen.
float fov_of(const Witness& witness, const City& city);

struct WitnessPicture {
  Image image;              ///< left: what the row of the cell draws; right: and in red what it lacks
  uint64_t red_pixels = 0;  ///< of the right half
};

/// \throw Error(usage) when there is no usable GL.
WitnessPicture draw_witness(const PvsFile& file, const Witness& witness, const ViewOptions& options);

}  // namespace veduta
