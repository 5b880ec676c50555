#include "scene/plans/memory_dataset.h"

#include <cpl_conv.h>
#include <cpl_vsi.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <atomic>
#include <mutex>

#include "scene/gdal_errors.h"

namespace veduta {
namespace {

std::string new_folder() {
  static std::atomic<uint64_t> next = 0;
  return "/vsimem/veduta-" + std::to_string(next++) + "/";
}

// These drivers alone: registering all of them takes long and lets a file choose any of two hundred.
void register_drivers() {
  static std::once_flag once;
  std::call_once(once, [] {
    RegisterOGRGeoJSON();
    RegisterOGRShape();
    RegisterOGRDXF();
  });
}

}  // namespace

MemoryDataset::MemoryDataset(const char* driver, const std::vector<const InputFile*>& files,
                             const std::vector<const char*>& options)
    : name_(files[0]->name), folder_(new_folder()) {
  register_drivers();
  GdalErrors errors;
  for (const InputFile* file : files) {
    paths_.push_back(folder_ + "plan" + file->extension);
    // GDAL reads the buffer where it is, and neither changes nor frees it.
    auto* bytes = reinterpret_cast<GByte*>(const_cast<char*>(file->bytes.data()));
    VSILFILE* opened = VSIFileFromMemBuffer(paths_.back().c_str(), bytes, file->content().size(), FALSE);
    if (opened) VSIFCloseL(opened);
  }
  const char* const drivers[] = {driver, nullptr};
  std::vector<const char*> with_end = options;
  with_end.push_back(nullptr);
  dataset_.reset(
      GDALDataset::Open(paths_[0].c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, drivers, with_end.data()));
  if (dataset_ && dataset_->GetLayerCount() > 0 && errors.first().empty()) return;
  dataset_.reset();
  remove_files();
  throw bad_input(name_, "whole file",
                  (errors.first().empty() ? std::string("GDAL finds nothing in it")
                                          : "GDAL says '" + errors.first() + "'") +
                      "; export it again");
}

MemoryDataset::~MemoryDataset() {
  const GdalErrors errors;
  dataset_.reset();
  remove_files();
}

void MemoryDataset::remove_files() {
  for (const std::string& path : paths_) VSIUnlink(path.c_str());
  VSIRmdirRecursive(folder_.c_str());
}

OGRLayer* MemoryDataset::layer(const char* name) const {
  const GdalErrors errors;
  return name ? dataset_->GetLayerByName(name) : dataset_->GetLayer(0);
}

void MemoryDataset::for_each(OGRLayer& layer,
                             const std::function<void(const OGRFeature&, uint64_t)>& visit) const {
  GdalErrors errors;
  layer.ResetReading();
  uint64_t number = 0;
  for (;; ++number) {
    const OGRFeatureUniquePtr feature(layer.GetNextFeature());
    if (!errors.first().empty())
      throw bad_input(name_, "features/" + std::to_string(number),
                      "GDAL says '" + errors.first() + "'; export the file again");
    if (!feature) return;
    visit(*feature, number);
  }
}

std::string crs_of(OGRLayer& layer) {
  const GdalErrors errors;
  const OGRSpatialReference* crs = layer.GetSpatialRef();
  if (!crs) return "";
  const char *authority = crs->GetAuthorityName(nullptr), *code = crs->GetAuthorityCode(nullptr);
  if (authority && code) return std::string(authority) + ":" + code;
  char* wkt = nullptr;
  crs->exportToWkt(&wkt);
  const std::string text = wkt ? wkt : "";
  CPLFree(wkt);
  return text;
}

}  // namespace veduta
