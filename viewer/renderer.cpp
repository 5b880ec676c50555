// Follows thesis §5.1 (geometry in GPU buffers, index ranges chosen by the three bytes) with one element
// buffer for the whole city and one multi-draw call in place of a buffer and a call per slice.
#include "viewer/renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>

#include "scene/error.h"
#include "viewer/mesh.h"
#include "viewer/shaders.h"

namespace veduta {
namespace {

const void* buffer_offset(size_t bytes) {
  return reinterpret_cast<const void*>(bytes);
}

void allocate(GLenum target, const GlBuffer& buffer, size_t bytes, const void* data) {
  glBindBuffer(target, buffer.id());
  glBufferData(target, static_cast<GLsizeiptr>(bytes), data, GL_STATIC_DRAW);
  if (glGetError() == GL_OUT_OF_MEMORY)
    throw Error(
        ExitStatus::usage,
        fmt::format("the GPU has no room for {} MB of the scene; use --gpu software", (bytes >> 20) + 1));
}

void check_framebuffer(uint32_t width, uint32_t height) {
  const GLenum state = glCheckFramebufferStatus(GL_FRAMEBUFFER);
  if (state != GL_FRAMEBUFFER_COMPLETE)
    throw Error(ExitStatus::usage,
                fmt::format("the driver cannot draw pictures of {}x{} (state 0x{:x}); use a smaller --size",
                            width, height, state));
}

}  // namespace

Renderer::Renderer(const City& city, const IndexRanges& ranges, uint32_t width, uint32_t height, int samples)
    : width_(width),
      height_(height),
      city_program_(Program::render(city_vertex_shader(), city_fragment_shader())),
      sky_program_(Program::render(sky_vertex_shader(), sky_fragment_shader())) {
  if (epoxy_gl_version() < 45 && !epoxy_has_gl_extension("GL_ARB_clip_control"))
    throw Error(ExitStatus::usage, "gpu: the driver lacks GL_ARB_clip_control; use --gpu software");
  const Box bounds = city.scene.bounds();
  // Haze gives depth to a street without hiding the far end of the city.
  haze_m_ = std::max(3000.0f, bounds.empty() ? 0.0f : 3.0f * glm::length(bounds.upper - bounds.lower));
  upload(city, ranges);
  make_targets(samples);
}

void Renderer::upload(const City& city, const IndexRanges& ranges) {
  const Mesh mesh = make_mesh(city.scene);
  glBindVertexArray(city_array_.id());
  allocate(GL_ARRAY_BUFFER, vertices_, mesh.vertices.size() * sizeof(MeshVertex), mesh.vertices.data());
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(MeshVertex),
                        buffer_offset(offsetof(MeshVertex, position_m)));
  glVertexAttribIPointer(1, 2, GL_UNSIGNED_BYTE, sizeof(MeshVertex),
                         buffer_offset(offsetof(MeshVertex, material)));
  glVertexAttribPointer(2, 1, GL_UNSIGNED_SHORT, GL_FALSE, sizeof(MeshVertex),
                        buffer_offset(offsetof(MeshVertex, height_cm)));
  for (GLuint attribute = 0; attribute < 3; ++attribute) glEnableVertexAttribArray(attribute);

  const size_t order_bytes = mesh.corners.size() * sizeof(glm::uvec3);
  allocate(GL_ELEMENT_ARRAY_BUFFER, elements_, order_count * order_bytes, nullptr);
  std::vector<glm::uvec3> sorted(mesh.corners.size());
  for (size_t o = 0; o < order_count; ++o) {
    const std::vector<uint32_t>& order = ranges.order(static_cast<Order>(o));
    std::transform(order.begin(), order.end(), sorted.begin(), [&](uint32_t t) { return mesh.corners[t]; });
    glBufferSubData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLintptr>(o * order_bytes),
                    static_cast<GLsizeiptr>(order_bytes), sorted.data());
  }
  glBindVertexArray(0);
}

