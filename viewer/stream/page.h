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
  Box bounds;  ///< empty where there are no triangles
};

/// How large a page should be. A file's objects follow each other in no order of space, so most of what a
/// large page holds is not what a row lists: in Linz, rows of 8,300 triangles lie in pages of 15,000, 26,000,
/// 46,000, 77,000 or 207,000 when those have 256, 512, 1024, 2048 or 16,384. Reading in the order of the file
/// takes 2 to 3 ms/MB whichever it is. 512 triangles are about 40 kB. Commands are one or two for each
/// object, however large the pages are.
inline constexpr uint64_t triangles_per_page = 512;

/// Cuts the objects of a file into pages of at most this many triangles; an object with more is a page.
/// Every object is in one page, the pages are in the order of their objects.
std::vector<PageSpan> make_pages(const PvsIndex& index, uint64_t most_triangles = triangles_per_page);

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
  /// With what is looked up.
  uint64_t bytes() const { return gpu_bytes() + ranges.bytes(); }
};

/// As many bytes as a page with these triangles takes at most on the GPU.
constexpr uint64_t most_gpu_bytes(uint64_t triangles) {
  return triangles * 3 * (sizeof(MeshVertex) + order_count * sizeof(uint32_t));
}

/// A page of its objects: what PvsStream::read_objects gives for the span. Sorts the triangles.
Page make_page(const City& objects, uint32_t first_object, uint32_t number);

/// Reads a page and sorts its triangles. \throw Error(bad_input) when the file is damaged.
Page read_page(const PvsStream& stream, const std::vector<PageSpan>& pages, uint32_t number);

/// Where a page lies in the buffers of the GPU.
struct PagePlace {
  uint32_t first_index = 0;   ///< of its first order, in the element buffer
  uint32_t order_stride = 0;  ///< indices from one order to the next: 3T
  int32_t base_vertex = 0;
};

}  // namespace veduta
