// What the readers of PLY, OFF and STL have in common: building the model and walking through text.
//
// CGAL reads these formats too, but not what may come from anywhere: its PLY reader (5.5) allocates a list
// before it knows that the file can hold it, and passes indices out of range and NaN on without a word; its
// STL reader orders points, NaN among them, in a map. None of them says where a file is damaged.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/raw_model.h"
#include "scene/text.h"

namespace veduta {

/// A place in a file: "line 12", "byte 812".
struct SoupPlace {
  const char* unit = "line";
  uint64_t number = 0;
  std::string text() const { return unit + (" " + std::to_string(number)); }
};

/// Makes the RawModel of read_polygon_soup().
class SoupBuilder {
 public:
  SoupBuilder(const InputFile& file, const std::string& format, ImportReport& report);

  Error error(const SoupPlace& place, const std::string& what) const;
  void drop(const std::string& reason, const SoupPlace& place, uint64_t count = 1);

  /// \throw Error(bad_input) when it is not finite
  void add_vertex(const glm::dvec3& p, const SoupPlace& place);
  /// \param corners indices of vertices as they are in the file
  /// \throw Error(bad_input) for what is no index of a vertex that was added
  void add_polygon(std::span<const double> corners, const SoupPlace& place);
  uint64_t vertex_count() const { return model_.vertices.size(); }

  RawModel take();

 private:
  const InputFile& file_;
  ImportReport& report_;
  RawModel model_;
};

/// Text, line by line and word by word. Comments run from '#' to the end of the line where they are allowed.
class SoupText {
 public:
  SoupText(const SoupBuilder& builder, std::string_view text, uint64_t first_line, bool comments)
      : builder_(builder), rest_(text), next_line_(first_line), comments_(comments) {}

  /// Goes on to the next line that says something. False: there is none.
  bool next_line();
  /// The next word of the line; empty at its end.
  std::string_view word();
  /// The next word of the line, or of the lines after it.
  std::string_view word_anywhere();
  /// \throw Error(bad_input) when the word is not a number
  double number(std::string_view word) const;
  /// A count. \throw Error(bad_input) when the word is none
  uint64_t count(std::string_view word) const;
  SoupPlace place() const { return {"line", line_}; }
  /// What follows the line.
  std::string_view rest() const { return rest_; }

 private:
  const SoupBuilder& builder_;
  std::string_view rest_, words_;
  uint64_t next_line_, line_ = 0;
  bool comments_;
};

RawModel read_ply(const InputFile& file, ImportReport& report);
RawModel read_off(const InputFile& file, ImportReport& report);
RawModel read_stl(const InputFile& file, ImportReport& report);

}  // namespace veduta
