#include "gl/program.h"

#include <fmt/format.h>

#include <initializer_list>
#include <utility>

#include "scene/error.h"

namespace veduta {
namespace {

struct Stage {
  GLenum kind;
  const std::string& source;
};

const char* stage_name(GLenum kind) {
  return kind == GL_VERTEX_SHADER     ? "vertex shader"
         : kind == GL_FRAGMENT_SHADER ? "fragment shader"
                                      : "compute shader";
}

// The first line of a shader's or a program's log.
template <class Get, class Read>
std::string first_line(GLuint id, Get get, Read read) {
  GLint length = 0;
  get(id, GL_INFO_LOG_LENGTH, &length);
  if (length <= 1) return "the driver gives no reason";
  std::string log(static_cast<size_t>(length), '\0');
  read(id, length, &length, log.data());
  log.resize(static_cast<size_t>(length));
  return log.substr(0, log.find('\n'));
}

GLuint link(std::initializer_list<Stage> stages) {
  const GLuint program = glCreateProgram();
  std::string fault;
  for (const Stage& stage : stages) {
    const GLuint shader = glCreateShader(stage.kind);
    const char* text = stage.source.c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    GLint good = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (!good && fault.empty())
      fault = fmt::format("{}: {}", stage_name(stage.kind),
                          first_line(shader, glGetShaderiv, glGetShaderInfoLog));
    glAttachShader(program, shader);
    glDeleteShader(shader);  // goes with the program
  }
  if (fault.empty()) {
    glLinkProgram(program);
    GLint good = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &good);
    if (!good) fault = "link: " + first_line(program, glGetProgramiv, glGetProgramInfoLog);
  }
  if (!fault.empty()) {
    glDeleteProgram(program);
    throw Error(ExitStatus::defect, "GL program: " + fault);
  }
  return program;
}

}  // namespace

Program Program::render(const std::string& vertex_source, const std::string& fragment_source) {
  return Program(link({{GL_VERTEX_SHADER, vertex_source}, {GL_FRAGMENT_SHADER, fragment_source}}));
}

Program Program::compute(const std::string& source) {
  return Program(link({{GL_COMPUTE_SHADER, source}}));
}

Program::~Program() {
  if (id_) glDeleteProgram(id_);
}

Program& Program::operator=(Program&& other) noexcept {
  std::swap(id_, other.id_);
  return *this;
}

}  // namespace veduta
