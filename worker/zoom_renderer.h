// What method "zoom" asks of GL: depth pictures of shrunk occluders, and hardware occlusion queries of boxes
// against them.
#pragma once

#include <array>
#include <vector>

#include "gl/handle.h"
#include "gl/program.h"
#include "worker/occlusion_method.h"
#include "worker/zoom_occluders.h"
#include "worker/zoom_view.h"

namespace veduta {

/// Several pictures at a time, so that many questions are asked before the first answer is waited for. Needs
/// a current GL 4.3 context, the same for its whole life.
class ZoomRenderer {
 public:
  static constexpr int pictures = 16;

  ZoomRenderer();

  /// Sets the state of the context that pictures need, and puts back what was there.
  class Session {
   public:
    explicit Session(const ZoomRenderer& renderer);
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

   private:
    std::array<GLint, 4> viewport_{};
    bool clip_distance_, cull_face_;
  };

  /// Makes a picture anew: the occluders (none: an empty picture) before `depth_limit_m` in this view.
  /// \return triangles drawn. \pre a Session lives, here and below
  uint64_t draw(int picture, const ZoomView& view, ZoomOccluders* occluders, float depth_limit_m);

  /// Further boxes are tested in this picture, as it was drawn with this view.
  void look_at(int picture, const ZoomView& view);

  /// Asks whether a box, as it is, shows before the occluders. \return the number of the question
  uint32_t ask(const Box& box);

  /// Waits for the answers to all questions since the last call. Numbers begin at 0 again.
  void collect();
  /// The answer to a question, as collected last.
  bool shows(uint32_t question) const { return shown_[question] != 0; }

  uint64_t queries() const { return queries_; }

 private:
  struct Picture {
    GlTexture depth;
    GlFramebuffer framebuffer;
  };
  void set_view(const ZoomView& view);

  Program program_;
  GLint origin_, size_, view_from_world_, scale_, offset_;
  std::array<Picture, pictures> pictures_;
  GlVertexArray cube_;
  GlBuffer cube_corners_, cube_indices_;
  std::vector<GlQuery> questions_;
  std::vector<GLuint> shown_;
  glm::vec3 eye_{0};
  uint32_t asked_ = 0;
  uint64_t queries_ = 0;
};

}  // namespace veduta
