// Files in memory as GDAL sees them.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "scene/import.h"
#include "scene/text.h"

class OGRFeature;
class OGRLayer;
class GDALDataset;

namespace veduta {

/// A vector data set over InputFiles that stay in memory. GDAL sees these files and no others.
class MemoryDataset {
 public:
  /// \param files the first one is opened; the others lie beside it under the same stem. They must outlive
  /// this. \param options of the driver, "NAME=VALUE" \throw Error(bad_input) with GDAL's reason when it
  /// cannot be opened
  MemoryDataset(const char* driver, const std::vector<const InputFile*>& files,
                const std::vector<const char*>& options);
  ~MemoryDataset();
  MemoryDataset(const MemoryDataset&) = delete;
  MemoryDataset& operator=(const MemoryDataset&) = delete;

  OGRLayer* layer(const char* name) const;  ///< null: none; without a name the first one

  /// Calls `visit` with each feature of the layer and its number in the file, from 0.
  /// \throw Error(bad_input) when GDAL meets a mistake in the file
  void for_each(OGRLayer& layer, const std::function<void(const OGRFeature&, uint64_t)>& visit) const;

 private:
  void remove_files();

  std::string name_, folder_;
  std::vector<std::string> paths_;
  std::unique_ptr<GDALDataset> dataset_;
};

/// "EPSG:3946" where the layer's CRS has such a name, else WKT; empty without one.
std::string crs_of(OGRLayer& layer);

}  // namespace veduta
