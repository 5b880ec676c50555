#include "viewer/draw/eye_targets.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/error.h"

namespace veduta {
namespace {

int limit(GLenum name) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return value;
}

}  // namespace

EyeTargets::EyeTargets(size_t eyes, uint32_t width, uint32_t height, int samples)
    : width_(width), height_(height), eyes_(eyes), pictures_(eyes) {
  const auto largest = static_cast<uint32_t>(limit(GL_MAX_TEXTURE_SIZE));
  if (std::max(width, height) > largest || width == 0 || height == 0)
    throw Error(ExitStatus::usage, fmt::format("--size: pictures of {}x{} pixels cannot be drawn; this "
                                               "driver draws 1 to {} a side",
                                               width, height, largest));
  const int most = std::min(limit(GL_MAX_COLOR_TEXTURE_SAMPLES), limit(GL_MAX_DEPTH_TEXTURE_SAMPLES));
  const GLsizei count = std::min(samples, most);
  sampled_ = count > 1;
  const auto w = static_cast<GLsizei>(width), h = static_cast<GLsizei>(height),
             layers = static_cast<GLsizei>(eyes);
  while (glGetError() != GL_NO_ERROR) {
  }
  const auto plain = [&](const GlTexture& texture, GLenum stored, GLenum given, GLenum type) {
    glBindTexture(GL_TEXTURE_2D_ARRAY, texture.id());
    glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, static_cast<GLint>(stored), w, h, layers, 0, given, type, nullptr);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_LEVEL, 0);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  };
  const auto sampled = [&](const GlTexture& texture, GLenum stored) {
    glBindTexture(GL_TEXTURE_2D_MULTISAMPLE_ARRAY, texture.id());
    glTexImage3DMultisample(GL_TEXTURE_2D_MULTISAMPLE_ARRAY, count, stored, w, h, layers, GL_TRUE);
  };
  plain(picture_, GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE);
  if (sampled_) {
    sampled(colour_, GL_SRGB8_ALPHA8);
    sampled(depth_, GL_DEPTH_COMPONENT32F);
  } else {
    plain(depth_, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT);
  }

  const GLuint colour = sampled_ ? colour_.id() : picture_.id();
  const auto check = [&] {
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE || glGetError() != GL_NO_ERROR)
      throw Error(ExitStatus::usage,
                  fmt::format("--size: the driver cannot draw {} pictures of {}x{} pixels with {} samples; "
                              "use a smaller --size",
                              eyes, width, height, std::max(count, 1)));
  };
  bind_layers();
  glFramebufferTexture(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, colour, 0);
  glFramebufferTexture(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, depth_.id(), 0);
  check();
  for (size_t eye = 0; eye < eyes; ++eye) {
    const auto layer = static_cast<GLint>(eye);
    bind_eye(eye);
    glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, colour, 0, layer);
    glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, depth_.id(), 0, layer);
    check();
    bind_picture(eye);
    glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, picture_.id(), 0, layer);
    check();
  }
}

void EyeTargets::resolve() const {
  if (!sampled_) return;
  const auto width = static_cast<GLint>(width_), height = static_cast<GLint>(height_);
  for (size_t eye = 0; eye < eyes_.size(); ++eye) {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, eyes_[eye].id());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, pictures_[eye].id());
    glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  }
}

}  // namespace veduta
