// A file as other people's programs read it.
#pragma once

#include <filesystem>
#include <string>

#include "pvs/pvs_file.h"

namespace veduta::test {

/// Reads all of a file by veduta/pvs.h and holds it against what read_pvs read, if it did.
/// \return why it is refused; empty: it is not. \throw BrokenPromise for other values, or wrong refusals.
std::string read_by_library(const std::filesystem::path& file, const PvsFile* whole);

}  // namespace veduta::test
