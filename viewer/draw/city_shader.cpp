// Shading that reads well without textures: sun and sky by the face's normal, shade at the foot of buildings,
// haze. Colours are linear; the frame buffer stores sRGB.
#include "viewer/draw/shaders.h"

namespace veduta {

// The light of the sky, shared by both fragment shaders so that the haze ends in the sky's own colour.
static const char* const sky_light = R"(
const vec3 sun = normalize(vec3(0.50, -0.62, 0.60));
vec3 sky_light(vec3 direction) {
  float rise = max(direction.z, 0.0);
  vec3 light = mix(vec3(0.62, 0.74, 0.88), vec3(0.10, 0.25, 0.62), pow(rise, 0.6));
  float towards_sun = max(dot(direction, sun), 0.0);
  return light + vec3(1.0, 0.82, 0.55) * (0.16 * pow(towards_sun, 10.0) + 0.8 * pow(towards_sun, 300.0));
}
// The filmic curve of K. Narkowicz, "ACES filmic tone mapping curve", 2015.
vec3 exposed(vec3 light) {
  vec3 x = 0.46 * light;
  return clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}
)";

std::string city_fragment_source() {
  return std::string("#version 430 core\n") + sky_light + R"(
in vec3 offset_m;
in float height_m;
flat in uvec2 kind;
uniform float haze_m;
uniform bool in_red;
flat in vec2 eye_xy_m;
layout(location = 0) out vec4 colour;

const vec3 walls[8] = vec3[8](vec3(0.33, 0.16, 0.11), vec3(0.52, 0.42, 0.30), vec3(0.60, 0.56, 0.49), vec3(0.40, 0.23, 0.16),
                              vec3(0.45, 0.44, 0.42), vec3(0.25, 0.14, 0.10), vec3(0.56, 0.47, 0.36), vec3(0.43, 0.30, 0.22));

float random(vec2 cell) { return fract(sin(dot(cell, vec2(127.1, 311.7))) * 43758.5453); }
float noise(vec2 p) {
  vec2 cell = floor(p), part = smoothstep(0.0, 1.0, p - cell);
  return mix(mix(random(cell), random(cell + vec2(1, 0)), part.x),
             mix(random(cell + vec2(0, 1)), random(cell + vec2(1, 1)), part.x), part.y);
}
// How much of the pixel lies within [low, high] of a pattern that repeats every 1.
float stripe(float at, float low, float high) {
  float width = max(fwidth(at), 1e-5), begin = at - 0.5 * width, end = at + 0.5 * width;
  float covered = floor(end) * (high - low) + clamp(fract(end) - low, 0.0, high - low) -
                  floor(begin) * (high - low) - clamp(fract(begin) - low, 0.0, high - low);
  return covered / width;
}

vec3 plain_wall() { return (0.86 + 0.28 * float(kind.y & 31u) / 31.0) * walls[kind.y >> 5]; }

vec3 wall_colour(vec3 normal) {
  // Windows by storey stand for the texture that the model lacks: without them, a wall gives the eyes nothing to converge on.
  vec2 along = normalize(vec2(-normal.y, normal.x) + vec2(0.0, 1e-6));
  float window = stripe(dot(offset_m.xy + eye_xy_m, along) / 2.4, 0.30, 0.70) * stripe(height_m / 3.0, 0.30, 0.78);
  vec3 plain = plain_wall();
  return mix(plain, 0.35 * plain + vec3(0.03, 0.04, 0.06), 0.6 * window * step(abs(normal.z), 0.2));
}

vec3 albedo(vec3 normal) {
  uint material = kind.x;
  vec2 place_m = offset_m.xy + eye_xy_m;
  float shade = 0.88 + 0.24 * float(kind.y & 31u) / 31.0;
  if (material <= 1u) return wall_colour(normal);
  if (material == 16u) return plain_wall();
  if (material == 2u)
    return shade * (abs(normal.z) > 0.97 ? vec3(0.24, 0.23, 0.22)
                                         : mix(vec3(0.36, 0.12, 0.07), vec3(0.20, 0.11, 0.09), float(kind.y >> 7)));
  if (material == 5u) return vec3(0.13, 0.13, 0.14);
  if (material == 6u) return vec3(0.04, 0.11, 0.16);
  if (material == 8u) return vec3(0.05, 0.07, 0.09);
  if (material == 9u) return vec3(0.12, 0.06, 0.035);
  vec3 plain = material == 4u ? vec3(0.185, 0.19, 0.145) : material == 7u ? vec3(0.07, 0.15, 0.04) : vec3(0.26, 0.24, 0.21);
  float blur_m = length(fwidth(place_m));
  float grain = 0.22 * (noise(place_m / 9.0) - 0.5) + 0.25 * (noise(place_m / 1.7) - 0.5) * exp(-blur_m / 0.8) +
                0.35 * (noise(place_m / 0.23) - 0.5) * exp(-blur_m / 0.1);
  return plain * (1.0 + grain);
}

void main() {
  // The face's own normal, turned to the eye: meshes need not be oriented.
  vec3 across = cross(dFdx(offset_m), dFdy(offset_m));
  float area = length(across);
  vec3 normal = area > 0.0 ? across / area : vec3(0.0, 0.0, 1.0);
  if (dot(normal, offset_m) > 0.0) normal = -normal;

  float openness = mix(0.5, 1.0, smoothstep(0.0, 7.0, height_m));
  vec3 sky = mix(vec3(0.24, 0.22, 0.20), vec3(0.46, 0.53, 0.65), 0.5 + 0.5 * normal.z) * openness;
  vec3 sunshine = vec3(2.5, 2.2, 1.75) * max(dot(normal, sun), 0.0) * mix(0.8, 1.0, openness);
  vec3 light = albedo(normal) * (sky + sunshine);

  float distance_m = length(offset_m);
  vec3 direction = offset_m / max(distance_m, 1e-6);
  vec3 beyond = sky_light(vec3(direction.xy, max(direction.z, 0.0)));
  float haze = 1.0 - exp(-distance_m / haze_m);
  colour = vec4(exposed(mix(light, beyond, haze)), 1.0);
  if (in_red) colour = vec4(0.55 - 0.45 * dot(normal, direction), 0.0, 0.0, 1.0);
}
)";
}

std::string sky_fragment_source() {
  return std::string("#version 430 core\n") + sky_light + R"(
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
