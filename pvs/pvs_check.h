// What must hold in a city and in a row: asked by the reader of a file and by the writer of a caller.
#pragma once

#include <optional>
#include <string>

#include "pvs/pvs_file.h"

namespace veduta {

struct Forms;
struct PvsIndex;

/// Every relation between the arrays of a city. \return "DATASET: what" for the first that does not hold.
std::optional<std::string> find_defect(const City& city);
/// Those of the scene and its slices; those of cells and navigation.
std::optional<std::string> find_scene_defect(const City& city);
std::optional<std::string> find_place_defect(const City& city);

/// Objects ascending and in range, indices within the objects' slices. \return what does not hold.
std::optional<std::string> find_defect(const PvsEntry* first, const PvsEntry* last,
                                       const std::vector<SliceCounts>& slices);

/// Forms against objects and their slices: what an entry can name is then within them. \return "DATASET:
/// what".
std::optional<std::string> find_form_defect(const Forms& forms, const std::vector<SliceCounts>& slices);

/// Rows against cells and the number of entries, which are for themselves. \return "DATASET: what".
std::optional<std::string> find_row_defect(const PvsFile& file);

/// Of a file that is read piece by piece: objects against the number of triangles, rows against cells and the
/// number of entries. \return "DATASET: what".
std::optional<std::string> find_object_defect(const std::vector<Object>& objects,
                                              const std::vector<SliceCounts>& slices, uint64_t triangles);
std::optional<std::string> find_row_defect(const PvsIndex& index, uint64_t entries);

}  // namespace veduta
