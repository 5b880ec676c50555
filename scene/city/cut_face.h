// A face with points on its sides, into triangles and quads.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scene/city/city_model.h"

namespace veduta::city {

/// Cuts faces that have got vertices in the middle of their sides. Its memory stays between faces.
class FaceCutter {
 public:
  /// Appends convex faces of the same layer and direction that together have each corner and point: one
  /// triangle more for each point. None is without area.
  /// \param sides [corners] the points between corner[i] and the next, in this order \pre one at least
  void cut(const Mesh& mesh, const Face& face, const std::array<std::vector<uint32_t>, 4>& sides,
           std::vector<Face>& faces);

 private:
  void cut_triangle(const Face& face, const std::array<std::vector<uint32_t>, 4>& sides);
  void cut_quad(const Face& face, const std::array<std::vector<uint32_t>, 4>& sides);
  void strip(size_t left, size_t left_end, size_t right, size_t right_end);
  void fan(uint32_t apex, uint32_t from, const std::vector<uint32_t>& points, uint32_t to);
  void add(uint32_t a, uint32_t b, uint32_t c, uint32_t d);

  const Mesh* mesh_ = nullptr;
  std::vector<Face>* faces_ = nullptr;
  uint16_t layer_ = 0;
  std::vector<uint32_t> left_, right_;
};

}  // namespace veduta::city
