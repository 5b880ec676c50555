// Pages: runs of whole objects, as they are read from the file, kept, and put on the GPU.
#pragma once

#include <cstdint>
#include <vector>

#include "pvs/index_ranges.h"
#include "pvs/pvs_stream.h"
#include "scene/box.h"
#include "viewer/mesh.h"

namespace veduta {

/// Objects [first_object, last_object) of the file.
struct PageSpan {
  uint32_t first_object = 0, last_object = 0;
  uint64_t triangles = 0;
  Box bounds;
};

/// Cuts the objects of a file into pages of about `triangles_per_page`; an object with more is a page.
std::vector<PageSpan> make_pages(const PvsIndex& index, uint64_t triangles_per_page);

/// A page as the GPU wants it, and what is looked up in it for each frame.
struct Page {
  uint32_t number = 0;               ///< index of its PageSpan
  std::vector<MeshVertex> vertices;  ///< [V]
  std::vector<uint32_t> elements;  ///< [order_count * 3T] the five orders, one after the other; into vertices
  SliceRanges ranges;              ///< of object first_object + i under number i
  uint64_t triangles = 0;          ///< T

  uint64_t gpu_bytes() const {
    return vertices.size() * sizeof(MeshVertex) + elements.size() * sizeof(uint32_t);
  }
};

/// Reads a page and sorts its triangles. \throw Error(bad_input) when the file is damaged.
Page read_page(const PvsStream& stream, const std::vector<PageSpan>& pages, uint32_t number);

/// Where a page lies in the buffers of the GPU.
struct PagePlace {
  uint32_t first_index = 0;   ///< of its first order, in the element buffer
  uint32_t order_stride = 0;  ///< indices from one order to the next: 3T
  int32_t base_vertex = 0;
};

}  // namespace veduta
