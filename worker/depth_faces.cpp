#include "worker/depth_faces.h"

#include <epoxy/gl.h>

#include <glm/gtc/type_ptr.hpp>
#include <string>

#include "scene/error.h"
#include "worker/panorama_shaders.h"

namespace veduta {
namespace {

/// Corners of quads that indices are made for: one draw takes no more.
constexpr size_t batch_vertices = size_t{1} << 16;

GLuint groups(int items, int size) {
  return static_cast<GLuint>((items + size - 1) / size);
}

}  // namespace

DepthFaces::DepthFaces(int resolution, float near_m)
    : most_(resolution),
      resolution_(resolution),
      near_m_(near_m),
      draw_(Program::render(shader::occluder_vertex, shader::occluder_fragment)),
      reduce_(Program::compute(shader::pyramid)),
      in_draw_{draw_.uniform("face_from_world"), draw_.uniform("near")},
      in_reduce_{reduce_.uniform("depth"), reduce_.uniform("pane"), reduce_.uniform("face"),
                 reduce_.uniform("resolution")} {
  make_texture();
  make_quads();
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  glClearDepth(0.0);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_CLIP_DISTANCE0);
}

void DepthFaces::make_texture() {
  const GLsizei r = most_;
  glBindTexture(GL_TEXTURE_2D_ARRAY, depth_.id());
  glTexStorage3D(GL_TEXTURE_2D_ARRAY, 1, GL_DEPTH_COMPONENT32F, r, r, face_count);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  for (int face = 0; face < face_count; ++face) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffers_[face].id());
    glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, depth_.id(), 0, face);
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
      throw Error(ExitStatus::defect, "occlusion: the driver takes no 32-bit float depth array of " +
                                          std::to_string(r) + " pixels");
    }
  }
  const size_t fine = static_cast<size_t>(r) / 4, coarse = static_cast<size_t>(r) / 16;
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, pyramid_.id());
  glBufferData(GL_SHADER_STORAGE_BUFFER,
               static_cast<GLsizeiptr>(face_count * (fine * fine + coarse * coarse) * sizeof(float)), nullptr,
               GL_DYNAMIC_COPY);
}

/// The indices of the two triangles of each quad, once.
void DepthFaces::make_quads() {
  glBindVertexArray(quads_.id());
  glBindBuffer(GL_ARRAY_BUFFER, vertices_.id());
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, sizeof(OccluderVertex), nullptr);
  std::vector<uint32_t> indices;
  for (uint32_t v = 0; v < batch_vertices; v += 4)
    indices.insert(indices.end(), {v, v + 1, v + 2, v, v + 2, v + 3});
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.id());
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(uint32_t)),
               indices.data(), GL_STATIC_DRAW);
}

void DepthFaces::draw(const std::vector<PaneDraw>& draws, const std::vector<OccluderVertex>& vertices,
                      int resolution) {
  resolution_ = resolution;
  draw_.use();
  glUniform1f(in_draw_.near, near_m_);
  glViewport(0, 0, resolution, resolution);
  glBindVertexArray(quads_.id());
  glBindBuffer(GL_ARRAY_BUFFER, vertices_.id());
  const size_t bytes = vertices.size() * sizeof(OccluderVertex);
  if (bytes > capacity_) capacity_ = 2 * bytes;
  // A new store in place of one that the renderer may still read.
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(capacity_), nullptr, GL_STREAM_DRAW);
  if (bytes > 0) glBufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(bytes), vertices.data());
  glEnable(GL_SCISSOR_TEST);
  for (const PaneDraw& d : draws) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffers_[d.pane.face].id());
    glScissor(d.pane.x0, d.pane.y0, d.pane.x1 - d.pane.x0, d.pane.y1 - d.pane.y0);
    glClear(GL_DEPTH_BUFFER_BIT);
    const glm::mat3 rotation = face_from_world(d.pane.face);
    glUniformMatrix3fv(in_draw_.face_from_world, 1, GL_FALSE, glm::value_ptr(rotation));
    for (size_t n = 0; n < d.count; n += batch_vertices) {
      const size_t count = std::min(batch_vertices, d.count - n);
      glDrawElementsBaseVertex(GL_TRIANGLES, static_cast<GLsizei>(count / 4 * 6), GL_UNSIGNED_INT, nullptr,
                               static_cast<GLint>(d.first + n));
    }
  }
  glDisable(GL_SCISSOR_TEST);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);  // the faces are read now
}

void DepthFaces::reduce(const std::vector<PaneDraw>& draws, int resolution) {
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D_ARRAY, depth_.id());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, pyramid_binding, pyramid_.id());
  reduce_.use();
  glUniform1i(in_reduce_.depth, 0);
  glUniform1i(in_reduce_.resolution, resolution);
  for (const PaneDraw& d : draws) {
    constexpr int coarse = FacePanes::alignment;
    const int x0 = d.pane.x0 / coarse, y0 = d.pane.y0 / coarse;
    const int nx = d.pane.x1 / coarse - x0, ny = d.pane.y1 / coarse - y0;
    glUniform4i(in_reduce_.pane, x0, y0, nx, ny);
    glUniform1i(in_reduce_.face, d.pane.face);
    glDispatchCompute(groups(nx, 8), groups(ny, 2), 1);
  }
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

std::vector<float> DepthFaces::read(int face) const {
  const auto all = static_cast<size_t>(most_), r = static_cast<size_t>(resolution_);
  std::vector<float> texture(face_count * all * all), values;
  glBindTexture(GL_TEXTURE_2D_ARRAY, depth_.id());
  glGetTexImage(GL_TEXTURE_2D_ARRAY, 0, GL_DEPTH_COMPONENT, GL_FLOAT, texture.data());
  for (size_t y = 0; y < r; ++y) {
    const float* row = &texture[(static_cast<size_t>(face) * all + y) * all];
    values.insert(values.end(), row, row + r);
  }
  return values;
}

}  // namespace veduta
