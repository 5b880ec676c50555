// Where a run directory keeps things (DESIGN §8).
#pragma once

#include <filesystem>

namespace veduta {

struct RunPaths {
  std::filesystem::path directory;
  std::filesystem::path settings() const { return directory / "run.toml"; }
  std::filesystem::path fingerprint() const { return directory / "fingerprint"; }
  std::filesystem::path lock() const { return directory / "lock"; }
  std::filesystem::path log() const { return directory / "log.jsonl"; }
  std::filesystem::path prepared() const { return directory / "prepared"; }
  std::filesystem::path city() const { return directory / "prepared" / "city.h5"; }
  std::filesystem::path occluders() const { return directory / "prepared" / "occluder_clusters.bin"; }
  std::filesystem::path shards() const { return directory / "shards"; }
  std::filesystem::path report() const { return directory / "report.json"; }
  std::filesystem::path result() const { return directory / "city.pvs.h5"; }
};

}  // namespace veduta
