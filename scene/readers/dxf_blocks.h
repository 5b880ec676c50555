// Blocks of a DXF file and where they are inserted: nested ones are taken into the block around them, so that
// what is left is one placement for each insert in model space.
#pragma once

#include <glm/mat4x3.hpp>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "scene/raw_model.h"
#include "scene/readers/dxf_entities.h"

namespace veduta {

/// An INSERT, still by the name of its block.
struct DxfInsert {
  std::string block, layer, handle;
  uint64_t line = 0;
  glm::dmat4x3 placement{1};  ///< of the first copy, the base point of the block not yet taken off
  glm::dvec3 column_step{0}, row_step{0};
  uint64_t columns = 1, rows = 1;

  glm::dmat4x3 copy(uint64_t row, uint64_t column) const;
};

/// \throw Error(bad_input) for a negative or absurd number of copies
DxfInsert read_dxf_insert(const DxfEntity& entity, const DxfGroups& groups);

/// a after b: p -> a * (b * p).
glm::dmat4x3 after(const glm::dmat4x3& a, const glm::dmat4x3& b);

struct DxfBlock {
  std::string name;
  glm::dvec3 base{0};
  bool external = false;    ///< its content is in another file
  bool on_layer_0 = false;  ///< some of its polygons; set by DxfBlocks::add
  uint64_t polygon_begin = 0, polygon_end = 0;
  int levels = 0;  ///< of blocks in blocks below it; set as its polygons are counted
  std::vector<DxfInsert> inserts;
};

class DxfBlocks {
 public:
  /// `model` holds the polygons of the blocks, each with its layer's number in `layers`; it grows by copies.
  DxfBlocks(RawModel& model, std::vector<uint32_t>& polygon_layer)
      : model_(model), polygon_layer_(polygon_layer) {}

  void add(DxfBlock block);

  /// The objects of an insert in model space: one for each copy. Their place is "FILE: line N".
  /// \throw Error(bad_input) for a block inside itself, or more copies than memory is meant to hold
  void place(const DxfInsert& insert, ImportReport& report);

 private:
  struct Range {
    uint64_t begin = 0, end = 0;
  };
  using Key = std::pair<size_t, Material>;  // a block, and the material of what is on layer 0 in it

  const DxfBlock* find(const DxfInsert& insert, ImportReport& report) const;
  uint64_t polygons_of(const DxfBlock& block, const DxfInsert& insert, ImportReport& report, int depth);
  const Range& whole(const DxfBlock& block, Material inherited, ImportReport& report);
  void copy_polygons(const DxfBlock& block, const glm::dmat4x3& placement, Material inherited,
                     ImportReport& report);
  Error error(const DxfInsert& insert, const std::string& what) const;
  std::string place_of(const DxfInsert& insert) const;

  RawModel& model_;
  std::vector<uint32_t>& polygon_layer_;
  std::vector<DxfBlock> blocks_;
  std::unordered_map<std::string, size_t> number_;  // by lower-case name
  std::unordered_map<size_t, uint64_t> polygons_;   // with the nested ones; `unfinished` while being counted
  std::map<Key, Range> whole_;
  uint64_t copied_ = 0;
};

}  // namespace veduta
