// What a row draws of its objects: exactly the triangles for which draws() holds (pvs/visibility.h).
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "pvs/pvs_stream.h"

namespace veduta {

struct DrawnObject {
  PvsEntry entry;
  std::vector<glm::vec3> vertices;    ///< m from the file's origin; those that are used, in the file's order
  std::vector<glm::uvec3> triangles;  ///< in the file's order, never none
  std::vector<Material> material;     ///< one for each triangle
};

/// One object after the other, as the row lists them; those of which nothing is drawn are passed over.
/// \throw Error(bad_input) where the file is damaged.
void visit_drawn(const PvsStream& stream, const PvsRow& row,
                 const std::function<void(const DrawnObject&)>& visit);

/// The triangles that the index draws of an object, which is the only one of `city`.
DrawnObject drawn_of(City&& city, const PvsEntry& entry);

}  // namespace veduta
