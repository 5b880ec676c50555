#include "scene/readers/dxf.h"

#include <algorithm>
#include <limits>
#include <unordered_map>

#include "scene/names.h"
#include "scene/readers/dxf_blocks.h"
#include "scene/readers/dxf_entities.h"

namespace veduta {
namespace {

class DxfReader {
 public:
  DxfReader(const InputFile& file, const ImportOptions& options, ImportReport& report)
      : file_(file), options_(options), report_(report), groups_(file) {
    model_.file = file.name;
    model_.format = "DXF";
    layer_number("0");
  }

  RawModel read() {
    for (groups_.next(); !groups_.is(0, "EOF");) {
      if (!groups_.is(0, "SECTION")) throw groups_.error("expected a SECTION here; export the file again");
      groups_.next();
      const std::string_view name = groups_.code() == 2 ? groups_.value() : "";
      groups_.next();
      if (name == "HEADER") {
        read_header();
      } else if (name == "BLOCKS") {
        read_blocks();
      } else if (name == "ENTITIES") {
        read_entities();
      }
      while (!groups_.is(0, "ENDSEC")) skip();
      groups_.next();
    }
    model_.unit_m = dxf_unit_m(file_, insunits_, options_);
    make_objects();
    return std::move(model_);
  }

 private:
  // Inside of a section, where the end of the file is a mistake.
  void skip() {
    if (groups_.is(0, "EOF")) throw groups_.error("a section ends without ENDSEC; export the file again");
    groups_.next();
  }

  void read_header() {
    std::string_view variable;
    for (; groups_.code() != 0; groups_.next()) {
      if (groups_.code() == 9) variable = groups_.value();
      if (groups_.code() == 1 && variable == "$ACADVER")
        model_.format = "DXF " + printable(groups_.value(), 20);
      if (groups_.code() == 70 && variable == "$INSUNITS")
        insunits_ = static_cast<int>(std::clamp<int64_t>(groups_.integer(), -1, 1000));
    }
  }

  void read_blocks() {
    constexpr int64_t reference = 4, overlay = 8, depends = 16;
    while (!groups_.is(0, "ENDSEC")) {
      if (!groups_.is(0, "BLOCK")) {
        skip();
        continue;
      }
      const DxfEntity head = read_dxf_entity(groups_);
      DxfBlock block;
      block.name = dxf_name(head.name);
      block.base = head.corner[0];
      block.external = (head.flags() & (reference | overlay | depends)) != 0;
      block.polygon_begin = model_.polygons.size();
      read_surfaces(block.inserts);
      block.polygon_end = model_.polygons.size();
      blocks_.add(std::move(block));
    }
  }

  void read_entities() {
    entities_begin_ = model_.polygons.size();
    read_surfaces(inserts_);
    entities_end_ = model_.polygons.size();
  }

  // Entities up to the end of the block or section.
  void read_surfaces(std::vector<DxfInsert>& inserts) {
    while (!groups_.is(0, "ENDSEC") && !groups_.is(0, "ENDBLK") && !groups_.is(0, "EOF")) {
      const std::string_view type = groups_.value();
      const bool face = type == "3DFACE" || type == "SOLID" || type == "TRACE" || type == "LWPOLYLINE";
      if (groups_.code() != 0 || !(face || type == "POLYLINE" || type == "INSERT")) {
        if (groups_.code() == 0 && type != "SEQEND") drop(type);
        groups_.next();
        continue;
      }
      const std::string place = groups_.place();
      const DxfEntity entity = read_dxf_entity(groups_);
      found_.clear();
      if (type != "INSERT" &&
          !(face ? add_dxf_face(entity, found_) : add_dxf_polyline(entity, groups_, found_)))
        count_dropped(report_, "open DXF " + std::string(type), place);
      if (entity.paper_space) {
        count_dropped(report_, "DXF entity in paper space", place);
      } else if (type == "INSERT") {
        inserts.push_back(read_dxf_insert(entity, groups_));
      } else {
        take(entity);
      }
    }
  }

  void drop(std::string_view type) {
    const bool word = type.size() <= 40 && std::all_of(type.begin(), type.end(), [](unsigned char c) {
                        return c == '_' || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
                      });
    count_dropped(report_, word ? "DXF entity " + std::string(type) : "DXF entity of no known type",
                  groups_.place());
  }

