#include "viewer/draw/map_painter.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <glm/trigonometric.hpp>

#include "viewer/draw/shaders.h"

namespace veduta {
namespace {

// As the shader of the map colours level roofs.
glm::vec4 colour_of(MapColour colour) {
  switch (colour) {
    case MapColour::complete:
      return {0.62f, 0.05f, 0.04f, 1};
    case MapColour::partial:
      return {0.05f, 0.14f, 0.66f, 1};
    case MapColour::invisible:
      return {0.75f, 0.58f, 0.06f, 1};
    default:
      return {0.47f, 0.47f, 0.43f, 1};
  }
}

}  // namespace

MapPainter::MapPainter(const PvsIndex& index, bool to_layers)
    : index_(index), program_(Program::render(map_vertex_source(to_layers), map_fragment_source())) {
  Box bounds;
  for (const Box& box : index.bounds) bounds.extend(box);
  if (!bounds.empty()) lowest_m_ = bounds.lower.z - 1, highest_m_ = bounds.upper.z + 1;
  glBindTexture(GL_TEXTURE_2D, colours_.id());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

void MapPainter::load(std::span<const MapColour> colours) {
  if (std::equal(colours.begin(), colours.end(), loaded_.begin(), loaded_.end())) return;
  const size_t rows = (colours.size() + map_colours_width - 1) / map_colours_width;
  std::vector<uint8_t> texels(std::max<size_t>(rows, 1) * map_colours_width);
  std::transform(colours.begin(), colours.end(), texels.begin(),
                 [](MapColour colour) { return static_cast<uint8_t>(colour); });
  glBindTexture(GL_TEXTURE_2D, colours_.id());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_R8UI, map_colours_width,
               static_cast<GLsizei>(texels.size() / map_colours_width), 0, GL_RED_INTEGER, GL_UNSIGNED_BYTE,
               texels.data());
  loaded_.assign(colours.begin(), colours.end());
}

OverlayPainter::View MapPainter::look(const MapView& view, const glm::ivec4& rectangle) const {
  const float yaw = glm::radians(view.yaw_deg);
  const float across = 2 / view.width_m;
  const float upward = across * static_cast<float>(rectangle.z) / static_cast<float>(rectangle.w);
  const float deep = 1 / (highest_m_ - lowest_m_);  // depth 1 at the highest, 0 at the lowest
  glm::mat4 clip_from_offset(0);                    // columns of x, y, z, 1
  clip_from_offset[0] = {across * std::sin(yaw), upward * std::cos(yaw), 0, 0};
  clip_from_offset[1] = {-across * std::cos(yaw), upward * std::sin(yaw), 0, 0};
  clip_from_offset[2] = {0, 0, deep, 0};
  clip_from_offset[3] = {0, 0, (view.centre_m.z - lowest_m_) * deep, 1};
  return {view.centre_m, clip_from_offset, 0.5f, {rectangle.z, rectangle.w}, 2};
}

void MapPainter::use(const OverlayPainter::View& view) const {
  glDepthFunc(GL_GREATER);
  glDepthMask(GL_TRUE);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, colours_.id());
  program_.use();
  glUniform1i(program_.uniform("colours"), 0);
  glUniform3fv(program_.uniform("centre_m"), 1, glm::value_ptr(view.position_m));
  glUniformMatrix4fv(program_.uniform("clip_from_offset"), 1, GL_FALSE,
                     glm::value_ptr(view.clip_from_offset));
}

void MapPainter::set_first_eye(int eye) const {
  glUniform1i(program_.uniform("first_eye"), eye);
}

std::vector<ColouredPoint> MapPainter::absent(std::span<const MapColour> colours,
                                              const std::vector<bool>& object_here) const {
  std::vector<ColouredPoint> corners;
  for (size_t o = 0; o < colours.size(); ++o) {
    const Box& box = index_.bounds[o];
    if (object_here[o] || box.empty() || colours[o] == MapColour::hidden) continue;
    // The roof of ground's box would lie over all that stands on it.
    const float z = colours[o] == MapColour::ground ? box.lower.z : box.upper.z;
    const glm::vec4 colour = colour_of(colours[o]);
    const glm::vec3 &a = box.lower, &b = box.upper;
    for (const glm::vec2& xy :
         {glm::vec2(a.x, a.y), {b.x, a.y}, {b.x, b.y}, {a.x, a.y}, {b.x, b.y}, {a.x, b.y}})
      corners.push_back({glm::vec3(xy, z), colour});
  }
  return corners;
}

}  // namespace veduta
