#include "scene/readers/dxf_blocks.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

#include "scene/names.h"

namespace veduta {
namespace {

// More of these than a city has, and fewer than fill the memory: a file of some bytes can ask for any number
// of them.
constexpr uint64_t max_instances = 4'000'000, max_copied_polygons = 20'000'000;
constexpr int max_depth = 64;
constexpr uint64_t unfinished = ~uint64_t{0};

std::string lower(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name;
}

// An insert with a scale of 0, or one beyond all numbers, has no surface.
bool keeps_volume(const DxfInsert& insert) {
  const double volume = glm::determinant(glm::dmat3(insert.placement));
  return volume != 0 && std::isfinite(volume);
}

glm::dmat4x3 shifted(const glm::dmat4x3& m, glm::dvec3 inner) {
  glm::dmat4x3 result = m;
  result[3] = m * glm::dvec4(inner, 1);
  return result;
}

}  // namespace

glm::dmat4x3 after(const glm::dmat4x3& a, const glm::dmat4x3& b) {
  const glm::dmat3 turn(a);
  return glm::dmat4x3(turn * b[0], turn * b[1], turn * b[2], a * glm::dvec4(b[3], 1));
}

DxfInsert read_dxf_insert(const DxfEntity& entity, const DxfGroups& groups) {
  const double angle = glm::radians(entity.real_or(50, 0)), c = std::cos(angle), s = std::sin(angle);
  const glm::dmat3 world = dxf_world_from_object(entity.extrusion);
  const glm::dmat3 turn = world * glm::dmat3(c, s, 0, -s, c, 0, 0, 0, 1);
  DxfInsert insert;
  insert.block = dxf_name(entity.name);
  insert.layer = dxf_name(entity.layer);
  insert.handle = dxf_name(entity.handle);
  insert.line = entity.line;
  insert.placement = glm::dmat4x3(turn[0] * entity.real_or(41, 1), turn[1] * entity.real_or(42, 1),
                                  turn[2] * entity.real_or(43, 1), world * entity.corner[0]);
  insert.column_step = turn[0] * entity.real_or(44, 0);
  insert.row_step = turn[1] * entity.real_or(45, 0);
  const auto copies = [&](int64_t number) {
    if (number < 0 || number > 32767)
      throw groups.error("the INSERT before this line asks for " + std::to_string(number) +
                         " rows or columns; DXF allows 1 to 32767");
    return static_cast<uint64_t>(std::max<int64_t>(number, 1));
  };
  insert.columns = copies(entity.integer[0]);
  insert.rows = copies(entity.integer[1]);
  for (int column = 0; column < 4; ++column)
    for (int axis = 0; axis < 3; ++axis)
      if (!std::isfinite(insert.placement[column][axis]))
        throw groups.error("the INSERT before this line has a scale or place beyond all numbers; repair it");
  return insert;
}

glm::dmat4x3 DxfInsert::copy(uint64_t row, uint64_t column) const {
  glm::dmat4x3 result = placement;
  result[3] += static_cast<double>(column) * column_step + static_cast<double>(row) * row_step;
  return result;
}

void DxfBlocks::add(DxfBlock block) {
  for (uint64_t i = block.polygon_begin; i < block.polygon_end; ++i)
    block.on_layer_0 |= polygon_layer_[i] == 0;
  number_.try_emplace(lower(block.name), blocks_.size());
  blocks_.push_back(std::move(block));
}

std::string DxfBlocks::place_of(const DxfInsert& insert) const {
  return model_.file + ": line " + std::to_string(insert.line);
}

Error DxfBlocks::error(const DxfInsert& insert, const std::string& what) const {
  return bad_input(model_.file, "line " + std::to_string(insert.line), what);
}

const DxfBlock* DxfBlocks::find(const DxfInsert& insert, ImportReport& report) const {
  const auto known = number_.find(lower(insert.block));
  if (known == number_.end()) {
    count_dropped(report, "insert of a block that is missing", place_of(insert));
    return nullptr;
  }
  const DxfBlock& block = blocks_[known->second];
  if (block.external) {
    count_dropped(report, "insert of a block in another file", place_of(insert));
    return nullptr;
  }
  if (!keeps_volume(insert)) {
    count_dropped(report, "insert with a scale of 0", place_of(insert));
    return nullptr;
  }
  return &block;
}

// How many polygons a block has with those of the blocks in it.
uint64_t DxfBlocks::polygons_of(const DxfBlock& block, const DxfInsert& from, ImportReport& report,
                                int depth) {
  const auto number = static_cast<size_t>(&block - blocks_.data());
  const auto [known, added] = polygons_.try_emplace(number, unfinished);
  if (!added && known->second == unfinished)
    throw error(from,
                "block '" + printable(block.name, 60) + "' is inserted into itself; remove that insert");
  // Of a block that is known, what is in it counts as well: it may have been met from its other end.
  if (depth + (added ? 0 : blocks_[number].levels) > max_depth)
    throw error(from,
                "blocks are nested more than " + std::to_string(max_depth) + " deep; explode some of them");
  if (!added) return known->second;
  uint64_t count = block.polygon_end - block.polygon_begin;
  for (const DxfInsert& insert : block.inserts) {
    const DxfBlock* inner = find(insert, report);
    if (!inner) continue;
    const uint64_t each = polygons_of(*inner, insert, report, depth + 1);
    blocks_[number].levels = std::max(blocks_[number].levels, inner->levels + 1);
    const uint64_t copies = insert.rows * insert.columns;  // at most 2^30
    if (each != 0 && copies > max_copied_polygons / each)
      throw error(insert, "asks for more than 20 million polygons by nested inserts; export fewer copies");
    count += each * copies;
    if (count > max_copied_polygons + (block.polygon_end - block.polygon_begin))
      throw error(insert, "asks for more than 20 million polygons by nested inserts; export fewer copies");
  }
  return polygons_[number] = count;
}

void DxfBlocks::place(const DxfInsert& insert, ImportReport& report) {
  const DxfBlock* block = find(insert, report);
  if (!block || polygons_of(*block, insert, report, 0) == 0) return;
  const uint64_t copies = insert.rows * insert.columns;
  if (copies > max_instances - model_.placements.size())
    throw error(insert, "asks for more than 4 million instances; export fewer copies");
  const Material inherited = material_of_name(insert.layer);
  const Range range = whole(*block, inherited, report);
  Kind kind = kind_of_name(block->name);
  if (kind == Kind::building) kind = kind_of_name(insert.layer);
  const std::string name =
      block->name + "_" + (insert.handle.empty() ? std::to_string(insert.line) : insert.handle);
  for (uint64_t row = 0; row < insert.rows; ++row)
    for (uint64_t column = 0; column < insert.columns; ++column) {
      RawObject object;
      object.name = copies == 1 ? name : name + "_" + std::to_string(row * insert.columns + column + 1);
      object.kind = kind;
      object.place = place_of(insert);
      object.patches.push_back({"", model_.file, range.begin, range.end});
      object.placement = static_cast<uint32_t>(model_.placements.size());
      model_.placements.push_back(shifted(insert.copy(row, column), -block->base));
      model_.objects.push_back(std::move(object));
    }
}

// The polygons of a block with all that is in it. A block that holds no others is its own; else they are
// copied once.
const DxfBlocks::Range& DxfBlocks::whole(const DxfBlock& block, Material inherited, ImportReport& report) {
  const bool inherits = block.on_layer_0 || !block.inserts.empty();
  const Key key(static_cast<size_t>(&block - blocks_.data()), inherits ? inherited : Material::unknown);
  const auto [known, added] = whole_.try_emplace(key);
  if (!added) return known->second;
  Range& range = known->second;
  if (block.inserts.empty() && key.second == Material::unknown)
    return range = {block.polygon_begin, block.polygon_end};
  range.begin = model_.polygons.size();
  copied_ += polygons_.at(key.first);
  if (copied_ > max_copied_polygons)
    throw bad_input(model_.file, "BLOCKS",
                    "nested inserts ask for more than 20 million polygons; export fewer copies");
  copy_polygons(block, glm::dmat4x3(1), inherited, report);
  range.end = model_.polygons.size();
  return range;
}

void DxfBlocks::copy_polygons(const DxfBlock& block, const glm::dmat4x3& placement, Material inherited,
                              ImportReport& report) {
  for (uint64_t i = block.polygon_begin; i < block.polygon_end; ++i) {
    RawPolygon polygon = model_.polygons[i];
    const uint64_t ring = model_.rings_before(i);
    for (uint64_t corner = model_.corners_before(ring); corner < model_.ring_end[ring]; ++corner) {
      if (model_.vertices.size() >= std::numeric_limits<uint32_t>::max())
        throw bad_input(model_.file, "BLOCKS", "more than 4 billion vertices; cut the model into tiles");
      const glm::dvec3 p = placement * glm::dvec4(model_.vertices[model_.ring_vertex[corner]], 1);
      if (!std::isfinite(p.x + p.y + p.z))
        throw bad_input(
            model_.file, "BLOCKS",
            "nested inserts scale block '" + printable(block.name, 60) + "' beyond all numbers; repair them");
      model_.ring_vertex.push_back(static_cast<uint32_t>(model_.vertices.size()));
      model_.vertices.push_back(p);
    }
    model_.ring_end.push_back(model_.ring_vertex.size());
    polygon.ring_end = model_.ring_end.size();
    if (polygon_layer_[i] == 0) polygon.material = inherited;
    model_.polygons.push_back(polygon);
    polygon_layer_.push_back(polygon_layer_[i]);
  }
  for (const DxfInsert& insert : block.inserts) {
    const auto known = number_.find(lower(insert.block));
    const auto count = known == number_.end() ? polygons_.end() : polygons_.find(known->second);
    if (count == polygons_.end() || count->second == 0 || glm::determinant(glm::dmat3(insert.placement)) == 0)
      continue;
    const DxfBlock& inner = blocks_[known->second];
    const Material own = insert.layer == "0" ? inherited : material_of_name(insert.layer);
    for (uint64_t row = 0; row < insert.rows; ++row)
      for (uint64_t column = 0; column < insert.columns; ++column)
        copy_polygons(inner, shifted(after(placement, insert.copy(row, column)), -inner.base), own, report);
  }
}

}  // namespace veduta
