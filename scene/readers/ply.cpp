// PLY (G. Turk, "The PLY Polygon File Format", 1994). The header says which elements follow and what each of
// them consists of; numbers come from text or bytes, and everything above them is one reader.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>

#include "scene/readers/soup_builder.h"

namespace veduta {
namespace {

using std::string_view;

enum class Type { i8, u8, i16, u16, i32, u32, f32, f64 };

std::optional<Type> type_of(string_view name) {
  constexpr std::pair<string_view, Type> table[] = {
      {"char", Type::i8},   {"int8", Type::i8},     {"uchar", Type::u8},   {"uint8", Type::u8},
      {"short", Type::i16}, {"int16", Type::i16},   {"ushort", Type::u16}, {"uint16", Type::u16},
      {"int", Type::i32},   {"int32", Type::i32},   {"uint", Type::u32},   {"uint32", Type::u32},
      {"float", Type::f32}, {"float32", Type::f32}, {"double", Type::f64}, {"float64", Type::f64}};
  for (const auto& [known, type] : table)
    if (name == known) return type;
  return std::nullopt;
}

size_t bytes_of(Type type) {
  constexpr size_t bytes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return bytes[static_cast<size_t>(type)];
}

struct Property {
  std::string name;
  Type type = Type::f32;
  std::optional<Type> count_type;  // of a list
};

struct PlyElement {
  std::string name;
  uint64_t count = 0;
  SoupPlace place;
  std::vector<Property> properties;

  size_t index_of(string_view property) const {
    const auto found = std::find_if(properties.begin(), properties.end(),
                                    [&](const Property& p) { return p.name == property; });
    return static_cast<size_t>(found - properties.begin());
  }
};

/// The numbers after the header.
class Body {
 public:
  Body(SoupBuilder& soup, string_view content, SoupText& text, const std::string& encoding)
      : soup_(soup),
        content_(content),
        at_(content.size() - text.rest().size()),
        text_(text),
        ascii_(encoding == "ascii"),
        swap_((encoding == "binary_big_endian") != (std::endian::native == std::endian::big)) {}

  double next(Type type) {
    if (ascii_) return text_.number(text_.word_anywhere());
    const size_t size = bytes_of(type);
    if (content_.size() - at_ < size) throw soup_.error(place(), "ends here (truncated?); export it again");
    char bytes[8];
    std::memcpy(bytes, content_.data() + at_, size);
    if (swap_) std::reverse(bytes, bytes + size);
    at_ += size;
    switch (type) {
      case Type::i8:
        return as<int8_t>(bytes);
      case Type::u8:
        return as<uint8_t>(bytes);
      case Type::i16:
        return as<int16_t>(bytes);
      case Type::u16:
        return as<uint16_t>(bytes);
      case Type::i32:
        return as<int32_t>(bytes);
      case Type::u32:
        return as<uint32_t>(bytes);
      case Type::f32:
        return static_cast<double>(as<float>(bytes));
      case Type::f64:
        return as<double>(bytes);
    }
    return 0;
  }

  /// At least one byte each: what the header states cannot be more.
  uint64_t most_numbers_left() const { return content_.size() - at_; }
  SoupPlace place() const { return ascii_ ? text_.place() : SoupPlace{"byte", at_}; }
  void report_rest() {
    if (ascii_)
      while (text_.next_line()) soup_.drop("line after the last element", text_.place());
    else
      soup_.drop("bytes after the last element", place(), content_.size() - at_);
  }

 private:
  template <class T>
  static T as(const char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
  }

  SoupBuilder& soup_;
  string_view content_;
  size_t at_;
  SoupText& text_;
  bool ascii_, swap_;
};

class PlyReader {
 public:
  PlyReader(const InputFile& file, ImportReport& report)
      : soup_(file, "PLY", report), content_(file.content()), text_(soup_, content_, 1, false) {}

  RawModel read() {
    read_header();
    Body body(soup_, content_, text_, encoding_);
    for (const PlyElement& element : elements_) read_element(element, body);
    body.report_rest();
    return soup_.take();
  }

 private:
  Error error(const std::string& what) const { return soup_.error(text_.place(), what); }

