// An XML element of a rules file, checked as it is read: numbers, allowed attributes, and the line for
// messages.
#pragma once

#include <initializer_list>
#include <limits>
#include <pugixml.hpp>

#include "scene/city/rules_document.h"
#include "scene/text.h"

namespace veduta::city {

/// A file in memory, its tree, and where its lines begin.
class XmlFile {
 public:
  explicit XmlFile(const std::filesystem::path& path);
  pugi::xml_node root() const;
  Place place(pugi::xml_node node) const;

 private:
  size_t line_of(ptrdiff_t offset) const;

  InputFile input_;
  std::shared_ptr<const std::string> name_;
  std::vector<size_t> line_ends_;
  pugi::xml_document document_;
};

/// One element. Text between elements is a remark, as the thesis's "...".
class XmlElement {
 public:
  XmlElement(const XmlFile& file, pugi::xml_node node) : file_(&file), node_(node) {}

  std::string name() const { return printable(node_.name(), 60); }
  Place place() const { return file_->place(node_); }
  std::vector<XmlElement> children() const;
  bool has(const char* attribute) const { return !node_.attribute(attribute).empty(); }
  std::string text(const char* attribute, const std::string& otherwise = "") const;
  /// A finite number in [least, most]. A unit "m" may follow.
  double number(const char* attribute, double otherwise, double least = 0, double most = 1000) const;
  Attributes attributes() const;
  /// \throw Error(bad_input) for any other attribute
  void allow_only(std::initializer_list<const char*> known) const;
  /// The position of the attribute's value among `known`; 0 when it is absent.
  size_t one_of(const char* attribute, std::initializer_list<const char*> known) const;

 private:
  const XmlFile* file_;
  pugi::xml_node node_;
};

/// "0.5", "0.5m". Empty when `text` is not a finite number.
struct WrittenNumber {
  double value = std::numeric_limits<double>::quiet_NaN();
  bool is_metres = false;
};
WrittenNumber written_number(std::string_view text);

}  // namespace veduta::city
