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

/// Removes what writers of `file` left that were killed, on whatever host: their locks are gone. Those of
/// living writers stay, and all of them where the file system has no locks.
void remove_dead_temporaries(const std::filesystem::path& file);

}  // namespace veduta
