// The faces of a panorama: occluders drawn into depth, and the pyramid over it (DESIGN §7). All of it GL.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "gl/handle.h"
#include "gl/program.h"
#include "worker/face_panes.h"
#include "worker/occluder_selection.h"

namespace veduta {

/// Binding points of the shaders' buffers.
enum PanoramaBinding : GLuint {
  pyramid_binding = 0,
  boxes_binding = 1,
  objects_binding = 2,
  slices_binding = 3,
  answers_binding = 4
};

/// What is drawn into a pane: vertices [first, first + count) of a list, four a quad.
struct PaneDraw {
  Pane pane;
  size_t first = 0, count = 0;
};

/// A depth texture with a layer for each face, in which panes are drawn and reduced. Depth is near / forward,
/// 0 where nothing is. Outside of the panes drawn last it holds leftovers.
class DepthFaces {
 public:
  /// \param resolution most pixels along a face that will be asked for; a power of two.
  /// \throw Error(defect) where the driver has no such texture.
  DepthFaces(int resolution, float near_m);

  /// Clears and draws the panes of a panorama of `resolution` pixels a face.
  void draw(const std::vector<PaneDraw>& draws, const std::vector<OccluderVertex>& vertices, int resolution);
  /// Makes the pyramid of the panes, and binds texture and pyramid for those who read them.
  void reduce(const std::vector<PaneDraw>& draws, int resolution);

  /// R*R depths of a face as drawn last, row 0 lowest.
  std::vector<float> read(int face) const;

 private:
  void make_texture();
  void make_quads();

  int most_, resolution_;  // pixels along a face: of the texture, and drawn last
  float near_m_;
  Program draw_, reduce_;
  struct {
    GLint face_from_world, near;
  } in_draw_;
  struct {
    GLint depth, pane, face, resolution;
  } in_reduce_;
  GlTexture depth_;
  std::array<GlFramebuffer, face_count> framebuffers_;
  GlVertexArray quads_;
  GlBuffer vertices_, indices_, pyramid_;
  size_t capacity_ = 0;  // of vertices_, bytes
};

}  // namespace veduta
