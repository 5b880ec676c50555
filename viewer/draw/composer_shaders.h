// The GLSL of the composer. One fragment shader for each way to show: software renderers run all branches.
#pragma once

#include <string>

namespace veduta {

std::string composer_vertex_shader();  ///< one triangle over the viewport
std::string squeeze_shader();          ///< one picture, the mean of two pixels for each
std::string mix_shader();              ///< interlaced, checkerboard and anaglyph pairs
std::string dubois_shader();

}  // namespace veduta