void Renderer::make_targets(int samples) {
  GLint largest = 0, most_samples = 1;
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
  glGetIntegerv(GL_MAX_SAMPLES, &most_samples);
  if (std::max(width_, height_) > static_cast<uint32_t>(largest))
    throw Error(ExitStatus::usage,
                fmt::format("--size: {}x{} is larger than this driver draws ({})", width_, height_, largest));
  const GLsizei count = samples > 1 ? std::min(samples, most_samples) : 0;
  const auto width = static_cast<GLsizei>(width_), height = static_cast<GLsizei>(height_);
  const auto attach = [&](const GlRenderbuffer& buffer, GLsizei of, GLenum format, GLenum place) {
    glBindRenderbuffer(GL_RENDERBUFFER, buffer.id());
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, of, format, width, height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, place, GL_RENDERBUFFER, buffer.id());
  };
  glBindFramebuffer(GL_FRAMEBUFFER, drawn_.id());
  attach(drawn_colour_, count, GL_SRGB8_ALPHA8, GL_COLOR_ATTACHMENT0);
  attach(drawn_depth_, count, GL_DEPTH_COMPONENT32F, GL_DEPTH_ATTACHMENT);
  check_framebuffer(width_, height_);
  glBindFramebuffer(GL_FRAMEBUFFER, resolved_.id());
  attach(resolved_colour_, 0, GL_SRGB8_ALPHA8, GL_COLOR_ATTACHMENT0);
  check_framebuffer(width_, height_);
}

void Renderer::draw(const EyeView& view, const DrawList& list) {
  glBindFramebuffer(GL_FRAMEBUFFER, drawn_.id());
  glViewport(0, 0, static_cast<GLsizei>(width_), static_cast<GLsizei>(height_));
  glEnable(GL_FRAMEBUFFER_SRGB);
  glEnable(GL_DEPTH_TEST);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glClearDepth(0);  // reversed: infinity
  glDepthMask(GL_TRUE);
  glClear(GL_DEPTH_BUFFER_BIT);  // the sky writes every pixel that the city does not
  draw_city(view, list, false);
  draw_sky(view);
  glFinish();
}

void Renderer::draw_missing(const EyeView& view, const DrawList& list) {
  // The same triangle has the same depth again, so what was drawn before stays.
  glBindFramebuffer(GL_FRAMEBUFFER, drawn_.id());
  glDepthMask(GL_TRUE);
  draw_city(view, list, true);
  glFinish();
}

void Renderer::draw_city(const EyeView& view, const DrawList& list, bool in_red) {
  if (list.commands.empty()) return;
  glDepthFunc(GL_GREATER);
  city_program_.use();
  glUniform3fv(city_program_.uniform("eye_m"), 1, glm::value_ptr(view.position_m));
  glUniformMatrix4fv(city_program_.uniform("clip_from_offset"), 1, GL_FALSE,
                     glm::value_ptr(view.clip_from_offset));
  glUniform1f(city_program_.uniform("haze_m"), haze_m_);
  glUniform1i(city_program_.uniform("in_red"), in_red);
  glBindVertexArray(city_array_.id());
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands_.id());
  glBufferData(GL_DRAW_INDIRECT_BUFFER, static_cast<GLsizeiptr>(list.commands.size() * sizeof(DrawCommand)),
               list.commands.data(), GL_STREAM_DRAW);
  glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, nullptr,
                              static_cast<GLsizei>(list.commands.size()), sizeof(DrawCommand));
}

void Renderer::draw_sky(const EyeView& view) {
  const glm::mat4& m = view.clip_from_offset;
  const glm::mat3 screen_from_offset(glm::vec3(m[0].x, m[0].y, m[0].w), glm::vec3(m[1].x, m[1].y, m[1].w),
                                     glm::vec3(m[2].x, m[2].y, m[2].w));
  const glm::mat3 offset_from_screen = glm::inverse(screen_from_offset);
  glDepthFunc(GL_EQUAL);  // only where nothing was drawn
  glDepthMask(GL_FALSE);
  sky_program_.use();
  glUniformMatrix3fv(sky_program_.uniform("offset_from_screen"), 1, GL_FALSE,
                     glm::value_ptr(offset_from_screen));
  glBindVertexArray(sky_array_.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

Image Renderer::read() {
  const auto width = static_cast<GLint>(width_), height = static_cast<GLint>(height_);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, drawn_.id());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_.id());
  glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_.id());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  Image upside_down{width_, height_, std::vector<uint8_t>(size_t{3} * width_ * height_)};
  glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, upside_down.rgb.data());
  Image image{width_, height_, {}};
  image.rgb.reserve(upside_down.rgb.size());
  const auto stride = static_cast<ptrdiff_t>(size_t{3} * width_);
  for (auto row = upside_down.rgb.end(); row != upside_down.rgb.begin(); row -= stride)
    image.rgb.insert(image.rgb.end(), row - stride, row);
  return image;
}

}  // namespace veduta
