// The shaders of the panorama.
#pragma once

namespace veduta::shader {

/// Sides of occluder boxes, relative to the eye. gl_Position = (right, up, near, forward): depth = near /
/// forward, exact in float over the whole range. Clipped at the ring's depth limit: beyond it a pixel is
/// wider than the ring's h (T3).
inline constexpr const char* occluder_vertex = R"(#version 430 core
layout(location = 0) in vec4 corner_and_limit;
uniform mat3 face_from_world;
uniform float near;
out gl_PerVertex { vec4 gl_Position; float gl_ClipDistance[1]; };
void main() {
  vec3 p = face_from_world * corner_and_limit.xyz;
  gl_Position = vec4(p.xy, near, p.z);
  gl_ClipDistance[0] = corner_and_limit.w - p.z;
}
)";

inline constexpr const char* occluder_fragment = R"(#version 430 core
void main() {}
)";

/// The depth pyramid of a pane: each texel keeps the farthest (smallest near / z) of 4 x 4 pixels, and of
/// 256. An invocation makes one of the coarse ones with all that is in it: no level waits for another.
inline constexpr const char* pyramid = R"(#version 430 core
layout(local_size_x = 8, local_size_y = 2) in;
uniform sampler2DArray depth;
uniform ivec4 pane;          // first coarse texel, number of coarse texels
uniform int face, resolution;
layout(std430, binding = 0) buffer Pyramid { float farthest[]; };
void main() {
  if (any(greaterThanEqual(ivec2(gl_GlobalInvocationID), pane.zw))) return;
  ivec2 coarse = pane.xy + ivec2(gl_GlobalInvocationID);
  int fine_size = resolution / 4, coarse_size = resolution / 16;
  float least = 1e30;
  for (int k = 0; k < 16; ++k) {
    ivec2 fine = coarse * 4 + ivec2(k & 3, k >> 2);
    float value = 1e30;
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 4; ++x)
        value = min(value, texelFetch(depth, ivec3(fine * 4 + ivec2(x, y), face), 0).r);
    farthest[(face * fine_size + fine.y) * fine_size + fine.x] = value;
    least = min(least, value);
  }
  farthest[5 * fine_size * fine_size + (face * coarse_size + coarse.y) * coarse_size + coarse.x] = least;
}
)";

/// hidden(lower, upper): is a box hidden from every point of the part? Both tests below share it.
inline constexpr const char* box_test = R"(#version 430 core
layout(local_size_x = 64) in;
uniform sampler2DArray depth;
uniform vec3 eye, half_extent;
uniform float near, outward;
uniform int resolution;
// Rows [x, y) that were drawn in each strip of columns of each face: elsewhere nothing is known.
uniform ivec2 rows[80];
uniform int strip_width;
layout(std430, binding = 0) readonly buffer Pyramid { float farthest[]; };
layout(std430, binding = 1) readonly buffer Boxes { float boxes[]; };

// Is every texel of [lo, hi] of a level nearer than needed? (reversed depth: larger is nearer)
bool all_nearer(int level, int face, ivec2 lo, ivec2 hi, float needed) {
  if (level == 0) {
    for (int y = lo.y; y <= hi.y; ++y)
      for (int x = lo.x; x <= hi.x; ++x)
        if (texelFetch(depth, ivec3(x, y, face), 0).r <= needed) return false;
    return true;
  }
  int size = resolution >> (2 * level);
  int offset = level == 2 ? 5 * (resolution / 4) * (resolution / 4) : 0;
  for (int y = lo.y; y <= hi.y; ++y)
    for (int x = lo.x; x <= hi.x; ++x)
      if (farthest[offset + (face * size + y) * size + x] <= needed) return false;
  return true;
}

// Coarse levels first; a finer one is asked while it has few texels. To stop early errs towards visible.
bool rectangle_hidden(int face, ivec2 lo, ivec2 hi, float needed) {
  for (int s = lo.x / strip_width; s <= hi.x / strip_width; ++s) {
    ivec2 known = rows[face * 16 + s];
    if (lo.y < known.x || hi.y >= known.y) return false;
  }
  int extent = max(hi.x - lo.x, hi.y - lo.y);
  int level = extent > 15 ? 2 : extent > 3 ? 1 : 0;
  for (; level >= 0; --level) {
    ivec2 a = lo >> (2 * level), b = hi >> (2 * level);
    ivec2 n = b - a + 1;
    if (n.x * n.y > 4096) return false;
    if (all_nearer(level, face, a, b, needed)) return true;
  }
  return false;
}

