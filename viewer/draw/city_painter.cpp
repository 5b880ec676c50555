#include "viewer/draw/city_painter.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>

#include "viewer/draw/shaders.h"

namespace veduta {
namespace {

// Haze gives depth to a street without hiding the far end of the city.
float haze_m(const PvsIndex& index) {
  Box bounds;
  for (const Box& box : index.bounds) bounds.extend(box);
  return std::max(3000.0f, bounds.empty() ? 0.0f : 3.0f * glm::length(bounds.upper - bounds.lower));
}

// A direction from a place on the screen.
glm::mat3 offset_from_screen(const EyeView& view) {
  const glm::mat4& m = view.clip_from_offset;
  return glm::inverse(glm::mat3(glm::vec3(m[0].x, m[0].y, m[0].w), glm::vec3(m[1].x, m[1].y, m[1].w),
                                glm::vec3(m[2].x, m[2].y, m[2].w)));
}

}  // namespace

CityPainter::CityPainter(const PvsIndex& index, bool to_layers)
    : haze_m_(haze_m(index)),
      city_(Program::render(city_vertex_source(to_layers), city_fragment_source())),
      sky_(Program::render(sky_vertex_source(to_layers), sky_fragment_source())) {}

void CityPainter::use(std::span<const EyeView> views, bool in_red) const {
  std::array<glm::vec3, 2> eye_m{};
  std::array<glm::mat4, 2> clip_from_offset{};
  for (size_t eye = 0; eye < views.size(); ++eye)
    eye_m[eye] = views[eye].position_m, clip_from_offset[eye] = views[eye].clip_from_offset;
  const auto eyes = static_cast<GLsizei>(views.size());
  glDepthFunc(GL_GREATER);
  glDepthMask(GL_TRUE);
  city_.use();
  glUniform3fv(city_.uniform("eye_m"), eyes, glm::value_ptr(eye_m[0]));
  glUniformMatrix4fv(city_.uniform("clip_from_offset"), eyes, GL_FALSE, glm::value_ptr(clip_from_offset[0]));
  glUniform1f(city_.uniform("haze_m"), haze_m_);
  glUniform1i(city_.uniform("in_red"), in_red);
}

void CityPainter::set_first_eye(int first_eye) const {
  glUniform1i(city_.uniform("first_eye"), first_eye);
}

void CityPainter::use_sky(std::span<const EyeView> views) const {
  std::array<glm::mat3, 2> directions{};
  std::transform(views.begin(), views.end(), directions.begin(), offset_from_screen);
  glDepthFunc(GL_EQUAL);
  glDepthMask(GL_FALSE);
  sky_.use();
  glUniformMatrix3fv(sky_.uniform("offset_from_screen"), static_cast<GLsizei>(views.size()), GL_FALSE,
                     glm::value_ptr(directions[0]));
  glBindVertexArray(no_array_.id());
}

void CityPainter::draw_sky(int first_eye, uint32_t eyes) const {
  glUniform1i(sky_.uniform("first_eye"), first_eye);
  glDrawArraysInstanced(GL_TRIANGLES, 0, 3, static_cast<GLsizei>(eyes));
}

}  // namespace veduta
