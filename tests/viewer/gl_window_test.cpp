#include "viewer/window/gl_window.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/pvs/small_city.h"

namespace veduta {
namespace {

// What a window shows is tested by window_test.sh, which starts a display.

TEST(GlWindow, WithoutADisplaySaysWhatToDo) {
  for (const char* display : {"", ":4711", "nonsense"}) {
    ::setenv("DISPLAY", display, 1);
    ::unsetenv("WAYLAND_DISPLAY");
    std::string said;
    EXPECT_EQ(test::status_of(
                  [] {
                    const GlWindow window("test", {64, 64}, false, false);
                  },
                  &said),
              ExitStatus::usage);
    EXPECT_NE(said.find("--headless"), std::string::npos) << said;
    EXPECT_NE(said.find("DISPLAY"), std::string::npos) << said;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace veduta
