// A city in memory as the painter wants it: its index, its objects as pages, and commands that draw them.
#pragma once

#include <vector>

#include "tests/viewer/memory_source.h"
#include "viewer/draw/command_list.h"
#include "viewer/stream/page.h"

namespace veduta::toy {

inline PvsIndex index_of(const City& city) {
  PvsFile file;
  file.city = city;
  return make_index(file);
}

/// Objects [first, last) as a page.
inline Page page_of(const City& city, uint32_t first, uint32_t last, uint32_t number) {
  return make_page(slice_of(city, first, last), first, number);
}

/// The command that draws a page whole.
inline IndirectCommand whole(const PagePlace& place) {
  return {place.order_stride, 1, place.first_index, place.base_vertex, 0};
}

}  // namespace veduta::toy
