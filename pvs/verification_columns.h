// The group /verification: written and read.
#pragma once

#include <string>

#include "pvs/hdf5_input.h"
#include "pvs/hdf5_output.h"
#include "pvs/verification.h"

namespace veduta {

inline constexpr const char* verification_group = "/verification";

/// Writes the group. Adds the digests of its datasets. `content_digest`: of the cells that it is about.
void write_verification(hdf5::Output& output, const Verification& verification,
                        const std::string& content_digest, ColumnDigests& digests);

/// Reads what that wrote; sums and digests are compared, its numbers not yet held against the city.
Verification read_verification(const hdf5::Input& input, const std::string& content_digest);

}  // namespace veduta
