#include "viewer/stream/page.h"

namespace veduta {

std::vector<PageSpan> make_pages(const PvsIndex& index, uint64_t most_triangles) {
  std::vector<PageSpan> pages;
  for (uint32_t o = 0; o < index.objects.size(); ++o) {
    const uint64_t triangles = index.objects[o].triangle_end - index.objects[o].triangle_begin;
    const bool full = triangles > 0 && !pages.empty() && pages.back().triangles > 0 &&
                      pages.back().triangles + triangles > most_triangles;
    if (pages.empty() || full) pages.push_back({o, o, 0, {}});
    PageSpan& page = pages.back();
    page.last_object = o + 1;
    page.triangles += triangles;
    page.bounds.extend(index.bounds[o]);
  }
  return pages;
}

Page make_page(const City& objects, uint32_t first_object, uint32_t number) {
  Page page;
  page.number = number;
  page.triangles = objects.scene.triangles.size();
  page.ranges = SliceRanges(objects);
  Mesh mesh = make_mesh(objects.scene, first_object);
  page.elements.reserve(order_count * 3 * page.triangles);
  for (const std::vector<uint32_t>& order : triangle_orders(objects))
    for (uint32_t t : order) {
      const glm::uvec3& corners = mesh.corners[t];
      page.elements.insert(page.elements.end(), {corners.x, corners.y, corners.z});
    }
  page.vertices = std::move(mesh.vertices);
  page.vertices.shrink_to_fit();  // what is kept is what is counted
  return page;
}

Page read_page(const PvsStream& stream, const std::vector<PageSpan>& pages, uint32_t number) {
  const PageSpan& span = pages[number];
  return make_page(stream.read_objects(span.first_object, span.last_object), span.first_object, number);
}

}  // namespace veduta