  void take(const DxfEntity& entity) {
    if (model_.vertices.size() + found_.points.size() > std::numeric_limits<uint32_t>::max())
      throw groups_.error("more than 4 billion vertices; cut the model into tiles");
    const uint32_t layer = layer_number(entity.layer);
    const auto first = static_cast<uint32_t>(model_.vertices.size());
    const auto line =
        static_cast<uint32_t>(std::min<uint64_t>(entity.line, std::numeric_limits<uint32_t>::max()));
    model_.vertices.insert(model_.vertices.end(), found_.points.begin(), found_.points.end());
    uint64_t corner = 0;
    for (const uint64_t end : found_.ends) {
      for (; corner < end; ++corner) model_.ring_vertex.push_back(first + found_.corners[corner]);
      model_.ring_end.push_back(model_.ring_vertex.size());
      model_.polygons.push_back({model_.ring_end.size(), line, material_[layer]});
      polygon_layer_.push_back(layer);
    }
  }

  uint32_t layer_number(std::string_view name) {
    const auto [known, added] =
        layer_number_.try_emplace(std::string(name), static_cast<uint32_t>(layers_.size()));
    if (added) {
      layers_.push_back(dxf_name(name));
      material_.push_back(material_of_name(layers_.back()));
    }
    return known->second;
  }

  void make_objects() {
    make_layer_objects();
    const size_t layers = model_.objects.size();
    for (const DxfInsert& insert : inserts_) blocks_.place(insert, report_);
    model_.has_objects = model_.objects.size() != layers || layers != 1 || model_.objects[0].name != "0";
    if (!model_.has_objects) model_.objects[0].name = file_.stem;
  }

  // The polygons of model space, brought together by layer, in the order of the layers' first appearance.
  void make_layer_objects() {
    const auto polygons_of = [&](uint64_t begin, uint64_t end) {
      std::vector<uint64_t> order(end - begin);
      for (uint64_t i = begin; i < end; ++i) order[i - begin] = i;
      std::stable_sort(order.begin(), order.end(),
                       [&](uint64_t a, uint64_t b) { return polygon_layer_[a] < polygon_layer_[b]; });
      return order;
    };
    const std::vector<uint64_t> order = polygons_of(entities_begin_, entities_end_);
    RawModel sorted;
    for (size_t i = 0; i < order.size(); ++i) {
      const uint32_t layer = polygon_layer_[order[i]];
      if (i == 0 || layer != polygon_layer_[order[i - 1]]) start_layer(layer, entities_begin_ + i);
      RawPolygon polygon = model_.polygons[order[i]];
      const uint64_t ring = polygon.ring_end - 1;
      sorted.ring_vertex.insert(
          sorted.ring_vertex.end(),
          model_.ring_vertex.begin() + static_cast<ptrdiff_t>(model_.corners_before(ring)),
          model_.ring_vertex.begin() + static_cast<ptrdiff_t>(model_.ring_end[ring]));
      sorted.ring_end.push_back(sorted.ring_vertex.size());
      if (model_.objects.back().kind != Kind::building) polygon.material = Material::unknown;
      polygon.ring_end = entities_begin_ + i + 1;
      sorted.polygons.push_back(polygon);
      model_.objects.back().patches[0].polygon_end = entities_begin_ + i + 1;
    }
    put_back(sorted);
  }

  void start_layer(uint32_t layer, uint64_t polygon) {
    RawObject object;
    object.name = layers_[layer];
    object.kind = kind_of_name(object.name);
    object.place = file_.name + ": layer " + printable(object.name);
    object.patches.push_back({"", file_.name, polygon, polygon});
    model_.objects.push_back(std::move(object));
  }

  // Polygons of model space have one ring each, and so have those of the blocks: ring and polygon numbers
  // agree.
  void put_back(const RawModel& sorted) {
    const uint64_t first_corner = model_.corners_before(entities_begin_);
    std::copy(sorted.ring_vertex.begin(), sorted.ring_vertex.end(),
              model_.ring_vertex.begin() + static_cast<ptrdiff_t>(first_corner));
    for (size_t i = 0; i < sorted.polygons.size(); ++i) {
      model_.ring_end[entities_begin_ + i] = first_corner + sorted.ring_end[i];
      model_.polygons[entities_begin_ + i] = sorted.polygons[i];
    }
  }

  const InputFile& file_;
  const ImportOptions& options_;
  ImportReport& report_;
  DxfGroups groups_;
  RawModel model_;
  int insunits_ = 0;
  std::unordered_map<std::string, uint32_t> layer_number_;
  std::vector<std::string> layers_;
  std::vector<Material> material_;       // by layer
  std::vector<uint32_t> polygon_layer_;  // of RawModel::polygons
  DxfBlocks blocks_{model_, polygon_layer_};
  std::vector<DxfInsert> inserts_;  // in model space
  uint64_t entities_begin_ = 0, entities_end_ = 0;
  DxfPolygons found_;
};

}  // namespace

RawModel read_dxf(const InputFile& file, const ImportOptions& options, ImportReport& report) {
  return DxfReader(file, options, report).read();
}

}  // namespace veduta
