#include "scene/readers/cityjson_geometry.h"

#include <cmath>
#include <limits>

#include "scene/readers/city_types.h"
#include "scene/text.h"

namespace veduta::cityjson {
namespace {

using Array = simdjson::dom::array;
using std::string_view;

class Boundaries {
 public:
  Boundaries(const std::string& place, VertexSource& vertices, RawModel& model, ImportReport& report)
      : place_(place), vertices_(vertices), model_(model), report_(report) {}

  void read(const Element& geometry, int levels) {
    Element semantics, values;
    if (geometry["semantics"].get(semantics) == simdjson::SUCCESS) {
      read_semantics(semantics);
      if (semantics["values"].get(values) == simdjson::SUCCESS) has_values_ = true;
    }
    descend(array_at(geometry, "boundaries", model_.file, place_), levels, has_values_ ? &values : nullptr);
  }

 private:
  void read_semantics(const Element& semantics) {
    Array surfaces;
    if (semantics["surfaces"].get(surfaces) != simdjson::SUCCESS) return;
    for (const Element surface : surfaces) {
      string_view type;
      if (surface["type"].get(type) != simdjson::SUCCESS) type = "";
      semantics_.push_back(theme_of_surface(type));
    }
  }

  // Boundaries and semantic values side by side: values nest like the boundaries down to the surfaces, and
  // any of them may be null. `levels` is three at most, so this cannot run deep.
  void descend(const Array& boundaries, int levels, const Element* values) {
    std::optional<Array::iterator> value, values_end;
    if (Array array; values != nullptr && values->get(array) == simdjson::SUCCESS) {
      value = array.begin();
      values_end = array.end();
    } else if (values != nullptr && !values->is_null()) {
      mismatch();
    }
    path_.push_back(0);
    for (const Element child : boundaries) {
      const std::optional<Element> child_value =
          value && *value != *values_end ? std::optional<Element>(**value) : std::nullopt;
      if (levels == 0)
        surface(array_of(child), child_value ? &*child_value : nullptr);
      else
        descend(array_of(child), levels - 1, child_value ? &*child_value : nullptr);
      if (child_value) ++*value;
      ++path_.back();
    }
    path_.pop_back();
  }

  void surface(const Array& rings, const Element* value) {
    SurfaceTheme semantic;
    if (value != nullptr && !value->is_null()) {
      uint64_t index = 0;
      if (value->get(index) == simdjson::SUCCESS && index < semantics_.size())
        semantic = semantics_[index];
      else
        mismatch();
    }
    if (semantic.opening) {
      count_dropped(report_, "ClosureSurface, which stands for an opening", model_.file + ": " + path());
      return;
    }
    const size_t rings_before = model_.ring_end.size();
    for (const Element ring : rings) {
      path_.push_back(static_cast<uint32_t>(model_.ring_end.size() - rings_before));
      for (const Element index : array_of(ring)) model_.ring_vertex.push_back(vertex(index));
      model_.ring_end.push_back(model_.ring_vertex.size());
      path_.pop_back();
    }
    if (model_.ring_end.size() == rings_before) {
      count_dropped(report_, "degenerate polygon", model_.file + ": " + path());
      return;
    }
    model_.polygons.push_back({model_.ring_end.size(), 0, semantic.material});
  }

  uint32_t vertex(const Element& element) {
    uint64_t index = 0;
    if (element.get(index) != simdjson::SUCCESS) {
      throw error(
          "holds something other than a vertex index (0, 1, ...); check the boundaries' nesting and the "
          "export");
    }
    if (index >= vertices_.count())
      throw error("vertex index " + std::to_string(index) + " is not below " +
                  std::to_string(vertices_.count()) + ", the number of vertices; check the export");
    const std::optional<uint32_t> found = vertices_.at(index);
    if (!found)
      throw error("vertex " + std::to_string(index) +
                  " is not finite once it is placed; check transformationMatrix");
    return *found;
  }

  Array array_of(const Element& element) const {
    Array array;
    if (element.get(array) != simdjson::SUCCESS)
      throw error("is not an array; the boundaries do not nest as the geometry's type asks");
    return array;
  }

  void mismatch() {
    count_dropped(report_, "semantics that do not fit the boundaries", model_.file + ": " + path());
  }

  std::string path() const {
    std::string text = place_ + "/boundaries";
    for (const uint32_t step : path_) text += "/" + std::to_string(step);
    return text;
  }

  Error error(const std::string& what) const { return bad_input(model_.file, path(), what); }

  const std::string& place_;
  VertexSource& vertices_;
  RawModel& model_;
  ImportReport& report_;
  std::vector<SurfaceTheme> semantics_;
  std::vector<uint32_t> path_;
  bool has_values_ = false;
};

}  // namespace

std::optional<uint32_t> VertexSource::at(uint64_t index) {
  if (templates_ == nullptr) return static_cast<uint32_t>(first_ + index);
  const auto [known, added] = placed_.try_emplace(index, static_cast<uint32_t>(model_.vertices.size()));
  if (added) {
    const glm::dvec3& v = (*templates_)[index];
    glm::dvec3 p = anchor_;
    for (int row = 0; row < 3; ++row) {
      const double* m = &matrix_[static_cast<size_t>(4 * row)];
      p[row] += m[0] * v.x + m[1] * v.y + m[2] * v.z + m[3];
    }
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return std::nullopt;
    model_.vertices.push_back(p);
  }
  return known->second;
}

std::optional<int> levels_above_surfaces(string_view type) {
  if (type == "MultiSurface" || type == "CompositeSurface") return 0;
  if (type == "Solid") return 1;
  if (type == "MultiSolid" || type == "CompositeSolid") return 2;
  return std::nullopt;
}

void read_boundaries(const Element& geometry, int levels, const std::string& place, VertexSource& vertices,
                     RawModel& model, ImportReport& report) {
  Boundaries(place, vertices, model, report).read(geometry, levels);
}

Array array_at(const Element& parent, string_view key, const std::string& file, const std::string& place) {
  Array array;
  if (parent[key].get(array) != simdjson::SUCCESS)
    throw bad_input(
        file,
        place.empty() || place.back() == ' ' ? place + std::string(key) : place + "/" + std::string(key),
        "is missing or not an array; check the export");
  return array;
}

}  // namespace veduta::cityjson
