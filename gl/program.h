// A linked GL program, with errors that name the stage and quote the driver.
#pragma once

#include <epoxy/gl.h>

#include <string>

namespace veduta {

/// Owns one GL program of the current context. Move only.
class Program {
 public:
  /// \throw Error(defect) with the first line of the driver's log.
  static Program render(const std::string& vertex_source, const std::string& fragment_source);
  static Program compute(const std::string& source);

  ~Program();
  Program(Program&& other) noexcept : id_(other.id_) { other.id_ = 0; }
  Program& operator=(Program&& other) noexcept;
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  GLuint id() const { return id_; }
  void use() const { glUseProgram(id_); }
  /// -1 when no live uniform has this name; GL ignores writes to -1.
  GLint uniform(const char* name) const { return glGetUniformLocation(id_, name); }

 private:
  explicit Program(GLuint id) : id_(id) {}
  GLuint id_ = 0;
};

}  // namespace veduta
