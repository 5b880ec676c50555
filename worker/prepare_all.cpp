// The whole preparation in one process.
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <mutex>

#include "worker/preparation.h"

namespace veduta {
namespace {

/// Calls work(part) for each part, as many at a time as there are threads, which bounds the memory: a thread
/// that waits inside of a part does not begin another.
template <typename Work>
void each_part(const std::vector<uint32_t>& parts, const Work& work) {
  tbb::parallel_for(
      size_t{0}, parts.size(), [&](size_t n) { tbb::this_task_arena::isolate([&] { work(parts[n]); }); },
      tbb::simple_partitioner());
}

std::vector<uint32_t> numbers(uint32_t count) {
  std::vector<uint32_t> all(count);
  for (uint32_t n = 0; n < count; ++n) all[n] = n;
  return all;
}

/// Counts the parts of a stage and tells.
class Stage {
 public:
  Stage(const PreparationProgress& progress, const char* name, size_t total)
      : progress_(progress), name_(name), total_(static_cast<uint32_t>(total)) {
    tell();
  }
  void done() {
    const std::lock_guard lock(mutex_);
    ++done_;
    tell();
  }
  /// More parts have turned up.
  void expect(size_t parts) { total_ += static_cast<uint32_t>(parts); }

 private:
  void tell() const {
    if (progress_) progress_(name_, done_, total_);
  }

  const PreparationProgress& progress_;
  std::string name_;
  uint32_t done_ = 0, total_;
  std::mutex mutex_;
};

/// In rounds: the tiles that were named in one are flooded in the next.
void flood_all(const RunPaths& run, uint32_t tiles, Stage& stage) {
  for (std::vector<uint32_t> waiting = numbers(tiles); !waiting.empty();) {
    std::vector<uint32_t> named;
    std::mutex mutex;
    each_part(waiting, [&](uint32_t tile) {
      const std::vector<uint32_t> more = flood_tile(run, tile);
      const std::lock_guard lock(mutex);
      named.insert(named.end(), more.begin(), more.end());
      stage.done();
    });
    std::sort(named.begin(), named.end());
    named.erase(std::unique(named.begin(), named.end()), named.end());
    stage.expect(named.size());
    waiting = std::move(named);
  }
}

}  // namespace

PreparedSize prepare_all(const RunPaths& run, const Settings& settings, const PreparationProgress& progress,
                         const PartSizes& sizes) {
  PreparationSize size;
  {
    Stage stage(progress, "import", 1);
    size = import_city(run, settings, sizes);
    stage.done();
  }
  {
    Stage stage(progress, "flood", size.tiles);
    flood_all(run, size.tiles, stage);
  }
  {
    Stage stage(progress, "cells", size.tiles);
    each_part(numbers(size.tiles), [&](uint32_t tile) {
      make_tile_cells(run, settings, tile);
      stage.done();
    });
  }
  {
    Stage stage(progress, "shrink", size.blocks);
    each_part(numbers(size.blocks), [&](uint32_t block) {
      shrink_block(run, settings, block);
      stage.done();
    });
  }
  Stage stage(progress, "finish", 1);
  PreparedSize prepared = finish_preparation(run, settings);
  stage.done();
  return prepared;
}

}  // namespace veduta
