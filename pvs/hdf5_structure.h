// Is the metadata of an HDF5 file what our writer makes of it? Asked before HDF5 sees the file: HDF5 1.10 has
// read and written beyond its buffers where a file says what no writer would (tests/fuzz), and a checksum in
// the file says nothing about who computed it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace veduta::hdf5 {

/// Walks the header of every object that this program may ask for: kinds and lengths of its messages,
/// types, extents, layouts and filters, and that objects are a tree. Few kinds are let through, so that most
/// of HDF5 never runs: no dense storage but for attributes of the root, nothing shared, no committed types.
/// Values, chunk indices and checksums are left to who reads them. Takes about as long as opening the file.
/// \param descriptor  open for reading, of a file of so many bytes
/// \return "PLACE: what", or nothing.
std::optional<std::string> find_structure_defect(int descriptor, uint64_t file_bytes);

}  // namespace veduta::hdf5
