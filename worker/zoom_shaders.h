// The shaders of method "zoom".
#pragma once

namespace veduta::shader {

/// Corners of occluders (origin: minus the eye, size: 1) and of test boxes (a unit cube; origin: the lower
/// corner relative to the eye). gl_Position = (right, up, near, forward) in the picture's rectangle: depth =
/// near / forward, as in the panorama.
inline constexpr const char* zoom_vertex = R"(#version 430 core
layout(location = 0) in vec3 corner;
uniform vec3 origin, size;
uniform mat3 view_from_world;
uniform vec2 scale, offset;  // of right / forward and up / forward
uniform float near;
void main() {
  vec3 p = view_from_world * (origin + size * corner);
  gl_Position = vec4(p.xy * scale + p.z * offset, near, p.z);
}
)";

inline constexpr const char* zoom_fragment = R"(#version 430 core
void main() {}
)";

}  // namespace veduta::shader
