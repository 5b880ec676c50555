#include "viewer/draw/overlay_painter.h"

#include <array>
#include <cstddef>
#include <glm/gtc/type_ptr.hpp>

#include "viewer/draw/shaders.h"

namespace veduta {
namespace {

// Of what is behind something.
constexpr float faint = 0.15f;

const void* offset(size_t bytes) {
  return reinterpret_cast<const void*>(bytes);
}

// Corner k of a box is the upper one along x, y, z where bits 0, 1, 2 of k are set.
glm::vec3 corner(const Box& box, unsigned k) {
  return {k & 1 ? box.upper.x : box.lower.x, k & 2 ? box.upper.y : box.lower.y,
          k & 4 ? box.upper.z : box.lower.z};
}

void add_edges(const ColouredBox& box, std::vector<ColouredLine>& lines) {
  for (unsigned k = 0; k < 8; ++k)
    for (unsigned axis : {1u, 2u, 4u})
      if (!(k & axis)) lines.push_back({corner(box.box, k), corner(box.box, k | axis), box.edge});
}

void add_faces(const ColouredBox& box, std::vector<ColouredPoint>& corners) {
  for (unsigned axis = 0; axis < 3; ++axis)
    for (unsigned side : {0u, 1u}) {
      const unsigned first = side << axis, u = 1u << (axis + 1) % 3, v = 1u << (axis + 2) % 3;
      for (unsigned k : {first, first | u, first | u | v, first, first | u | v, first | v})
        corners.push_back({corner(box.box, k), box.fill});
    }
}

template <typename T>
void stream(const GlBuffer& buffer, std::span<const T> values) {
  glBindBuffer(GL_ARRAY_BUFFER, buffer.id());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(values.size_bytes()), values.data(), GL_STREAM_DRAW);
}

void set_view(const Program& program, const OverlayPainter::View& view, float opacity) {
  program.use();
  glUniform3fv(program.uniform("eye_m"), 1, glm::value_ptr(view.position_m));
  glUniformMatrix4fv(program.uniform("clip_from_offset"), 1, GL_FALSE, glm::value_ptr(view.clip_from_offset));
  glUniform1f(program.uniform("opacity"), opacity);
}

}  // namespace

OverlayPainter::OverlayPainter()
    : triangle_program_(Program::render(triangle_vertex_source(), flat_fragment_source())),
      line_program_(Program::render(line_vertex_source(), flat_fragment_source())) {
  glBindVertexArray(triangle_array_.id());
  glBindBuffer(GL_ARRAY_BUFFER, triangles_.id());
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(ColouredPoint),
                        offset(offsetof(ColouredPoint, position_m)));
  glVertexAttribPointer(1, 4, GL_FLOAT, GL_FALSE, sizeof(ColouredPoint),
                        offset(offsetof(ColouredPoint, colour)));
  for (GLuint location : {0u, 1u}) glEnableVertexAttribArray(location);
  glBindVertexArray(line_array_.id());
  glBindBuffer(GL_ARRAY_BUFFER, lines_.id());
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(ColouredLine), offset(offsetof(ColouredLine, from)));
  glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, sizeof(ColouredLine), offset(offsetof(ColouredLine, to)));
  glVertexAttribPointer(2, 4, GL_FLOAT, GL_FALSE, sizeof(ColouredLine),
                        offset(offsetof(ColouredLine, colour)));
  for (GLuint location : {0u, 1u, 2u}) {
    glEnableVertexAttribArray(location);
    glVertexAttribDivisor(location, 1);
  }
  glBindVertexArray(0);
}

void OverlayPainter::load(std::span<const ColouredBox> boxes, std::span<const ColouredLine> lines) {
  std::vector<ColouredLine> all(lines.begin(), lines.end());
  std::vector<ColouredPoint> faces;
  for (const ColouredBox& box : boxes) {
    if (box.box.empty()) continue;
    add_edges(box, all);
    if (box.fill.a > 0) add_faces(box, faces);
  }
  load_triangles(faces);
  stream<ColouredLine>(lines_, all);
  line_count_ = all.size();
}

void OverlayPainter::load_triangles(std::span<const ColouredPoint> corners) {
  stream(triangles_, corners);
  corner_count_ = corners.size();
  line_count_ = 0;
}

void OverlayPainter::draw(const View& view, Depth depth) const {
  if (corner_count_ + line_count_ == 0) return;
  const bool surface = depth == Depth::as_surface;
  glDepthMask(surface ? GL_TRUE : GL_FALSE);
  glDepthFunc(depth == Depth::ignored ? GL_ALWAYS : GL_GREATER);
  if (!surface) glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  draw_triangles(view, 1);
  draw_lines(view, 1);
  if (depth == Depth::tested) {
    glDepthFunc(GL_LEQUAL);
    draw_triangles(view, faint);
    draw_lines(view, faint);
  }
  glDisable(GL_BLEND);
}

void OverlayPainter::draw_triangles(const View& view, float opacity) const {
  if (corner_count_ == 0) return;
  set_view(triangle_program_, view, opacity);
  glBindVertexArray(triangle_array_.id());
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(corner_count_));
}

void OverlayPainter::draw_lines(const View& view, float opacity) const {
  if (line_count_ == 0) return;
  set_view(line_program_, view, opacity);
  glUniform2fv(line_program_.uniform("size_px"), 1, glm::value_ptr(view.size_px));
  glUniform1f(line_program_.uniform("width_px"), view.line_px);
  glUniform1f(line_program_.uniform("nearest_w"), view.nearest_w);
  glBindVertexArray(line_array_.id());
  glDrawArraysInstanced(GL_TRIANGLES, 0, 6, static_cast<GLsizei>(line_count_));
}

}  // namespace veduta
