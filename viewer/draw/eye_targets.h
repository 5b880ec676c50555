// Where the eyes' pictures are drawn: a layer for each eye.
#pragma once

#include <cstdint>
#include <vector>

#include "gl/handle.h"

namespace veduta {

/// Textures with a layer for each eye: multi-sampled ones to draw to, and a plain one for what is handed on.
class EyeTargets {
 public:
  /// \param samples of multi-sampling, as many as the driver has at most; 1: none
  /// \throw Error(usage) when the driver cannot draw pictures of this size.
  EyeTargets(size_t eyes, uint32_t width, uint32_t height, int samples);

  bool fits(size_t eyes, uint32_t width, uint32_t height) const {
    return eyes == pictures_.size() && width == width_ && height == height_;
  }
  /// Draws go to the layer that the shader names.
  void bind_layers() const { glBindFramebuffer(GL_FRAMEBUFFER, layers_.id()); }
  void bind_eye(size_t eye) const { glBindFramebuffer(GL_FRAMEBUFFER, eyes_[eye].id()); }
  /// From the samples to the pictures.
  void resolve() const;
  void bind_picture(size_t eye) const { glBindFramebuffer(GL_FRAMEBUFFER, pictures_[eye].id()); }
  /// GL_TEXTURE_2D_ARRAY, sRGB.
  GLuint pictures() const { return picture_.id(); }

 private:
  uint32_t width_, height_;
  bool sampled_;
  GlTexture colour_, depth_, picture_;
  GlFramebuffer layers_;
  std::vector<GlFramebuffer> eyes_, pictures_;  ///< one layer each
};

}  // namespace veduta
