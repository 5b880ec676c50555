// The parts of a file that a prepared city and a result have in common.
#pragma once

#include "pvs/hdf5_input.h"
#include "pvs/hdf5_output.h"

namespace veduta {

/// Makes the groups in which the datasets of a city are; those of places say where their lattices lie.
void write_scene_groups(hdf5::Output& output);
void write_place_groups(hdf5::Output& output, const Navigation& lattices);
/// Writes /scene. Adds the digests of what it wrote.
void write_scene_columns(hdf5::Output& output, const City& city, ColumnDigests& digests);
/// Writes /navigation and /cells/bounds, likewise.
void write_place_columns(hdf5::Output& output, const City& city, ColumnDigests& digests);
/// Copies what these two wrote, from a prepared city whose outline was read: its digests hold.
void copy_city(hdf5::Output& output, const hdf5::Input& from, const CityOutline& city);
enum class CityParts { all, to_bake, to_look_up };
/// Reads what was written, or what is needed of it: to bake, surfaces and ground have no values, and to
/// look up cells, free space has none either; their digests are those that they should have. Digests are
/// compared, relations not yet.
/// \param bounds  replaced by what the file says of the bounds of each object
City read_city_columns(const hdf5::Input& input, ColumnDigests& digests, std::vector<Box>& bounds,
                       CityParts parts = CityParts::all);

/// Of it, the objects without their geometry. \return the bounds of each.
std::vector<Box> read_object_columns(const hdf5::Input& input, City& city, ColumnDigests& digests);
/// Of it, navigation and cells.
void read_place_columns(const hdf5::Input& input, City& city, ColumnDigests& digests,
                        CityParts parts = CityParts::all);

/// Reads all of a navigation whose digests were passed over.
void read_navigation_columns(const hdf5::Input& input, Navigation& navigation);

/// Reads where the lattices of a navigation lie, and nothing of what is in them.
void read_lattices(const hdf5::Input& input, Navigation& navigation);

/// Writes and reads the root's attributes. Reading compares the format, the version and the digest over them.
void write_root(hdf5::Output& output, const RootAttributes& root);
RootAttributes read_root(const hdf5::Input& input, const std::string& format);

/// Reads every dataset again and compares with what was meant to be written: HDF5 1.10 has closed a file on a
/// full disk successfully, with other values in it. \throw Error(input_output).
void check_written(const std::filesystem::path& temporary, const ColumnDigests& digests,
                   const RootAttributes& root, const WorkHeard& heard = {});

/// Reads the named datasets of a file in blocks, compares their digests with their values and hands them out.
void read_columns(const hdf5::Input& input, const std::vector<const Column*>& columns, ColumnDigests& digests,
                  const char* what, const WorkHeard& heard);

}  // namespace veduta
