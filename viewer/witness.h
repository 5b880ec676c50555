// Looking where a verification met what a row does not draw.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "viewer/headless.h"
#include "viewer/stream/city_source.h"

namespace veduta {

/// Example N, from 0: "3" of the verification in the file, "report.json:3" of one that `veduta verify --json`
/// wrote (false invisible first, then narrow gaps). `name` stands for the file in messages.
/// \throw Error(usage) when there is no such example; Error(bad_input) for a report that is none, is damaged
///   or is about other cells.
Witness find_witness(const PvsIndex& index, const std::string& name, const std::string& which);

/// From the eye along the ray.
Pose pose_of(const Witness& witness);

/// Degrees, so that the triangle fills a good part of the picture and something around it is seen.
float fov_of(const Witness& witness, const CitySource& source);

struct WitnessPicture {
  Image image;              ///< left: what the row of the cell draws; right: and in red what it lacks
  uint64_t red_pixels = 0;  ///< of the right half
};

/// \throw Error(usage) when there is no usable GL.
WitnessPicture draw_witness(std::unique_ptr<const CitySource> source, const Witness& witness,
                            const HeadlessOptions& options, uint64_t memory_bytes);

}  // namespace veduta
