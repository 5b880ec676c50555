// One cube face of 32-bit float depth, and quads to draw on it in bare loops.
//
// Vertices are what the panorama draws: four floats, the position relative to the eye and the depth limit of
// a ring; quads of two indexed triangles, clipped at the limit. Instances repeat them at other depths, so
// that a draw call is as long as it has to be for its own cost to vanish.
#pragma once

#include <epoxy/gl.h>

#include <glm/vec4.hpp>
#include <utility>
#include <vector>

#include "gl/handle.h"
#include "gl/program.h"

namespace veduta::bench {

inline constexpr const char* bare_vertex = R"(#version 430 core
layout(location = 0) in vec4 corner_and_limit;
uniform float first_near, step_near;
out gl_PerVertex { vec4 gl_Position; float gl_ClipDistance[1]; };
void main() {
  vec3 p = corner_and_limit.xyz;
  gl_Position = vec4(p.xy, first_near + step_near * float(gl_InstanceID), p.z);
  gl_ClipDistance[0] = corner_and_limit.w - p.z;
}
)";

inline constexpr const char* bare_fragment = R"(#version 430 core
void main() {}
)";

inline GLsizeiptr bytes(size_t count, size_t size) {
  return static_cast<GLsizeiptr>(count * size);
}

/// One cube face, and quads to draw on it.
class BareFace {
 public:
  explicit BareFace(int resolution)
      : resolution_(resolution), draw_(Program::render(bare_vertex, bare_fragment)) {
    glBindTexture(GL_TEXTURE_2D, depth_.id());
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_DEPTH_COMPONENT32F, resolution, resolution);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_.id(), 0);
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
    glViewport(0, 0, resolution, resolution);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glClearDepth(0.0);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glEnable(GL_CLIP_DISTANCE0);
    glBindVertexArray(array_.id());
    glBindBuffer(GL_ARRAY_BUFFER, vertices_.id());
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.id());
    glEnableVertexAttribArray(0);
    glVertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, sizeof(glm::vec4), nullptr);
    draw_.use();
  }

  /// side x side quads, a unit away, that fill the face, or its middle of so much of the edge.
  void set_quads(int side, float reach = 1) {
    corners_.clear();
    std::vector<uint32_t> indices;
    const float edge = 2.0f * reach / static_cast<float>(side);
    for (int j = 0; j < side; ++j) {
      for (int i = 0; i < side; ++i) {
        const auto v = static_cast<uint32_t>(corners_.size());
        const float x = -reach + edge * static_cast<float>(i), y = -reach + edge * static_cast<float>(j);
        for (const auto& [right, up] : {std::pair(0.0f, 0.0f), {edge, 0.0f}, {edge, edge}, {0.0f, edge}})
          corners_.emplace_back(x + right, y + up, 1, 1e9f);
        indices.insert(indices.end(), {v, v + 1, v + 2, v, v + 2, v + 3});
      }
    }
    glBufferData(GL_ARRAY_BUFFER, bytes(corners_.size(), sizeof(glm::vec4)), corners_.data(), GL_STREAM_DRAW);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, bytes(indices.size(), sizeof(uint32_t)), indices.data(),
                 GL_STATIC_DRAW);
  }

  void clear() const { glClear(GL_DEPTH_BUFFER_BIT); }

  /// All quads, `times` times: each nearer than the one before, or each farther.
  void draw(int times, bool nearer) const {
    const float step = 0.8f / static_cast<float>(times);
    draw_near(times, nearer ? 0.1f : 0.9f, nearer ? step : -step);
  }
  /// The same, once each, sent anew.
  void stream(int times) const {
    for (int n = 0; n < times; ++n) {
      glBufferSubData(GL_ARRAY_BUFFER, 0, bytes(corners_.size(), sizeof(glm::vec4)), corners_.data());
      draw_near(1, 0.1f + 0.8f * static_cast<float>(n) / static_cast<float>(times), 0);
    }
  }
  double triangles() const { return static_cast<double>(corners_.size() / 2); }
  double pixels() const { return static_cast<double>(resolution_) * resolution_; }

 private:
  void draw_near(int times, float first, float step) const {
    glUniform1f(draw_.uniform("first_near"), first);
    glUniform1f(draw_.uniform("step_near"), step);
    glDrawElementsInstanced(GL_TRIANGLES, static_cast<GLsizei>(corners_.size() / 4 * 6), GL_UNSIGNED_INT,
                            nullptr, times);
  }

  int resolution_;
  Program draw_;
  GlTexture depth_;
  GlFramebuffer framebuffer_;
  GlVertexArray array_;
  GlBuffer vertices_, indices_;
  std::vector<glm::vec4> corners_;
};

}  // namespace veduta::bench
