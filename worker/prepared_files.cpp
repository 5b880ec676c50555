// prepared/: city.h5 (the file's own layout) and occluders.bin (private to the worker).
#include "pvs/pvs_file.h"
#include "pvs/run_paths.h"
#include "scene/error.h"
#include "scene/sync_path.h"
#include "worker/occluder_file.h"
#include "worker/prepare.h"

namespace veduta {

void write_prepared(const std::filesystem::path& run_directory, const Prepared& prepared) {
  namespace fs = std::filesystem;
  const RunPaths run{run_directory};
  std::error_code error;
  const fs::path temporary = run_directory / "prepared.tmp";
  fs::remove_all(temporary, error);
  if (!fs::create_directory(temporary, error)) {
    throw Error(ExitStatus::input_output, temporary.string() + ": cannot be made: " + error.message());
  }
  write_city(temporary / run.city().filename(), prepared.city);
  write_occluder_file(temporary / "occluders.bin", prepared.occluders);
  sync_path(temporary);

  fs::remove_all(run.prepared(), error);
  fs::rename(temporary, run.prepared(), error);
  if (error) throw Error(ExitStatus::input_output, run.prepared().string() + ": " + error.message());
  sync_path(run_directory);
}

std::vector<WindowOccluders> read_occluders(const std::filesystem::path& run_directory) {
  return read_occluder_file(RunPaths{run_directory}.prepared() / "occluders.bin");
}

}  // namespace veduta
