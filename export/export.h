// What a result says, for programs that do not read it: one cell's visible geometry as OBJ or glTF, its plan
// as SVG, rows as JSON lines (docs/exporting.md). Coordinates are metres from the file's origin, so that
// float32 is enough for who reads them; where that origin is, and in which CRS, each file says.
//
// Files are written whole or not at all. Of the city, memory holds the index, one object at a time and, for
// glTF, what is written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>

#include "pvs/pvs_stream.h"

namespace veduta {

/// What was written.
struct Exported {
  uint64_t cells = 0, objects = 0, triangles = 0;  ///< objects of JSON lines: entries; no triangles there
  uint64_t bytes = 0;
};

/// By the extension of `out`, small or capital letters: .obj, .gltf, .glb, .svg of a cell; .jsonl of a cell,
/// or of all. \throw Error(usage) for another extension, for no cell where one is needed, and for geometry
/// that the format has no room for; Error(bad_input) where the file is damaged; Error(input_output).
Exported export_result(const PvsStream& stream, std::optional<uint32_t> cell,
                       const std::filesystem::path& out);

/// Throws what export_result would throw for the name: before a file is opened for it.
void check_exportable(const std::filesystem::path& out, bool one_cell);

/// The cell of this number. \throw Error(usage) when there is none.
uint32_t cell_of_number(const PvsIndex& index, uint64_t number);

/// The cell that holds a point, m from the file's origin. \throw Error(usage) when none does, which names the
/// nearest one.
uint32_t cell_at(const PvsIndex& index, const glm::vec3& point);

/// One format each, to be written to a temporary name. `materials`: the name of the file beside it that
/// write_obj_materials writes.
Exported write_obj(const PvsStream& stream, uint32_t cell, const std::filesystem::path& out,
                   const std::string& materials);
void write_obj_materials(const std::filesystem::path& out);
enum class GltfForm { text, binary };
Exported write_gltf(const PvsStream& stream, uint32_t cell, const std::filesystem::path& out, GltfForm form);
Exported write_json_lines(const PvsStream& stream, std::optional<uint32_t> cell,
                          const std::filesystem::path& out);
Exported write_plan(const PvsStream& stream, uint32_t cell, const std::filesystem::path& out);

}  // namespace veduta
