// A generated city made by hand: two boxes of one mesh, one of them turned, one box of its own, and a street.
#pragma once

#include <cmath>

#include "scene/city/city_model.h"

namespace veduta::city {

/// A box from the ground up, centred, of 5 layers: walls with a window in the wall at y = -depth / 2 (a strip
/// between 1 m and 2 m), a triangle pair as roof, ground.
inline Mesh toy_box(double width_m, double depth_m, double height_m) {
  const double x = width_m / 2, y = depth_m / 2, h = height_m;
  Mesh mesh;
  mesh.vertices = {{-x, -y, 0}, {x, -y, 0}, {x, y, 0},   {-x, y, 0}, {-x, -y, h}, {x, -y, h},
                   {x, y, h},   {-x, y, h}, {-x, -y, 1}, {x, -y, 1}, {-x, -y, 2}, {x, -y, 2}};
  mesh.faces = {{{0, 1, 9, 8}, 0}, {{8, 9, 11, 10}, 1}, {{10, 11, 5, 4}, 0},
                {{1, 2, 6, 5}, 0}, {{2, 3, 7, 6}, 0},   {{3, 0, 4, 7}, 0},
                {{4, 5, 6, 6}, 2}, {{4, 6, 7, 7}, 2},   {{0, 3, 2, 1}, 3}};
  return mesh;
}

/// A quarter turn to the left, then a move.
inline glm::dmat4x3 turned(const glm::dvec3& at) {
  return {{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}, at};
}
inline glm::dmat4x3 moved(const glm::dvec3& at) {
  return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, at};
}

inline constexpr glm::dvec3 toy_place{1844012.25, 5174233.5, 163.125};

inline CityModel toy_city_model() {
  CityModel model;
  model.crs = "EPSG:3946";
  model.layers = {"wall", "window", "roof", "ground"};
  model.meshes = {toy_box(10, 6, 9), toy_box(8, 8, 4.0001)};
  model.floors = {3, 1};
  model.styles = {"brick", "a \"quoted\" style"};
  model.sites = {{"first", 0, moved(toy_place)},
                 {"own", 1, moved(toy_place + glm::dvec3(20, 0, 0.0004))},
                 {"second", 0, turned(toy_place + glm::dvec3(0, 20, 0))}};
  const glm::dvec3 c = toy_place;
  model.ground = {{"terrain",
                   {{c + glm::dvec3(-10, -10, 0), c + glm::dvec3(30, -10, 0), c + glm::dvec3(30, 40, 0),
                     c + glm::dvec3(-10, 40, 0)},
                    {c + glm::dvec3(8, 8, 0), c + glm::dvec3(8, 12, 0), c + glm::dvec3(12, 12, 0),
                     c + glm::dvec3(12, 8, 0)}}},
                  {"road",
                   {{c + glm::dvec3(-10, -20, 0), c + glm::dvec3(30, -20, 0), c + glm::dvec3(30, -10, 0),
                     c + glm::dvec3(-10, -10, 0)}}}};
  return model;
}

}  // namespace veduta::city
