// Mutants that know what they are mutants of: a few of many get past checksums and digests by chance.
#pragma once

#include <cstddef>
#include <cstdint>

namespace veduta::test {

/// Changes bytes in place. \param most  how many there may be afterwards \return how many there are.
using BytesMutator = size_t (*)(uint8_t* bytes, size_t count, size_t most);

/// The same of a whole file: anywhere; or in HDF5's metadata or in a chunk, with the checksum made to hold;
/// or of values, with all digests made to hold.
size_t mutate_file(uint8_t* bytes, size_t count, size_t most, unsigned seed, BytesMutator mutate);

}  // namespace veduta::test
