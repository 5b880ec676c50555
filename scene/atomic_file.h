// Files that are there whole or not at all.
#pragma once

#include <filesystem>
#include <functional>

namespace veduta {

/// Runs `write` on a temporary name beside `file`, runs `check` (if any) on the closed result, syncs and
/// renames. Nothing is left behind by a failure. \throw Error(input_output), and what the two throw.
void write_atomically(const std::filesystem::path& file,
                      const std::function<void(const std::filesystem::path&)>& write,
                      const std::function<void(const std::filesystem::path&)>& check = {});

/// The temporary name that a process with this id writes to, beside `file`: to be removed when that process
/// died.
std::filesystem::path temporary_name(const std::filesystem::path& file, long pid);

}  // namespace veduta
