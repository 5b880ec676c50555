// Walls between buildings that touch: there twice, and inside of what is shrunk together.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace veduta {

/// Which triangles lie wholly on others that face the opposite way, however these are cut: at a millimetre or
/// less, but for a thousandth of their area. \return [F] 1 or 0.
std::vector<uint8_t> covered_faces(const std::vector<glm::dvec3>& vertices,
                                   const std::vector<glm::uvec3>& faces);

}  // namespace veduta
