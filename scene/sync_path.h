// Making what was written, or renamed, outlast a power loss.
#pragma once

#include <filesystem>

namespace veduta {

/// fsync of a file, or of a directory (for the names in it). A file system that cannot sync one has nothing
/// to wait for. \throw Error(input_output).
void sync_path(const std::filesystem::path& path);

}  // namespace veduta
