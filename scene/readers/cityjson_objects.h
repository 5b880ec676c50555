// The city objects of one document and who belongs to whom.
#pragma once

#include <limits>

#include "scene/readers/cityjson_geometry.h"

namespace veduta::cityjson {

constexpr size_t none = std::numeric_limits<size_t>::max();

struct CityObject {
  std::string_view id, type;
  Element element;
  size_t parent = none;
  size_t root = none;  ///< of its parents; itself where there are none
};

/// In the order of the file, roots resolved. Parents that are not there, and circles, are counted in
/// `report`. \throw Error(bad_input) when there are no CityObjects or one has no type
std::vector<CityObject> read_objects(const Element& document, const std::string& file,
                                     const std::string& line, ImportReport& report);

/// "CityObjects/ID"
std::string place_of(const CityObject& object);

}  // namespace veduta::cityjson
