#include "viewer/draw/composer_shaders.h"

namespace veduta {
namespace {

// Shared by the fragment shaders.
const std::string reading = R"(#version 430 core
uniform sampler2DArray pictures;  // read as they are stored
uniform vec2 texel;               // 1 / size of a picture
uniform int layer;                // of the picture, or of the left one
out vec4 shown;

vec3 stored(ivec2 p, int from) { return texture(pictures, vec3((vec2(p) + 0.5) * texel, from)).rgb; }
)";

const std::string light = R"(
// Not by the sampler: some round so far in the dark that Dubois's differences are three steps off.
vec3 linear(ivec2 p, int from) {
  vec3 v = stored(p, from);
  return mix(pow((v + 0.055) / 1.055, vec3(2.4)), v / 12.92, lessThanEqual(v, vec3(0.04045)));
}
vec3 encoded(vec3 v) {
  v = clamp(v, 0.0, 1.0);
  return mix(1.055 * pow(v, vec3(1.0 / 2.4)) - 0.055, 12.92 * v, lessThanEqual(v, vec3(0.0031308)));
}
)";

}  // namespace

std::string composer_vertex_shader() {
  return R"(#version 430 core
void main() {  // one triangle over the whole viewport
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
)";
}

std::string squeeze_shader() {
  return reading + light + R"(
uniform ivec2 origin, squeeze;  // of the rectangle; pixels of the picture for one that is shown
uniform int first_row;          // of the picture, from below
void main() {
  ivec2 p = squeeze * (ivec2(gl_FragCoord.xy) - origin) + ivec2(0, first_row);
  shown = vec4(encoded(0.5 * (linear(p, layer) + linear(p + squeeze - 1, layer))), 1.0);
}
)";
}

// From the right eye's picture: pixels in odd columns, rows or both, and some of the colours.
std::string mix_shader() {
  return reading + R"(
uniform ivec2 first;    // column and row of the screen at gl_FragCoord's 0, modulo 2
uniform ivec2 counted;  // 1: columns, rows
uniform bvec3 from_right;
void main() {
  ivec2 p = ivec2(gl_FragCoord.xy);
  ivec2 odd = (p + first) & counted;
  bvec3 right = notEqual(from_right, bvec3(odd.x != odd.y));
  shown = vec4(mix(stored(p, layer), stored(p, 1 - layer), right), 1.0);
}
)";
}

// E. Dubois, "A projection method to generate anaglyph stereo images", ICASSP 2001: the published
// least-squares matrices for red-cyan glasses, applied to linear light.
std::string dubois_shader() {
  return reading + light + R"(
const mat3 of_left = mat3(0.4561000, -0.0400822, -0.0152161,  // a column for each of the picture's colours
                          0.5004840, -0.0378246, -0.0205971,
                          0.1763810, -0.0157589, -0.00546856);
const mat3 of_right = mat3(-0.0434706, 0.3784760, -0.0721527,
                           -0.0879388, 0.7336400, -0.1129610,
                           -0.00155529, -0.0184503, 1.2264000);
void main() {
  ivec2 p = ivec2(gl_FragCoord.xy);
  shown = vec4(encoded(of_left * linear(p, layer) + of_right * linear(p, 1 - layer)), 1.0);
}
)";
}

}  // namespace veduta
