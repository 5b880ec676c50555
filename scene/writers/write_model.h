// A generated city into a file.
#pragma once

#include <cstdint>
#include <filesystem>

#include "scene/city/city_model.h"

namespace veduta::city {

struct WrittenFile {
  uint64_t bytes = 0;
  double seconds = 0;
  double seconds_in_system = 0;  ///< of these: waiting for the file system
};

/// \throw Error(usage) unless the name ends in .json (CityJSON), .obj or .dxf
void check_writable_format(const std::filesystem::path& file);

/// Writes the format that the name asks for. The file is there whole or not at all. The same model gives the
/// same bytes with any number of threads.
/// \throw Error(usage) for another format; Error(input_output) naming the cause (disk full, no such folder)
WrittenFile write_model(const CityModel& model, const std::filesystem::path& file);

}  // namespace veduta::city
