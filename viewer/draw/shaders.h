// The shaders of the painter, as GLSL 4.30.
#pragma once

#include <string>

namespace veduta {

/// Can vertex shaders of this driver choose the layer that they draw to? Then both eyes are one call.
bool layers_from_vertex_shader();

/// The shaders that draw for the eyes: eye `first_eye` + gl_InstanceID; `to_layers`: to the layer of that
/// number.
std::string city_vertex_source(bool to_layers);
std::string material_source();  ///< what the city's vertex shader knows of materials
std::string city_fragment_source();
std::string sky_vertex_source(bool to_layers);
std::string sky_fragment_source();
std::string map_vertex_source(bool to_layers);
std::string map_fragment_source();

/// Boxes and lines in one colour.
std::string triangle_vertex_source();
std::string line_vertex_source();
std::string flat_fragment_source();

/// How wide a row of the map's texture of colours is: object n has texel (n % width, n / width).
inline constexpr unsigned map_colours_width = 4096;

}  // namespace veduta
