#include "viewer/draw/composer.h"

#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "scene/error.h"
#include "viewer/draw/composer_shaders.h"

namespace veduta {
namespace {

// Side by side: 2 across; one upon the other: 2 upright.
glm::uvec2 pictures_across(StereoMode mode) {
  switch (mode) {
    case StereoMode::side_by_side:
    case StereoMode::side_by_side_half:
    case StereoMode::cross_eyed:
      return {2, 1};
    case StereoMode::top_bottom:
    case StereoMode::top_bottom_half:
      return {1, 2};
    default:
      return {1, 1};
  }
}

bool squeezed(StereoMode mode) {
  return mode == StereoMode::side_by_side_half || mode == StereoMode::top_bottom_half;
}

// Anaglyph pairs are the plain "color anaglyph" of P. Wimmer, "Anaglyph methods comparison" (3dtv.at), by
// what the left glass lets through: red; green; amber (ColorCode 3-D, US patent 6,687,003).
struct Mix {
  glm::ivec2 counted{0};  ///< columns, rows
  glm::ivec3 from_right{0};
};

Mix mix_of(StereoMode mode) {
  switch (mode) {
    case StereoMode::interlaced_rows:
      return {{0, 1}, {}};
    case StereoMode::interlaced_columns:
      return {{1, 0}, {}};
    case StereoMode::checkerboard:
      return {{1, 1}, {}};
    case StereoMode::anaglyph_green_magenta:
      return {{}, {1, 0, 1}};
    case StereoMode::anaglyph_amber_blue:
      return {{}, {0, 0, 1}};
    default:
      return {{}, {0, 1, 1}};  // red and cyan
  }
}

// A picture's rectangle of the output.
struct Place {
  int layer;
  glm::ivec2 corner, size;  ///< lower left
};

std::vector<Place> places(StereoMode mode, int left, const glm::uvec2& output) {
  const glm::ivec2 across(pictures_across(mode)), size(glm::max(output / pictures_across(mode), 1u));
  // From the upper left corner on; GL's rows go up.
  const glm::ivec2 first{0, static_cast<int>(output.y) - size.y};
  if (across == glm::ivec2(1)) return {{left, first, size}};
  const glm::ivec2 second = first + glm::ivec2(across.x - 1, 1 - across.y) * size;
  if (mode == StereoMode::cross_eyed) left = 1 - left;
  return {{left, first, size}, {1 - left, second, size}};
}

void clear_left_over(StereoMode mode, const glm::uvec2& output) {
  if (output % pictures_across(mode) == glm::uvec2(0)) return;
  glClearColor(0, 0, 0, 1);
  glClear(GL_COLOR_BUFFER_BIT);
}

}  // namespace

glm::uvec2 eye_picture_size(StereoMode mode, const glm::uvec2& output) {
  return squeezed(mode) ? output : glm::max(output / pictures_across(mode), 1u);
}

glm::uvec2 output_size(StereoMode mode, const glm::uvec2& picture) {
  return squeezed(mode) ? picture : picture * pictures_across(mode);
}

float picture_aspect(StereoMode mode, const glm::uvec2& output) {
  const glm::vec2 size(eye_picture_size(mode, output));
  return size.x / size.y;
}

Composer::Composer()
    : squeeze_(Program::render(composer_vertex_shader(), squeeze_shader())),
      mix_(Program::render(composer_vertex_shader(), mix_shader())),
      dubois_(Program::render(composer_vertex_shader(), dubois_shader())) {
  if (!epoxy_has_gl_extension("GL_EXT_texture_sRGB_decode"))
    throw Error(ExitStatus::usage, "gpu: the driver lacks GL_EXT_texture_sRGB_decode; use --gpu software");
  // A choice of the sampler, which does not hold for texelFetch.
  glSamplerParameteri(as_stored_.id(), GL_TEXTURE_SRGB_DECODE_EXT, GL_SKIP_DECODE_EXT);
  glSamplerParameteri(as_stored_.id(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glSamplerParameteri(as_stored_.id(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glSamplerParameteri(as_stored_.id(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glSamplerParameteri(as_stored_.id(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

void Composer::compose(StereoMode mode, bool swap_eyes, uint32_t pictures, const Output& output) {
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, output.framebuffer);
  for (GLenum feature : {GL_DEPTH_TEST, GL_BLEND, GL_CULL_FACE, GL_SCISSOR_TEST, GL_FRAMEBUFFER_SRGB})
    glDisable(feature);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D_ARRAY, pictures);
  glBindSampler(0, as_stored_.id());
  glBindVertexArray(array_.id());

  const int left = swap_eyes && eyes(mode).size() > 1 ? 1 : 0;
  if (mode == StereoMode::quad_buffer)
    copy_to_both_buffers(left, pictures, output);
  else if (squeezed(mode))
    squeeze(mode, left, output);
  else if (pictures_across(mode) != glm::uvec2(1) || eyes(mode).size() == 1)
    copy(mode, left, pictures, output);
  else
    mix(mode, left, output);

  glBindSampler(0, 0);
  glBindVertexArray(0);
}

void Composer::copy_to_both_buffers(int left, uint32_t pictures, const Output& output) {
  GLboolean stereo = GL_FALSE;
  glGetBooleanv(GL_STEREO, &stereo);
  if (!stereo || output.framebuffer != 0) return copy(StereoMode::mono, left, pictures, output);
  glDrawBuffer(GL_BACK_LEFT);
  copy(StereoMode::mono, left, pictures, output);
  glDrawBuffer(GL_BACK_RIGHT);
  copy(StereoMode::mono, 1 - left, pictures, output);
  glDrawBuffer(GL_BACK);
}

void Composer::copy(StereoMode mode, int left, uint32_t pictures, const Output& output) {
  clear_left_over(mode, output.size);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, one_picture_.id());
  for (const auto& [layer, corner, size] : places(mode, left, output.size)) {
    glFramebufferTextureLayer(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, pictures, 0, layer);
    // Without GL_FRAMEBUFFER_SRGB no value is changed on the way.
    glBlitFramebuffer(0, 0, size.x, size.y, corner.x, corner.y, corner.x + size.x, corner.y + size.y,
                      GL_COLOR_BUFFER_BIT, GL_NEAREST);
  }
}

void Composer::squeeze(StereoMode mode, int left, const Output& output) {
  clear_left_over(mode, output.size);
  const glm::ivec2 across(pictures_across(mode)), whole(output.size);
  start(squeeze_, mode, output);
  glUniform2i(squeeze_.uniform("squeeze"), across.x, across.y);
  glUniform1i(squeeze_.uniform("first_row"), whole.y % across.y);
  for (const auto& [layer, corner, size] : places(mode, left, output.size)) {
    glViewport(corner.x, corner.y, size.x, size.y);
    glUniform2i(squeeze_.uniform("origin"), corner.x, corner.y);
    glUniform1i(squeeze_.uniform("layer"), layer);
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }
}

void Composer::mix(StereoMode mode, int left, const Output& output) {
  const glm::ivec2 size(output.size);
  const Program& program = mode == StereoMode::anaglyph ? dubois_ : mix_;
  start(program, mode, output);
  const auto [counted, from_right] = mix_of(mode);
  glUniform2i(program.uniform("counted"), counted.x, counted.y);
  glUniform3i(program.uniform("from_right"), from_right.x, from_right.y, from_right.z);
  // GL's rows go up, the screen's down; modulo 2 that is the same.
  glUniform2i(program.uniform("first"), output.screen_position.x, output.screen_position.y + size.y - 1);
  glUniform1i(program.uniform("layer"), left);
  glViewport(0, 0, size.x, size.y);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void Composer::start(const Program& program, StereoMode mode, const Output& output) {
  const glm::vec2 texel = 1.0f / glm::vec2(eye_picture_size(mode, output.size));
  program.use();
  glUniform2f(program.uniform("texel"), texel.x, texel.y);
}

}  // namespace veduta
