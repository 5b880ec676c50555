#include "export/export.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <string_view>

#include "scene/atomic_file.h"
#include "scene/error.h"
#include "scene/text.h"

namespace veduta {
namespace {

constexpr std::array<std::string_view, 5> extensions{".obj", ".gltf", ".glb", ".svg", ".jsonl"};

Error usage(const std::string& what) {
  return Error(ExitStatus::usage, what);
}

Exported write_as(const std::string& extension, const PvsStream& stream, std::optional<uint32_t> cell,
                  const std::filesystem::path& out, const std::string& materials) {
  if (extension == ".jsonl") return write_json_lines(stream, cell, out);
  if (extension == ".svg") return write_plan(stream, *cell, out);
  if (extension == ".obj") return write_obj(stream, *cell, out, materials);
  return write_gltf(stream, *cell, out, extension == ".glb" ? GltfForm::binary : GltfForm::text);
}

float distance_m(const Box& box, const glm::vec3& point) {
  return glm::distance(point, glm::clamp(point, box.lower, box.upper));
}

}  // namespace

void check_exportable(const std::filesystem::path& out, bool one_cell) {
  const std::string extension = extension_of(out);
  if (std::find(extensions.begin(), extensions.end(), extension) == extensions.end())
    throw usage(out.string() +
                ": cannot tell the format from the name; end it in .obj, .gltf, .glb, .svg or .jsonl");
  if (!one_cell && extension != ".jsonl")
    throw usage(out.string() + ": shows one cell; name it with --cell or --at");
}

Exported export_result(const PvsStream& stream, std::optional<uint32_t> cell,
                       const std::filesystem::path& out) {
  check_exportable(out, cell.has_value());
  const std::string extension = extension_of(out);
  const std::filesystem::path materials = std::filesystem::path(out).replace_extension(".mtl");
  remove_dead_temporaries(out);
  Exported exported;
  write_atomically(out, [&](const std::filesystem::path& temporary) {
    exported = write_as(extension, stream, cell, temporary, printable(materials.filename().string(), 10000));
    // Last of what can fail, and before the file that names it has its own name.
    if (extension == ".obj") write_atomically(materials, write_obj_materials);
  });
  return exported;
}

uint32_t cell_of_number(const PvsIndex& index, uint64_t number) {
  if (number < index.cells.size()) return static_cast<uint32_t>(number);
  throw usage(index.cells.empty() ? fmt::format("cell {}: the file has no cell", number)
                                  : fmt::format("cell {}: the file has cells 0 to {}; name one of them",
                                                number, index.cells.size() - 1));
}

uint32_t cell_at(const PvsIndex& index, const glm::vec3& point) {
  const std::string where = fmt::format("({}, {}, {})", point.x, point.y, point.z);
  if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z))
    throw usage(where + ": is no point; give three finite numbers");
  const int64_t found = index.find_cell(point);
  if (found >= 0) return static_cast<uint32_t>(found);
  if (index.cells.empty()) throw usage(where + ": the file has no cell");
  const auto nearest = std::min_element(
      index.cells.begin(), index.cells.end(),
      [&](const Box& a, const Box& b) { return distance_m(a, point) < distance_m(b, point); });
  throw usage(fmt::format("{}: lies in no cell; the nearest is cell {}, {:.3g} m away", where,
                          nearest - index.cells.begin(), distance_m(*nearest, point)));
}

}  // namespace veduta
