#include "scene/readers/city_types.h"

namespace veduta {

Kind kind_of_type(std::string_view type) {
  if (type.starts_with("Building")) return Kind::building;
  if (type.starts_with("Bridge")) return Kind::bridge;
  if (type == "TINRelief") return Kind::terrain;
  // TransportSquare is CityJSON's Square; TransportationComplex and Track are CityGML's alone.
  if (type == "Road" || type == "Railway" || type == "TransportSquare" || type == "Square" ||
      type == "Track" || type == "TransportationComplex")
    return Kind::road;
  if (type == "WaterBody" || type == "Waterway") return Kind::water;
  if (type == "PlantCover" || type == "SolitaryVegetationObject") return Kind::vegetation;
  return Kind::other;
}

SurfaceTheme theme_of_surface(std::string_view type) {
  if (type == "ClosureSurface") return {Material::unknown, true};
  if (type == "WallSurface" || type == "InteriorWallSurface") return {Material::wall, false};
  if (type == "Window") return {Material::window, false};
  if (type == "Door") return {Material::door, false};
  if (type == "RoofSurface" || type == "OuterFloorSurface") return {Material::roof, false};
  if (type == "GroundSurface") return {Material::ground, false};
  if (type == "TrafficArea" || type == "AuxiliaryTrafficArea" || type == "TransportationMarking")
    return {Material::road, false};
  if (type.starts_with("Water")) return {Material::water, false};
  return {};
}

}  // namespace veduta
