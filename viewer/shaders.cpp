// Shading that reads well without textures: sun and sky by the face's normal, shade at the foot of buildings,
// haze. Colours are linear; the frame buffer stores sRGB.
#include "viewer/shaders.h"

namespace veduta {

// The light of the sky, shared by both fragment shaders so that the haze ends in the sky's own colour.
static const char* const sky_light = R"(
const vec3 sun = normalize(vec3(0.50, -0.62, 0.60));
vec3 sky_light(vec3 direction) {
  float rise = max(direction.z, 0.0);
  vec3 light = mix(vec3(0.78, 0.86, 0.95), vec3(0.16, 0.36, 0.78), pow(rise, 0.55));
  float towards_sun = max(dot(direction, sun), 0.0);
  return light + vec3(1.0, 0.85, 0.6) * (0.25 * pow(towards_sun, 12.0) + 0.6 * pow(towards_sun, 300.0));
}
vec3 exposed(vec3 light) { return 1.0 - exp(-1.15 * light); }
)";

std::string city_vertex_shader() {
  return R"(#version 430 core
layout(location = 0) in vec3 position_m;
layout(location = 1) in uvec2 material_tint;
layout(location = 2) in float height_cm;
uniform vec3 eye_m;
uniform mat4 clip_from_offset;
out vec3 offset_m;               // from the eye: keeps the precision of what is near
out float height_m;
flat out uvec2 kind;
void main() {
  offset_m = position_m - eye_m;
  height_m = height_cm * 0.01;
  kind = material_tint;
  gl_Position = clip_from_offset * vec4(offset_m, 1.0);
}
)";
}

std::string city_fragment_shader() {
  return std::string("#version 430 core\n") + sky_light + R"(
in vec3 offset_m;
in float height_m;
flat in uvec2 kind;
uniform float haze_m;
layout(location = 0) out vec4 colour;

const vec3 walls[8] = vec3[8](vec3(0.33, 0.16, 0.11), vec3(0.52, 0.42, 0.30), vec3(0.60, 0.56, 0.49), vec3(0.40, 0.23, 0.16),
                              vec3(0.45, 0.44, 0.42), vec3(0.25, 0.14, 0.10), vec3(0.56, 0.47, 0.36), vec3(0.43, 0.30, 0.22));

vec3 albedo(float tilt) {
  uint material = kind.x;
  float shade = 0.88 + 0.24 * float(kind.y & 31u) / 31.0;
  bool flat_top = tilt > 0.97;
  if (material == 1u || material == 0u) return shade * walls[kind.y >> 5];
  if (material == 2u) return shade * (flat_top ? vec3(0.30, 0.29, 0.28)
                                               : mix(vec3(0.40, 0.15, 0.09), vec3(0.22, 0.13, 0.11), float(kind.y >> 7)));
  if (material == 3u) return vec3(0.34, 0.32, 0.28);
  if (material == 4u) return vec3(0.25, 0.28, 0.19);
  if (material == 5u) return vec3(0.19, 0.19, 0.20);
  if (material == 6u) return vec3(0.07, 0.16, 0.22);
  return vec3(0.11, 0.21, 0.07);
}

void main() {
  // The face's own normal, turned to the eye: meshes need not be oriented.
  vec3 across = cross(dFdx(offset_m), dFdy(offset_m));
  float area = length(across);
  vec3 normal = area > 0.0 ? across / area : vec3(0.0, 0.0, 1.0);
  if (dot(normal, offset_m) > 0.0) normal = -normal;

  float openness = mix(0.45, 1.0, smoothstep(0.0, 7.0, height_m));
  vec3 sky = mix(vec3(0.26, 0.24, 0.21), vec3(0.55, 0.66, 0.85), 0.5 + 0.5 * normal.z) * openness;
  vec3 sunshine = vec3(2.1, 1.9, 1.55) * max(dot(normal, sun), 0.0) * mix(0.75, 1.0, openness);
  vec3 light = albedo(abs(normal.z)) * (sky + sunshine);

  float distance_m = length(offset_m);
  vec3 direction = offset_m / max(distance_m, 1e-6);
  vec3 beyond = sky_light(vec3(direction.xy, max(direction.z, 0.0)));
  float haze = 1.0 - exp(-distance_m / haze_m);
  colour = vec4(exposed(mix(light, beyond, haze)), 1.0);
}
)";
}

std::string sky_vertex_shader() {
  return R"(#version 430 core
uniform mat3 offset_from_screen;  // (x, y, 1) of clip space to a direction in the world
out vec3 direction;
void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  direction = offset_from_screen * vec3(corner, 1.0);
  gl_Position = vec4(corner, 0.0, 1.0);  // depth 0: at infinity
}
)";
}

std::string sky_fragment_shader() {
  return std::string("#version 430 core\n") + sky_light + R"(
in vec3 direction;
layout(location = 0) out vec4 colour;
void main() {
  vec3 towards = normalize(direction);
  vec3 land = vec3(0.42, 0.46, 0.46);
  vec3 light = mix(sky_light(towards), land, smoothstep(0.0, 0.12, -towards.z));
  colour = vec4(exposed(light), 1.0);
}
)";
}

}  // namespace veduta
