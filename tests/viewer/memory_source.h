// A city in memory as a stream's source, and a long street that is larger than a budget.
#pragma once

#include <unordered_map>
#include <utility>

#include "pvs/pvs_file.h"
#include "tests/viewer/toy_city.h"
#include "viewer/stream/city_source.h"
#include "viewer/stream/gaze.h"

namespace veduta::toy {

/// What PvsStream says of the same file.
inline PvsIndex make_index(const PvsFile& file) {
  PvsIndex index;
  const Scene& scene = file.city.scene;
  index.header = file.header;
  index.crs = scene.crs;
  index.origin = scene.origin;
  index.content_digest = file.content_digest;
  index.objects = scene.objects;
  for (size_t o = 0; o < scene.objects.size(); ++o) index.bounds.push_back(scene.bounds(o));
  index.slices = file.city.slices;
  index.cells = file.city.cells;
  index.grid = CellGrid(index.cells);
  index.cell_row = file.cell_row;
  index.cell_status = file.cell_status;
  index.bake_us = file.bake_us;
  index.overestimate = file.overestimate;
  index.row_begin = file.row_begin;
  index.navigation = file.city.navigation;
  index.verification = file.verification;
  return index;
}

/// Objects [first, last) of a city as a city of their own: what PvsStream::read_objects gives.
inline City slice_of(const City& city, uint32_t first, uint32_t last) {
  City slice;
  std::unordered_map<uint32_t, uint32_t> vertices;
  for (uint32_t o = first; o < last; ++o) {
    Object object = city.scene.objects[o];
    const auto [begin, end] = std::pair(object.triangle_begin, object.triangle_end);
    object.triangle_begin = slice.scene.triangles.size();
    for (uint64_t t = begin; t < end; ++t) {
      glm::uvec3 corners = city.scene.triangles[t];
      for (int i = 0; i < 3; ++i) {
        const auto [place, fresh] =
            vertices.try_emplace(corners[i], static_cast<uint32_t>(slice.scene.vertices.size()));
        if (fresh) slice.scene.vertices.push_back(city.scene.vertices[corners[i]]);
        corners[i] = place->second;
      }
      slice.scene.triangles.push_back(corners);
      slice.scene.material.push_back(city.scene.material[t]);
      slice.triangle_slices.push_back(city.triangle_slices[t]);
    }
    object.triangle_end = slice.scene.triangles.size();
    slice.scene.objects.push_back(object);
    slice.slices.push_back(city.slices[o]);
  }
  return slice;
}

class MemorySource : public CitySource {
 public:
  explicit MemorySource(PvsFile file) : file_(std::move(file)), index_(make_index(file_)) {}
  const PvsIndex& index() const override { return index_; }
  PvsRow read_row(uint32_t row) const override {
    const auto at = [&](uint64_t k) { return file_.entries.begin() + static_cast<ptrdiff_t>(k); };
    return {at(file_.row_begin[row]), at(file_.row_begin[row + 1])};
  }
  City read_objects(uint32_t first, uint32_t last) const override {
    return slice_of(file_.city, first, last);
  }

 private:
  PvsFile file_;
  PvsIndex index_;
};

/// Houses of 100 floors (802 triangles: a page each) every 10 m along x, and cells of 10 m before them: cell
/// c is x in [10c, 10c + 10]. Its row lists houses c-2 to c+2, and the first house, which is far from most.
inline PvsFile long_street(uint32_t houses) {
  PvsFile file;
  for (uint32_t i = 0; i < houses; ++i) {
    const float x = 10.0f * static_cast<float>(i);
    add_box(file.city, "house " + std::to_string(i), {{x + 1, 5, 0}, {x + 9, 15, 100}}, 100);
  }
  file.row_begin = {0};
  for (uint32_t c = 0; c < houses; ++c) {
    const float x = 10.0f * static_cast<float>(c);
    file.city.cells.push_back({{x, -5, 1}, {x + 10, 5, 2}});
    file.cell_row.push_back(c);
    file.cell_status.push_back(CellStatus::baked);
    file.bake_us.push_back(1);
    file.overestimate.push_back(0);
    for (uint32_t o = 0; o < houses; ++o)
      if (o == 0 || (o + 2 >= c && o <= c + 2)) file.entries.push_back({o, completely_visible});
    file.row_begin.push_back(file.entries.size());
  }
  return file;
}

/// The middle of a cell of the street, as an eye that stands there.
inline Gaze standing_in(uint32_t cell) {
  Gaze gaze;
  gaze.position_m = {10.0f * static_cast<float>(cell) + 5, 0, 1.5f};
  return gaze;
}

}  // namespace veduta::toy
