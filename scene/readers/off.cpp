// OFF (http://www.geomview.org/docs/html/OFF.html): a line a vertex, a line a face. The header's letters say
// which numbers follow the coordinates; how many colours there are, nobody says, so they are read line by
// line.
#include "scene/readers/soup_builder.h"

namespace veduta {
namespace {

class OffReader {
 public:
  OffReader(const InputFile& file, ImportReport& report)
      : soup_(file, "OFF", report), text_(soup_, file.content(), 1, true) {}

  RawModel read() {
    read_header();
    for (uint64_t i = 0; i < vertices_; ++i) {
      next(i, vertices_, "vertices");
      glm::dvec3 p(0);
      for (int axis = 0; axis < 3; ++axis) p[axis] = text_.number(text_.word());
      if (homogeneous_) p /= text_.number(text_.word());
      soup_.add_vertex(p, text_.place());
    }
    for (uint64_t i = 0; i < faces_; ++i) {
      next(i, faces_, "faces");
      read_face();
    }
    while (text_.next_line()) soup_.drop("line after the last face", text_.place());
    return soup_.take();
  }

 private:
  void read_header() {
    std::string_view word = text_.word_anywhere();
    if (word.ends_with("OFF")) {
      for (const char letter : word.substr(0, word.size() - 3)) {
        homogeneous_ = homogeneous_ || letter == '4';
        if (letter != '4' && letter != 'C' && letter != 'N' && letter != 'S' && letter != 'T')
          throw soup_.error(text_.place(), "'" + printable(word, 20) +
                                               "' is not read, but OFF with C, N, ST and 4 is; convert it");
      }
      word = text_.word_anywhere();
      if (word == "BINARY")
        throw soup_.error(text_.place(), "binary OFF is not read; convert it to PLY or to text");
    }
    vertices_ = text_.count(word);
    faces_ = text_.count(text_.word_anywhere());
    text_.word();  // edges; nobody counts them
  }

  void next(uint64_t found, uint64_t stated, const char* what) {
    if (!text_.next_line())
      throw soup_.error(text_.place(), "ends after " + std::to_string(found) + " of " +
                                           std::to_string(stated) + " " + what +
                                           " (truncated?); export it again");
  }

  // "3 0 1 2", and a colour that is passed over.
  void read_face() {
    const uint64_t corners = text_.count(text_.word());
    corners_.clear();
    for (uint64_t k = 0; k < corners; ++k) corners_.push_back(text_.number(text_.word()));
    soup_.add_polygon(corners_, text_.place());
  }

  SoupBuilder soup_;
  SoupText text_;
  bool homogeneous_ = false;
  uint64_t vertices_ = 0, faces_ = 0;
  std::vector<double> corners_;
};

}  // namespace

RawModel read_off(const InputFile& file, ImportReport& report) {
  return OffReader(file, report).read();
}

}  // namespace veduta
