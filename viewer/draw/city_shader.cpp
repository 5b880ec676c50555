// Shading that reads well without textures: sun and sky by the face's normal, shade at the foot of buildings,
// windows, courses of bricks and grain of ground, haze. Colours are linear; the frame buffer stores sRGB.
//
// Software GL takes every branch of a fragment shader, but leaves loops early: what depends on the material
// is chosen at the vertices, and the grain is a loop. No powers, but products. A frame in Den Haag takes 0.8
// of the time that it took without all that.
#include "viewer/draw/shaders.h"

namespace veduta {

// The light of the sky, shared by both fragment shaders so that the haze ends in the sky's own colour.
static const char* const sky_light = R"(#version 430 core
const vec3 sun = normalize(vec3(0.50, -0.62, 0.60));
float squared(float x) { return x * x; }
vec3 sky_light(vec3 direction) {
  vec3 light = mix(vec3(0.62, 0.74, 0.88), vec3(0.10, 0.25, 0.62), sqrt(max(direction.z, 0.0)));
  float towards_sun = max(dot(direction, sun), 0.0);
  float power8 = squared(squared(squared(towards_sun)));
  float power256 = squared(squared(squared(squared(squared(power8)))));
  return light + vec3(1.0, 0.82, 0.55) * (0.16 * power8 + 0.8 * power256);
}
// The filmic curve of K. Narkowicz, "ACES filmic tone mapping curve", 2015.
vec3 exposed(vec3 light) {
  vec3 x = 0.46 * light;
  return clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}
)";

std::string material_source() {
  return R"(
const vec3 walls[8] = vec3[8](vec3(0.38, 0.20, 0.14), vec3(0.52, 0.42, 0.30), vec3(0.60, 0.56, 0.49), vec3(0.42, 0.26, 0.19),
                              vec3(0.46, 0.45, 0.43), vec3(0.32, 0.19, 0.14), vec3(0.56, 0.47, 0.36), vec3(0.45, 0.32, 0.24));

// Its colour, and how much it has of: windows, courses, grain, and of x: level roof, y: water.
void look_up(uint material, uint tint, out vec3 plain, out vec3 pattern, out vec2 special) {
  float shade = 0.88 + 0.24 * float(tint & 31u) / 31.0;
  plain = vec3(0.26, 0.24, 0.21), pattern = vec3(0.0, 0.0, 1.0), special = vec2(0.0);
  if (material <= 1u || material == 16u) {  // wall; 16: with windows of its own
    plain = shade * walls[tint >> 5];
    pattern = vec3(material == 16u ? 0.0 : 1.0, 1.0, 0.0);
  } else if (material == 2u) {  // roof
    plain = shade * mix(vec3(0.36, 0.12, 0.07), vec3(0.20, 0.11, 0.09), float(tint >> 7));
    pattern = vec3(0.0, 1.3, 0.0), special.x = 1.0;
  } else if (material == 4u) {  // terrain
    plain = vec3(0.185, 0.19, 0.145);
  } else if (material == 5u) {  // road
    plain = vec3(0.13, 0.13, 0.14), pattern.z = 0.45;
  } else if (material == 6u) {  // water
    plain = vec3(0.03, 0.08, 0.11), pattern.z = 0.3, special.y = 1.0;
  } else if (material == 7u) {  // vegetation
    plain = vec3(0.07, 0.15, 0.04), pattern.z = 1.2;
  } else if (material == 8u) {  // window
    plain = vec3(0.05, 0.07, 0.09), pattern.z = 0.0;
  } else if (material == 9u) {  // door
    plain = vec3(0.12, 0.06, 0.035), pattern.z = 0.0;
  }
}
)";
}