// The rotations of cube_face.h, written out.
vec3 to_face(int face, vec3 p) {
  float s = (face & 1) == 0 ? 1.0 : -1.0;
  int f = face >> 1;
  if (f == 0) return vec3(s * p.y, p.z, s * p.x);
  if (f == 1) return vec3(-s * p.x, p.z, s * p.y);
  return vec3(s * p.x, p.y, s * p.z);
}

bool hidden(int box) {
  vec3 world_lower = vec3(boxes[6 * box], boxes[6 * box + 1], boxes[6 * box + 2]);
  vec3 world_upper = vec3(boxes[6 * box + 3], boxes[6 * box + 4], boxes[6 * box + 5]);
  if (any(greaterThan(world_lower, world_upper))) return true;  // no triangle, nothing to see
  // T2: a box of half-size b is tested as one of max(b - e, 0) around the same centre.
  vec3 center = 0.5 * (world_lower + world_upper) - eye;
  vec3 half_size = max(0.5 * (world_upper - world_lower) - half_extent, vec3(0));
  for (int face = 0; face < 6; ++face) {
    vec3 p = to_face(face, center - half_size), q = to_face(face, center + half_size);
    vec3 lo = min(p, q), hi = max(p, q);
    float nearest = max(max(max(lo.x, -hi.x), max(lo.y, -hi.y)), max(lo.z, 0.0));
    if (nearest > hi.z * 1.00001 + 1e-6) continue;     // not in this face
    if (face == 5 || nearest < near) return false;     // below, or at the eye: visible
    // Bounds of the projection of what lies between `nearest` and hi.z, clipped to the face, and a little outward.
    vec2 left = vec2(lo.x < 0 ? lo.x / nearest : lo.x / hi.z, lo.y < 0 ? lo.y / nearest : lo.y / hi.z);
    vec2 right = vec2(hi.x > 0 ? hi.x / nearest : hi.x / hi.z, hi.y > 0 ? hi.y / nearest : hi.y / hi.z);
    vec2 scale = vec2(0.5 * resolution);
    ivec2 first = ivec2(floor((clamp(left, -1.0, 1.0) + 1.0) * scale - outward));
    ivec2 last = ivec2(floor((clamp(right, -1.0, 1.0) + 1.0) * scale + outward));
    first = clamp(first, ivec2(0), ivec2(resolution - 1));
    last = clamp(last, ivec2(0), ivec2(resolution - 1));
    if (!rectangle_hidden(face, first, last, near / (nearest * 0.99999))) return false;
  }
  return true;
}
)";

/// Whole objects: which does this part see?
inline constexpr const char* object_test = R"(
uniform int first, count;
layout(std430, binding = 2) readonly buffer Objects { uint objects[]; };
layout(std430, binding = 4) buffer Answers { uint answers[]; };
void main() {
  int q = int(gl_GlobalInvocationID.x);
  if (q >= count) return;
  answers[first + q] = hidden(int(objects[first + q])) ? 0u : 1u;
}
)";

/// Vertical slices: how high is each occluded, between what is known and what is worth to know? The height is
/// monotone, so it is bisected (in place of the steps of Algorithm 4.2).
inline constexpr const char* slice_test = R"(
uniform int first, count, first_answer, first_slice_box;
layout(std430, binding = 3) readonly buffer Slices { uvec4 slices[]; };  // first box, low, high, object's question
layout(std430, binding = 4) buffer Answers { uint answers[]; };
void main() {
  int q = int(gl_GlobalInvocationID.x);
  if (q >= count) return;
  uvec4 slice = slices[first + q];
  int box = first_slice_box + int(slice.x) - 1;  // box + h: the lowest h z-slices
  uint low = slice.y, high = slice.z;
  bool asked = slice.w == 0xffffffffu || answers[slice.w] != 0u;  // of a hidden object, all is hidden
  if (asked && low < high && !hidden(box + int(high))) {
    while (high - low > 1u) {  // low is hidden, high is not
      uint middle = (low + high) / 2u;
      if (hidden(box + int(middle))) low = middle; else high = middle;
    }
    high = low;
  }
  answers[first_answer + q] = max(low, high);
}
)";

}  // namespace veduta::shader
