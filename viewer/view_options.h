// The options of veduta-view.
#pragma once

#include <cstdint>
#include <string>

#include "viewer/headless.h"

namespace CLI {
class App;
}

namespace veduta {

/// The command line as it was given; `view` holds what it means.
struct ViewCommand {
  std::string file, path, out, stats, witness, find;
  std::string stereo = "mono", size = "1280x720";
  size_t frames = 0;  ///< 0: as many as the path has
  uint64_t memory_mb = 2048;
  bool headless = false, compare = false, fullscreen = false, play = false;
  bool own_fov = true;  ///< of the triangle, where a witness is looked at and the user names none
  HeadlessOptions view;
};

void declare(CLI::App& app, ViewCommand& command);
/// What goes together, and what words mean. \throw Error(usage)
void check(ViewCommand& command);

}  // namespace veduta
