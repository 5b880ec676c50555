// What makes two bakes the same job: the bytes of the models, every setting, and the version of the
// algorithm.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "worker/settings.h"

namespace veduta {

/// Raise it with every change that may change a row: old run directories are then refused rather than mixed.
inline constexpr int algorithm_version = 6;

/// 32 hex digits over `parts`: every key with its value, or with the hash of a file's content. Model paths
/// are left out, so that a run directory can be continued where the models lie elsewhere.
struct Fingerprint {
  std::string hash;
  std::vector<std::pair<std::string, std::string>> parts;

  /// The `fingerprint` file: the hash, then one "key = value" a line.
  std::string text() const;
};

/// Reads every file that the models depend on (files_of() in scene/model_files.h). \throw Error(bad_input)
/// when one is missing or cannot be read.
Fingerprint make_fingerprint(const Settings& settings);

/// \throw Error(other_job) naming the first key that differs, when `stored` (the content of the `fingerprint`
/// file of
///   `directory`) is of another job.
void require_same_job(const std::filesystem::path& directory, const std::string& stored,
                      const Fingerprint& ours);

/// XXH3-128 of a file's bytes, 32 hex digits. \throw Error(bad_input).
std::string hash_file(const std::filesystem::path& file);

}  // namespace veduta
