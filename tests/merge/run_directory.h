// A run directory as a bake leaves it, of a small city.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "merge/merge.h"
#include "pvs/pvs_file.h"
#include "pvs/shard.h"
#include "tests/pvs/small_city.h"

namespace veduta::test {

inline const std::string job = "0123456789abcdef";

inline CellRecord record(uint32_t cell) {
  const BakedCell baked = small_row(cell);
  return {cell, baked.status, baked.bake_us, baked.row, baked.overestimate};
}

/// A run directory with a city of 7 cells and no shard yet.
struct RunDirectory {
  TemporaryDirectory directory;
  RunPaths paths{directory.path()};

  explicit RunDirectory(const City& city = small_city()) {
    std::filesystem::create_directories(paths.prepared());
    std::filesystem::create_directories(paths.shards());
    test::write_bytes(paths.fingerprint(), job + "\nsettings 1234\n");
    test::write_bytes(paths.settings(), "# settings\n");
    write_city(paths.city(), city);
  }
  void shard(const std::string& name, const std::vector<CellRecord>& records,
             const std::string& renderer = "llvmpipe") const {
    ShardWriter writer(paths.shards() / name, job, renderer);
    for (const CellRecord& r : records) writer.append(r);
  }
  void whole() const {
    shard("b", {record(0), record(5), record(2)}, "a GPU");
    shard("a", {record(6), record(1), record(4), record(3)});
  }
  Journal journal() const { return read_journal(paths, job, 7); }
  /// Names in the run directory.
  std::vector<std::string> names() const {
    std::vector<std::string> out;
    for (const auto& entry : std::filesystem::directory_iterator(directory.path()))
      out.push_back(entry.path().filename().string());
    std::sort(out.begin(), out.end());
    return out;
  }
};

}  // namespace veduta::test