std::string city_fragment_source() {
  return std::string(sky_light) + R"(
in vec3 offset_m;
in float height_m;
flat in vec3 eye_at_m;
flat in vec3 plain, pattern;
flat in vec2 special;
uniform float haze_m;
uniform bool in_red;
layout(location = 0) out vec4 colour;

float random(ivec2 cell) {
  uint h = uint(cell.x) * 0x9e3779b1u ^ uint(cell.y) * 0x85ebca77u;
  h = (h ^ h >> 15) * 0x2c1b3c6du;
  return float((h ^ h >> 13) >> 8) / 16777216.0;
}
float noise(vec2 p) {
  ivec2 cell = ivec2(floor(p));
  vec2 part = p - floor(p);
  part *= part * (3.0 - 2.0 * part);
  return mix(mix(random(cell), random(cell + ivec2(1, 0)), part.x),
             mix(random(cell + ivec2(0, 1)), random(cell + ivec2(1, 1)), part.x), part.y);
}
// How much of the pixel lies within [low, high] of a pattern that repeats every 1.
float stripe(float at, float low, float high) {
  float width = max(fwidth(at), 1e-5), begin = at - 0.5 * width, end = begin + width;
  float covered = floor(end) * (high - low) + clamp(fract(end) - low, 0.0, high - low) -
                  floor(begin) * (high - low) - clamp(fract(begin) - low, 0.0, high - low);
  return covered / width;
}

// Without windows and courses, a wall gives the eyes nothing to converge on.
vec3 albedo(vec3 normal) {
  vec3 at_m = offset_m + eye_at_m;
  // Rounded: at the far end of a city, the smallest change of the direction moves the windows.
  vec2 across = round(32.0 * normal.xy / max(abs(normal.x) + abs(normal.y), 1e-6));
  vec2 along = normalize(vec2(-across.y, across.x) + vec2(0.0, 1e-6));
  float window = stripe(dot(at_m.xy, along) / 2.4, 0.30, 0.70) * stripe(height_m / 3.0, 0.30, 0.78);
  float course = stripe(height_m / 0.25, 0.0, 0.14);
  vec3 base = mix(plain, vec3(0.24, 0.23, 0.22), special.x * step(0.97, normal.z));
  base *= 1.0 - 0.11 * pattern.y * course * step(normal.z, 0.97);
  base = mix(base, 0.3 * base + vec3(0.03, 0.04, 0.06), 0.7 * pattern.x * window * step(abs(normal.z), 0.2));
  vec2 place_m = at_m.xy + 0.7 * at_m.z;  // so that no face has stripes of it
  float blur_m = length(fwidth(place_m)), grain = 0.0;
  for (float size_m = 9.0; size_m > 0.2 && size_m * pattern.z > 1.3 * blur_m; size_m /= 6.0)
    grain += 0.3 * (noise(place_m / size_m) - 0.5) * (1.0 - squared(1.3 * blur_m / (size_m * pattern.z)));
  return base * (1.0 + pattern.z * grain);
}

void main() {
  // The face's own normal, turned to the eye: meshes need not be oriented.
  vec3 across = cross(dFdx(offset_m), dFdy(offset_m));
  float area = length(across);
  vec3 normal = area > 0.0 ? across / area : vec3(0.0, 0.0, 1.0);
  if (dot(normal, offset_m) > 0.0) normal = -normal;

  float openness = mix(0.6, 1.0, smoothstep(0.0, 7.0, height_m));
  vec3 sky = mix(vec3(0.27, 0.25, 0.22), vec3(0.46, 0.53, 0.65), 0.5 + 0.5 * normal.z) * openness;
  sky *= 1.0 + 0.3 * dot(normal.xy, sun.xy);  // brighter on the sun's side, so that shaded walls differ
  vec3 sunshine = vec3(2.5, 2.2, 1.75) * max(dot(normal, sun), 0.0) * mix(0.8, 1.0, openness);
  vec3 light = albedo(normal) * (sky + sunshine);

  float distance_m = length(offset_m);
  vec3 direction = offset_m / max(distance_m, 1e-6);
  float rise = mix(max(direction.z, 0.0), abs(direction.z), special.y);
  vec3 beyond = sky_light(vec3(direction.xy, rise));  // the far sky, or what water mirrors
  light = mix(light, beyond, special.y * (0.05 + 0.6 * squared(squared(1.0 - rise))));
  float haze = 1.0 - exp(-distance_m / haze_m);
  colour = vec4(exposed(mix(light, beyond, haze)), 1.0);
  if (in_red) colour = vec4(0.55 - 0.45 * dot(normal, direction), 0.0, 0.0, 1.0);
}
)";
}

std::string sky_fragment_source() {
  return std::string(sky_light) + R"(
in vec3 direction;
layout(location = 0) out vec4 colour;
void main() {
  vec3 towards = normalize(direction);
  vec3 land = vec3(0.30, 0.33, 0.32);
  vec3 light = mix(sky_light(towards), land, smoothstep(0.0, 0.12, -towards.z));
  colour = vec4(exposed(light), 1.0);
}
)";
}

}  // namespace veduta
