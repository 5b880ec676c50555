#include "worker/zoom_renderer.h"

#include <glm/gtc/type_ptr.hpp>

#include "scene/error.h"
#include "worker/zoom_shaders.h"

namespace veduta {
namespace {

/// Corner c of the unit cube has bit 0, 1, 2 of c as its coordinates. Counter-clockwise from outside.
constexpr std::array<uint8_t, 36> cube_triangles{0, 4, 6, 0, 6, 2,   // x = 0
                                                 1, 3, 7, 1, 7, 5,   // x = 1
                                                 0, 1, 5, 0, 5, 4,   // y = 0
                                                 2, 6, 7, 2, 7, 3,   // y = 1
                                                 0, 2, 3, 0, 3, 1,   // z = 0
                                                 4, 5, 7, 4, 7, 6};  // z = 1

}  // namespace

ZoomRenderer::ZoomRenderer()
    : program_(Program::render(shader::zoom_vertex, shader::zoom_fragment)),
      origin_(program_.uniform("origin")),
      size_(program_.uniform("size")),
      view_from_world_(program_.uniform("view_from_world")),
      scale_(program_.uniform("scale")),
      offset_(program_.uniform("offset")) {
  for (const Picture& picture : pictures_) {
    glBindTexture(GL_TEXTURE_2D, picture.depth.id());
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_DEPTH_COMPONENT32F, ZoomView::most_width, ZoomView::most_height);
    glBindFramebuffer(GL_FRAMEBUFFER, picture.framebuffer.id());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, picture.depth.id(), 0);
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
      throw Error(ExitStatus::defect, "occlusion: the driver takes no 32-bit float depth picture");
  }
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  std::vector<glm::vec3> corners;
  for (int c = 0; c < 8; ++c) corners.emplace_back(c & 1, c >> 1 & 1, c >> 2);
  glBindVertexArray(cube_.id());
  glBindBuffer(GL_ARRAY_BUFFER, cube_corners_.id());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(corners.size() * sizeof(glm::vec3)), corners.data(),
               GL_STATIC_DRAW);
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(glm::vec3), nullptr);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, cube_indices_.id());
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, sizeof(cube_triangles), cube_triangles.data(), GL_STATIC_DRAW);
  glBindVertexArray(0);
}

ZoomRenderer::Session::Session(const ZoomRenderer& renderer)
    : clip_distance_(glIsEnabled(GL_CLIP_DISTANCE0)), cull_face_(glIsEnabled(GL_CULL_FACE)) {
  glGetIntegerv(GL_VIEWPORT, viewport_.data());
  glDisable(GL_CLIP_DISTANCE0);
  glEnable(GL_CULL_FACE);  // of bodies and boxes alike: what faces away is behind what faces the eye
  // As the panorama has it: the larger depth is the nearer.
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  glClearDepth(0.0);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  renderer.program_.use();
  glUniform1f(renderer.program_.uniform("near"), ZoomView::near_m);
}

ZoomRenderer::Session::~Session() {
  if (clip_distance_) glEnable(GL_CLIP_DISTANCE0);
  if (!cull_face_) glDisable(GL_CULL_FACE);
  glDepthMask(GL_TRUE);
  glBindVertexArray(0);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
}

void ZoomRenderer::set_view(const ZoomView& view) {
  eye_ = view.eye;
  const glm::vec2 extent = view.upper - view.lower;
  const glm::vec2 scale = 2.0f / extent, offset = -(view.lower + view.upper) / extent;
  glUniformMatrix3fv(view_from_world_, 1, GL_FALSE, glm::value_ptr(view.view_from_world));
  glUniform2fv(scale_, 1, glm::value_ptr(scale));
  glUniform2fv(offset_, 1, glm::value_ptr(offset));
  glViewport(0, 0, view.width, view.height);
}

uint64_t ZoomRenderer::draw(int picture, const ZoomView& view, ZoomOccluders* occluders,
                            float depth_limit_m) {
  glBindFramebuffer(GL_FRAMEBUFFER, pictures_[picture].framebuffer.id());
  glDepthMask(GL_TRUE);
  glClear(GL_DEPTH_BUFFER_BIT);
  if (occluders == nullptr) return 0;
  set_view(view);
  const glm::vec3 to_eye = -view.eye, one(1);
  glUniform3fv(origin_, 1, glm::value_ptr(to_eye));
  glUniform3fv(size_, 1, glm::value_ptr(one));
  return occluders->draw(ZoomFrustum(view, depth_limit_m));
}

void ZoomRenderer::look_at(int picture, const ZoomView& view) {
  glBindFramebuffer(GL_FRAMEBUFFER, pictures_[picture].framebuffer.id());
  glDepthMask(GL_FALSE);
  set_view(view);
  glBindVertexArray(cube_.id());
}

uint32_t ZoomRenderer::ask(const Box& box) {
  if (asked_ == questions_.size()) questions_.emplace_back();
  const glm::vec3 origin = box.lower - eye_, size = box.upper - box.lower;
  glUniform3fv(origin_, 1, glm::value_ptr(origin));
  glUniform3fv(size_, 1, glm::value_ptr(size));
  glBeginQuery(GL_ANY_SAMPLES_PASSED, questions_[asked_].id());
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(cube_triangles.size()), GL_UNSIGNED_BYTE, nullptr);
  glEndQuery(GL_ANY_SAMPLES_PASSED);
  ++queries_;
  return asked_++;
}

void ZoomRenderer::collect() {
  shown_.resize(asked_);
  // Every one, needed or not: llvmpipe (Mesa 22) counts into a query that is begun again while its last use
  // is still in work.
  for (uint32_t q = 0; q < asked_; ++q) glGetQueryObjectuiv(questions_[q].id(), GL_QUERY_RESULT, &shown_[q]);
  asked_ = 0;
}

}  // namespace veduta
