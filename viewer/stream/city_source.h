// Where rows and pages come from: a file, or what a test wants.
#pragma once

#include <filesystem>
#include <memory>

#include "pvs/pvs_stream.h"

namespace veduta {

/// As PvsStream: used by one thread at a time.
class CitySource {
 public:
  virtual ~CitySource() = default;
  virtual const PvsIndex& index() const = 0;
  virtual PvsRow read_row(uint32_t row) const = 0;
  virtual City read_objects(uint32_t first, uint32_t last) const = 0;
};

/// \throw Error as PvsStream.
std::unique_ptr<const CitySource> open_source(const std::filesystem::path& file);

}  // namespace veduta
