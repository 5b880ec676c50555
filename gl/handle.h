// Owners of GL objects of the current context.
#pragma once

#include <epoxy/gl.h>

#include <utility>

namespace veduta {

/// What makes and deletes one kind of GL object.
struct BufferKind {
  static void make(GLuint* id) { glGenBuffers(1, id); }
  static void drop(const GLuint* id) { glDeleteBuffers(1, id); }
};
struct TextureKind {
  static void make(GLuint* id) { glGenTextures(1, id); }
  static void drop(const GLuint* id) { glDeleteTextures(1, id); }
};
struct FramebufferKind {
  static void make(GLuint* id) { glGenFramebuffers(1, id); }
  static void drop(const GLuint* id) { glDeleteFramebuffers(1, id); }
};
struct RenderbufferKind {
  static void make(GLuint* id) { glGenRenderbuffers(1, id); }
  static void drop(const GLuint* id) { glDeleteRenderbuffers(1, id); }
};
struct VertexArrayKind {
  static void make(GLuint* id) { glGenVertexArrays(1, id); }
  static void drop(const GLuint* id) { glDeleteVertexArrays(1, id); }
};
struct SamplerKind {
  static void make(GLuint* id) { glGenSamplers(1, id); }
  static void drop(const GLuint* id) { glDeleteSamplers(1, id); }
};
struct QueryKind {
  static void make(GLuint* id) { glGenQueries(1, id); }
  static void drop(const GLuint* id) { glDeleteQueries(1, id); }
};

/// One GL object; made when constructed, deleted with the handle. Move only. Must not outlive its context.
template <class ObjectKind>
class Handle {
 public:
  Handle() { ObjectKind::make(&id_); }
  ~Handle() {
    if (id_) ObjectKind::drop(&id_);
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  GLuint id() const { return id_; }

 private:
  GLuint id_ = 0;
};

using GlBuffer = Handle<BufferKind>;
using GlTexture = Handle<TextureKind>;
using GlFramebuffer = Handle<FramebufferKind>;
using GlRenderbuffer = Handle<RenderbufferKind>;
using GlVertexArray = Handle<VertexArrayKind>;
using GlSampler = Handle<SamplerKind>;
using GlQuery = Handle<QueryKind>;

}  // namespace veduta
