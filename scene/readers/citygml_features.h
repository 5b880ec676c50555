// The city objects of a CityGML file: which features make one object, and which geometries each of them
// shows.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/import.h"
#include "scene/readers/citygml_document.h"

namespace pugi {
struct xml_node_struct;
}

namespace veduta::citygml {

/// A property like lod2Solid, lod2MultiSurface, lod2ImplicitRepresentation or tin. Has surfaces.
struct Geometry {
  pugi::xml_node_struct* node = nullptr;
  int lod = -1;            ///< -1: not stated
  bool implicit = false;   ///< holds an ImplicitGeometry
  std::string_view theme;  ///< of the thematic surface that it belongs to: "WallSurface"; else empty

  pugi::xml_node property() const;
};

/// A Building, BuildingPart, ...
struct Feature {
  std::string_view type;
  std::string part;   ///< its name as a part; empty for the object's own
  std::string place;  ///< "city.gml: BuildingPart ID"
  std::vector<Geometry> geometries;
};

struct CityObject {
  std::string name;  ///< gml:id, else gml:name, else empty
  Kind kind = Kind::other;
  std::string place;
  std::vector<Feature> features;  ///< its own first
};

/// In the order of the file. Geometries are those of each feature's highest level of detail; a level below 2
/// of an object that its ...Parts better is left out. What is left out is counted in `report`.
std::vector<CityObject> read_city_objects(const Document& document, const std::string& file,
                                          ImportReport& report);

}  // namespace veduta::citygml