  void read_header() {
    if (text_.word_anywhere() != "ply") throw error("does not begin with 'ply'");
    while (text_.next_line()) {
      const string_view word = text_.word();
      if (word == "end_header") {
        if (encoding_.empty()) throw error("the header states no format; export it again");
        return;
      }
      if (word == "format") {
        encoding_ = printable(text_.word(), 40);
        const string_view version = text_.word();
        if ((encoding_ != "ascii" && encoding_ != "binary_little_endian" &&
             encoding_ != "binary_big_endian") ||
            version != "1.0")
          throw error("format '" + encoding_ + " " + printable(version, 20) + "' is not read; convert it");
      } else if (word == "element") {
        const std::string name = printable(text_.word(), 40);
        elements_.push_back({name, text_.count(text_.word()), text_.place(), {}});
      } else if (word == "property") {
        read_property();
      } else if (word != "comment" && word != "obj_info") {
        throw error("unknown statement '" + printable(word, 40) + "' in the header; is this a PLY file?");
      }
    }
    throw error("ends in the header (truncated?); export it again");
  }

  void read_property() {
    if (elements_.empty()) throw error("a property before the first element; export it again");
    Property property;
    string_view type = text_.word();
    if (type == "list") {
      property.count_type = type_of(text_.word());
      if (!property.count_type) throw error("a list whose count has no known type; convert it");
      type = text_.word();
    }
    const std::optional<Type> known = type_of(type);
    if (!known) throw error("type '" + printable(type, 40) + "' is not known; convert it");
    property.type = *known;
    property.name = printable(text_.word(), 40);
    elements_.back().properties.push_back(std::move(property));
  }

  void read_element(const PlyElement& element, Body& body) {
    if (element.properties.empty()) return;
    if (element.count > body.most_numbers_left() / element.properties.size())
      throw soup_.error(element.place, "states " + std::to_string(element.count) + " times '" + element.name +
                                           "', more than the file can hold (truncated?); export it again");
    if (element.name == "vertex")
      read_vertices(element, body);
    else
      read_faces(element, body);
  }

  void read_vertices(const PlyElement& element, Body& body) {
    const size_t axes[] = {element.index_of("x"), element.index_of("y"), element.index_of("z")};
    for (const size_t axis : axes)
      if (axis == element.properties.size() || element.properties[axis].count_type)
        throw soup_.error(element.place, "the vertices have no x, y and z; export it again");
    std::vector<double> values(element.properties.size());
    for (uint64_t i = 0; i < element.count; ++i) {
      for (size_t k = 0; k < values.size(); ++k) {
        if (element.properties[k].count_type)
          read_list(element.properties[k], body);
        else
          values[k] = body.next(element.properties[k].type);
      }
      soup_.add_vertex({values[axes[0]], values[axes[1]], values[axes[2]]}, body.place());
    }
  }

  // Elements that are no faces are read to get past them.
  void read_faces(const PlyElement& element, Body& body) {
    size_t corners = element.index_of("vertex_indices");
    if (corners == element.properties.size()) corners = element.index_of("vertex_index");
    const bool faces = element.name == "face" && corners < element.properties.size();
    if (!faces) soup_.drop("unsupported element '" + element.name + "'", element.place, element.count);
    for (uint64_t i = 0; i < element.count; ++i)
      for (size_t k = 0; k < element.properties.size(); ++k) {
        const Property& property = element.properties[k];
        if (!property.count_type) {
          body.next(property.type);
          continue;
        }
        read_list(property, body);
        if (faces && k == corners) soup_.add_polygon(list_, body.place());
      }
  }

  void read_list(const Property& property, Body& body) {
    const double count = body.next(*property.count_type);
    if (!(count >= 0 && count <= static_cast<double>(body.most_numbers_left())) || count != std::floor(count))
      throw soup_.error(body.place(), "a list of " + fmt::format("{}", count) +
                                          " numbers, more than the file can hold; export it again");
    list_.clear();
    for (double k = 0; k < count; ++k) list_.push_back(body.next(property.type));
  }

  SoupBuilder soup_;
  string_view content_;
  SoupText text_;
  std::string encoding_;
  std::vector<PlyElement> elements_;
  std::vector<double> list_;  // the last that was read
};

}  // namespace

RawModel read_ply(const InputFile& file, ImportReport& report) {
  return PlyReader(file, report).read();
}

}  // namespace veduta
