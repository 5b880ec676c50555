// Files of words in parts, each packed by itself, so that one can be read without the rest.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <vector>

namespace veduta {

/// Runs `write` on a temporary name beside `file` and renames. Not synced: a preparation writes thousands of
/// files, and after a power loss what is torn is found when it is read. \throw Error(input_output), and what
/// `write` throws.
void replace_unsynced(const std::filesystem::path& file,
                      const std::function<void(const std::filesystem::path&)>& write);

/// Calls words_of(part) for each part, several at a time, and writes what it gives, under a temporary name
/// first. \throw Error(input_output).
using PartWords = std::function<std::vector<uint64_t>(size_t part)>;
void write_packed(const std::filesystem::path& file, size_t parts, const PartWords& words_of);

/// A packed file that stays open: what is read is of one version, also when another takes its name meanwhile.
class PackedFile {
 public:
  /// \throw Error(bad_input) when it is missing, damaged or has not so many parts.
  PackedFile(const std::filesystem::path& file, size_t parts);

  /// What was written as this part. \throw Error(bad_input) when it is damaged.
  std::vector<uint64_t> read(size_t part);

 private:
  [[noreturn]] void damaged() const;

  std::filesystem::path file_;
  std::ifstream in_;
  std::vector<uint64_t> begin_;  // [parts + 1] bytes into the file
};

}  // namespace veduta
