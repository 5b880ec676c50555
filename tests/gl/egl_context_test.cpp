#include "gl/egl_context.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <optional>

#include "scene/error.h"

namespace veduta {
namespace {

ExitStatus status_of(const std::string& gpu) {
  try {
    const EglContext context(gpu);
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.status();
  }
  return ExitStatus::done;
}

TEST(EglContext, ChoiceIsAutoSoftwareOrANumber) {
  EXPECT_EQ(GpuChoice::parse("auto").mode, GpuChoice::Mode::automatic);
  EXPECT_EQ(GpuChoice::parse("software").mode, GpuChoice::Mode::software);
  EXPECT_EQ(GpuChoice::parse("3").mode, GpuChoice::Mode::device);
  EXPECT_EQ(GpuChoice::parse("3").device, 3u);
  for (const char* wrong : {"", "hardware", "-1", "1x", "99999999999"})
    EXPECT_THROW(GpuChoice::parse(wrong), Error) << wrong;
}

TEST(EglContext, AMissingDeviceIsAUsageError) {
  EXPECT_EQ(status_of("4000000"), ExitStatus::usage);
}

TEST(EglContext, SoftwareDrawsWithoutASurface) {
  std::optional<EglContext> context;
  try {
    context.emplace("software");
  } catch (const Error& error) {
    GTEST_SKIP() << error.what();
  }
  EXPECT_TRUE(context->software()) << context->renderer();
  EXPECT_GE(epoxy_gl_version(), 43);
  EXPECT_FALSE(list_devices().empty());
  glClear(GL_COLOR_BUFFER_BIT);
}

TEST(EglContext, ASecondContextWorksAfterTheFirstIsGone) {
  for (int round = 0; round < 2; ++round) {
    std::optional<EglContext> context;
    try {
      context.emplace("auto");
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
    EXPECT_NE(glGetString(GL_VERSION), nullptr);
    EXPECT_FALSE(context->renderer().empty());
  }
}

}  // namespace
}  // namespace veduta
