// A city in memory as the painter wants it: its index, its objects as pages, and commands that draw them.
#pragma once

#include <vector>

#include "viewer/draw/command_list.h"
#include "viewer/stream/page.h"

namespace veduta::toy {

inline PvsIndex index_of(const City& city) {
  PvsIndex index;
  index.objects = city.scene.objects;
  for (size_t o = 0; o < city.scene.objects.size(); ++o) index.bounds.push_back(city.scene.bounds(o));
  index.slices = city.slices;
  index.cells = city.cells;
  return index;
}

/// Objects [first, last) as a city of their own.
inline City piece_of(const City& city, uint32_t first, uint32_t last) {
  City piece;
  piece.scene.vertices = city.scene.vertices;
  for (uint32_t o = first; o < last; ++o) {
    Object object = city.scene.objects[o];
    for (uint64_t t = object.triangle_begin; t < object.triangle_end; ++t) {
      piece.scene.triangles.push_back(city.scene.triangles[t]);
      piece.scene.material.push_back(city.scene.material[t]);
      piece.triangle_slices.push_back(city.triangle_slices[t]);
    }
    object.triangle_begin = piece.scene.objects.empty() ? 0 : piece.scene.objects.back().triangle_end;
    object.triangle_end = piece.scene.triangles.size();
    piece.scene.objects.push_back(object);
    piece.slices.push_back(city.slices[o]);
  }
  return piece;
}

/// Objects [first, last) as a page.
inline Page page_of(const City& city, uint32_t first, uint32_t last, uint32_t number) {
  return make_page(piece_of(city, first, last), first, number);
}

/// The command that draws a page whole.
inline IndirectCommand whole(const PagePlace& place) {
  return {place.order_stride, 1, place.first_index, place.base_vertex, 0};
}

}  // namespace veduta::toy
