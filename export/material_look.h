// What surfaces look like elsewhere: a name and a colour for each material.
#pragma once

#include <array>

#include "scene/scene.h"

namespace veduta {

struct MaterialLook {
  const char* name;            ///< material_of_name(name) is the material
  std::array<double, 3> srgb;  ///< 0..1, as it is seen in full light
};

inline constexpr size_t material_count = 10;
inline constexpr std::array<MaterialLook, material_count> material_looks{{
    {"unknown", {0.72, 0.70, 0.68}},
    {"wall", {0.80, 0.72, 0.62}},
    {"roof", {0.66, 0.33, 0.25}},
    {"ground", {0.62, 0.60, 0.55}},
    {"terrain", {0.60, 0.66, 0.49}},
    {"road", {0.45, 0.45, 0.47}},
    {"water", {0.36, 0.55, 0.70}},
    {"vegetation", {0.35, 0.52, 0.27}},
    {"window", {0.32, 0.41, 0.50}},
    {"door", {0.42, 0.27, 0.18}},
}};

inline const MaterialLook& look_of(Material material) {
  return material_looks[static_cast<size_t>(material)];
}

}  // namespace veduta
