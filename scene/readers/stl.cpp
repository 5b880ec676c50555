// STL: triangles, each with corners of its own. Binary files may begin with "solid" as well, so that the size
// decides.
#include <bit>
#include <cstring>

#include "scene/readers/soup_builder.h"

namespace veduta {
namespace {

constexpr size_t header_bytes = 84, triangle_bytes = 50;
static_assert(std::endian::native == std::endian::little, "binary STL is read as it lies");

template <class T>
T at(std::string_view bytes, size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof(T));
  return value;
}

class StlReader {
 public:
  StlReader(const InputFile& file, ImportReport& report)
      : soup_(file, "STL", report), content_(file.content()) {}

  RawModel read() {
    const uint64_t stated = content_.size() >= header_bytes ? at<uint32_t>(content_, 80) : 0;
    const bool size_of_binary = content_.size() == header_bytes + stated * triangle_bytes;
    const size_t text = content_.find_first_not_of(" \t\r\n");
    const bool starts_as_text = text != content_.npos && content_.substr(text).starts_with("solid");
    if (starts_as_text && !size_of_binary)
      read_text();
    else
      read_binary(stated);
    return soup_.take();
  }

 private:
  void read_binary(uint64_t stated) {
    if (content_.size() < header_bytes)
      throw soup_.error({"byte", content_.size()}, "ends in the header (truncated?); export it again");
    const uint64_t held = (content_.size() - header_bytes) / triangle_bytes;
    if (stated > held)
      throw soup_.error({"byte", 80}, "states " + std::to_string(stated) + " triangles, but the file holds " +
                                          std::to_string(held) + " (truncated, or no STL?); export it again");
    for (uint64_t i = 0; i < stated; ++i) {
      const size_t begin = header_bytes + i * triangle_bytes;
      const SoupPlace place{"byte", begin};
      for (size_t corner = 0; corner < 3; ++corner) {
        glm::dvec3 p(0);
        for (size_t axis = 0; axis < 3; ++axis)
          p[static_cast<int>(axis)] =
              static_cast<double>(at<float>(content_, begin + 12 + 12 * corner + 4 * axis));
        soup_.add_vertex(p, place);
      }
      add_last_vertices(3, place);
    }
    const uint64_t end = header_bytes + stated * triangle_bytes;
    soup_.drop("bytes after the last triangle", {"byte", end}, content_.size() - end);
  }

  void read_text() {
    SoupText text(soup_, content_, 1, false);
    size_t corners = 0;
    bool ended = false;
    while (text.next_line()) {
      const std::string_view word = text.word();
      ended = word == "endsolid";
      if (word == "vertex") {
        glm::dvec3 p(0);
        for (int axis = 0; axis < 3; ++axis) p[axis] = text.number(text.word());
        soup_.add_vertex(p, text.place());
        ++corners;
      } else if (word == "endloop") {
        add_last_vertices(corners, text.place());
        corners = 0;
      } else if (word != "facet" && word != "outer" && word != "endfacet" && word != "solid" && !ended) {
        throw soup_.error(text.place(),
                          "unknown statement '" + printable(word, 40) + "'; is this an STL file?");
      }
    }
    if (!ended || corners > 0)
      throw soup_.error(text.place(), "ends before endsolid (truncated?); export it again");
  }

  void add_last_vertices(size_t count, const SoupPlace& place) {
    corners_.clear();
    for (size_t i = 0; i < count; ++i)
      corners_.push_back(static_cast<double>(soup_.vertex_count() - count + i));
    soup_.add_polygon(corners_, place);
  }

  SoupBuilder soup_;
  std::string_view content_;
  std::vector<double> corners_;
};

}  // namespace

RawModel read_stl(const InputFile& file, ImportReport& report) {
  return StlReader(file, report).read();
}

}  // namespace veduta
