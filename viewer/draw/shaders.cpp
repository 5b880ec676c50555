// The vertex shaders, and the small fragment shaders.
#include "viewer/draw/shaders.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

namespace veduta {
namespace {

// The eye that an instance is for, and its layer.
std::string eye_head(bool to_layers) {
  if (!to_layers) return "#version 430 core\n#define to_layer(eye)\n";
  return R"(#version 430 core
#extension GL_ARB_shader_viewport_layer_array : enable
#extension GL_AMD_vertex_shader_layer : enable
#define to_layer(eye) gl_Layer = eye
)";
}

}  // namespace

bool layers_from_vertex_shader() {
  return epoxy_has_gl_extension("GL_ARB_shader_viewport_layer_array") ||
         epoxy_has_gl_extension("GL_AMD_vertex_shader_layer");
}

std::string city_vertex_source(bool to_layers) {
  return eye_head(to_layers) + material_source() + R"(
layout(location = 0) in vec3 position_m;
layout(location = 1) in uvec2 material_tint;
layout(location = 2) in float height_cm;
uniform int first_eye;
uniform vec3 eye_m[2];
uniform mat4 clip_from_offset[2];
out vec3 offset_m;               // from the eye: keeps the precision of what is near
out float height_m;
flat out vec3 eye_at_m;
flat out vec3 plain, pattern;
flat out vec2 special;
void main() {
  int eye = first_eye + gl_InstanceID;
  offset_m = position_m - eye_m[eye];
  height_m = height_cm * 0.01;
  eye_at_m = eye_m[eye];
  look_up(material_tint.x, material_tint.y, plain, pattern, special);
  gl_Position = clip_from_offset[eye] * vec4(offset_m, 1.0);
  to_layer(eye);
}
)";
}

std::string sky_vertex_source(bool to_layers) {
  return eye_head(to_layers) + R"(
uniform int first_eye;
uniform mat3 offset_from_screen[2];  // (x, y, 1) of clip space to a direction in the world
out vec3 direction;
void main() {
  int eye = first_eye + gl_InstanceID;
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  direction = offset_from_screen[eye] * vec3(corner, 1.0);
  gl_Position = vec4(corner, 0.0, 1.0);  // depth 0: at infinity
  to_layer(eye);
}
)";
}

std::string map_vertex_source(bool to_layers) {
  return eye_head(to_layers) + fmt::format("const uint colours_width = {}u;\n", map_colours_width) + R"(
layout(location = 0) in vec3 position_m;
layout(location = 1) in uvec2 material_tint;
layout(location = 2) in float height_cm;
layout(location = 3) in uint object;
uniform int first_eye;
uniform vec3 centre_m;
uniform mat4 clip_from_offset;
uniform usampler2D colours;
out vec3 offset_m;
flat out uvec2 kind;  // material, MapColour
out float height_m;
void main() {
  uint colour = texelFetch(colours, ivec2(object % colours_width, object / colours_width), 0).r;
  offset_m = position_m - centre_m;
  kind = uvec2(material_tint.x, colour);
  height_m = height_cm * 0.01;
  gl_Position = clip_from_offset * vec4(offset_m, 1.0);
  if (colour == 0u) gl_Position = vec4(0.0, 0.0, -1.0, 1.0);  // hidden: beyond the near plane
  to_layer(first_eye + gl_InstanceID);
}
)";
}

std::string map_fragment_source() {
  return R"(#version 430 core
in vec3 offset_m;
in float height_m;
flat in uvec2 kind;
layout(location = 0) out vec4 colour;

vec3 ground() {
  if (kind.x == 5u) return vec3(0.30, 0.30, 0.31);   // road
  if (kind.x == 6u) return vec3(0.26, 0.38, 0.44);   // water
  if (kind.x == 7u) return vec3(0.36, 0.42, 0.31);   // vegetation
  return vec3(0.47, 0.47, 0.43);
}

void main() {
  vec3 across = cross(dFdx(offset_m), dFdy(offset_m));
  vec3 normal = length(across) > 0.0 ? normalize(across) : vec3(0.0, 0.0, 1.0);
  if (normal.z < 0.0) normal = -normal;
  // Level roofs are brighter the higher they are; pitched ones are lit from the side.
  float light = 0.72 + 0.28 * dot(normal, normalize(vec3(-0.6, 0.5, 0.6))) / 0.6;
  light *= height_m > 600.0 ? 1.0 : mix(0.75, 1.1, smoothstep(0.0, 40.0, height_m));
  vec3 plain = kind.y == 1u ? vec3(0.62, 0.05, 0.04)     // completely visible
               : kind.y == 2u ? vec3(0.05, 0.14, 0.66)   // partially visible
               : kind.y == 3u ? vec3(0.75, 0.58, 0.06)   // invisible
                              : ground();
  colour = vec4(plain * light, 1.0);
}
)";
}

std::string triangle_vertex_source() {
  return R"(#version 430 core
layout(location = 0) in vec3 position_m;
layout(location = 1) in vec4 corner_colour;
uniform vec3 eye_m;
uniform mat4 clip_from_offset;
flat out vec4 flat_colour;
void main() {
  flat_colour = corner_colour;
  gl_Position = clip_from_offset * vec4(position_m - eye_m, 1.0);
  gl_Position.z *= 1.001;  // before the wall that it lies on
}
)";
}

// A line is a rectangle of the screen: GL need not draw lines wider than a pixel.
std::string line_vertex_source() {
  return R"(#version 430 core
layout(location = 0) in vec3 from_m;
layout(location = 1) in vec3 to_m;
layout(location = 2) in vec4 line_colour;
uniform vec3 eye_m;
uniform mat4 clip_from_offset;
uniform vec2 size_px;
uniform float width_px, nearest_w;
flat out vec4 flat_colour;
void main() {
  flat_colour = line_colour;
  vec4 from = clip_from_offset * vec4(from_m - eye_m, 1.0), to = clip_from_offset * vec4(to_m - eye_m, 1.0);
  if (max(from.w, to.w) <= nearest_w) {
    gl_Position = vec4(0.0, 0.0, -1.0, 1.0);
    return;
  }
  if (from.w < nearest_w) from = mix(from, to, (nearest_w - from.w) / (to.w - from.w));
  if (to.w < nearest_w) to = mix(to, from, (nearest_w - to.w) / (from.w - to.w));
  vec2 along = (to.xy / to.w - from.xy / from.w) * size_px;
  along = length(along) > 1e-4 ? normalize(along) : vec2(1.0, 0.0);
  // Corners of two triangles: from-, to-, to+; from-, to+, from+.
  bool end = gl_VertexID == 1 || gl_VertexID == 2 || gl_VertexID == 4;
  float side = gl_VertexID == 2 || gl_VertexID >= 4 ? 1.0 : -1.0;
  vec4 place = end ? to : from;
  vec2 aside = side * vec2(-along.y, along.x) + (end ? along : -along);
  place.xy += aside * width_px / size_px * place.w;
  gl_Position = place;
  gl_Position.z *= 1.002;  // before the edge that it lies on
}
)";
}

std::string flat_fragment_source() {
  return R"(#version 430 core
flat in vec4 flat_colour;
uniform float opacity;
layout(location = 0) out vec4 colour;
void main() { colour = vec4(flat_colour.rgb, flat_colour.a * opacity); }
)";
}

}  // namespace veduta
