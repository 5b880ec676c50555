// A CityGML file as a tree of XML with plain names.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "scene/text.h"

namespace pugi {
class xml_node;
}

namespace veduta::citygml {

/// After loading, elements of GML and CityGML have their local names ("Building", whatever the prefix),
/// gml:id is "id" and xlink:href is "href"; elements of other namespaces are called "?" or keep a colon.
/// No element lies deeper than 1,000, so that walks over the tree may recurse.
class Document {
 public:
  /// \throw Error(bad_input) for what is not well-formed, too deep, or not CityGML 1.0 or 2.0
  explicit Document(const InputFile& file);
  ~Document();

  const std::string& version() const { return version_; }  ///< "1.0", "2.0"
  /// The values of srsName, each once, in the order of the file.
  const std::vector<std::string>& srs_names() const { return srs_names_; }
  uint64_t size() const { return elements_; }  ///< elements

  pugi::xml_node root() const;
  /// The element of "#id"; an empty node when there is none in this file.
  pugi::xml_node find(std::string_view href) const;
  uint32_t line(const pugi::xml_node& node) const;

 private:
  struct Tree;
  class Normaliser;
  std::unique_ptr<Tree> tree_;
  std::string version_;
  std::vector<std::string> srs_names_;
  uint64_t elements_ = 0;
};

/// Whether the element is one of GML or CityGML.
bool is_known(const pugi::xml_node& node);

}  // namespace veduta::citygml
