// The programs of the viewer: the city, and the sky behind it.
#pragma once

#include <string>

namespace veduta {

std::string city_vertex_shader();
std::string city_fragment_shader();
std::string sky_vertex_shader();
std::string sky_fragment_shader();

}  // namespace veduta
