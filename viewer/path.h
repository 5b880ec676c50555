// A path of eye points, as a CSV file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "viewer/stereo.h"

namespace veduta {

/// Reads a CSV with the header line "x,y,z,yaw_deg,pitch_deg": m relative to the scene origin, and degrees
/// (Pose). \throw Error(bad_input) "FILE: line N: what": missing file, another header, not five finite
/// numbers, a pitch outside
///   [-90, 90], no line at all.
std::vector<Pose> read_path(const std::filesystem::path& file);

/// Writes a path so that read_path gives back the same numbers. \throw Error(input_output)
void write_path(const std::filesystem::path& file, const std::vector<Pose>& path);

/// A pose between two: straight, turning the short way. \param part 0: a, 1: b
Pose between(const Pose& a, const Pose& b, float part);

/// The path with `frames` poses: from the first to the last at even steps, straight between its poses,
/// turning the short way.
std::vector<Pose> resample(const std::vector<Pose>& path, size_t frames);

}  // namespace veduta
