#include "gl/program.h"

#include <gtest/gtest.h>

#include <optional>

#include "gl/egl_context.h"
#include "gl/handle.h"
#include "scene/error.h"

namespace veduta {
namespace {

class ProgramTest : public testing::Test {
 protected:
  void SetUp() override {
    try {
      context_.emplace("auto");
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
  }
  std::optional<EglContext> context_;
};

TEST_F(ProgramTest, ComputesIntoABuffer) {
  const Program program = Program::compute(
      "#version 430\nlayout(local_size_x = 1) in; layout(std430, binding = 0) buffer B { uint value[]; };"
      "uniform uint start; void main() { value[gl_WorkGroupID.x] = start + gl_WorkGroupID.x; }");
  const GlBuffer buffer;
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffer.id());
  glBufferData(GL_SHADER_STORAGE_BUFFER, 4 * sizeof(GLuint), nullptr, GL_DYNAMIC_READ);
  program.use();
  glUniform1ui(program.uniform("start"), 40);
  glDispatchCompute(4, 1, 1);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  GLuint value[4] = {};
  glGetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, sizeof value, value);
  EXPECT_EQ(value[0], 40u);
  EXPECT_EQ(value[3], 43u);
}

TEST_F(ProgramTest, AnErrorNamesTheStageInOneLine) {
  try {
    Program::render("#version 430\nvoid main() { gl_Position = vec4(0); }",
                    "#version 430\nvoid main() { nonsense\n again }");
    FAIL() << "compiled nonsense";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::defect);
    const std::string text = error.what();
    EXPECT_NE(text.find("fragment shader"), std::string::npos) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  }
}

TEST_F(ProgramTest, MovesOwnership) {
  const char* source = "#version 430\nlayout(local_size_x = 1) in; void main() {}";
  Program a = Program::compute(source);
  const GLuint id = a.id();
  Program b = std::move(a);
  EXPECT_EQ(b.id(), id);
  b = Program::compute(source);
  EXPECT_TRUE(glIsProgram(b.id()));
}

}  // namespace
}  // namespace veduta
