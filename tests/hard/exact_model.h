// A model as the exact reference reads it: on its own, in doubles.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace veduta::hard {

using Point = std::array<double, 3>;  ///< m, in the model's coordinates

struct ExactTriangle {
  std::array<Point, 3> corner;
  uint32_t object = 0;  ///< of ExactModel::objects
};

struct ExactModel {
  std::vector<std::string> objects;  ///< names
  std::vector<ExactTriangle> triangles;
};

/// `o`, `v` and `f` of Wavefront OBJ, faces of more than three corners as fans (which is right for convex
/// ones). Every number is multiplied by `unit_m`. \throw std::runtime_error for what it does not understand.
ExactModel read_exact_model(const std::filesystem::path& obj, double unit_m);

}  // namespace veduta::hard
