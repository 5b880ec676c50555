// veduta-worker: one process per GPU or core. Started by the farm; speaks frames over its standard streams.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <filesystem>

#include "gl/egl_context.h"
#include "scene/error.h"
#include "worker/city_section.h"
#include "worker/worker_loop.h"

namespace {

/// A file of the prepared city that is mapped was cut short, or its disk failed. There is no way on, but to
/// say so: the shepherd takes it for any other death, and the next worker that opens the city finds out more.
void say_what_is_gone(int signal) {
  static const char text[] =
      "veduta-worker: a file of the prepared city cannot be read any more: it was cut short, or its disk "
      "fails\n";
  [[maybe_unused]] const ssize_t ignored = ::write(STDERR_FILENO, text, sizeof(text) - 1);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Veduta's worker: bakes cells that arrive as frames on standard input. Started by `veduta bake`."};
  std::string gpu = "auto";
  bool list = false, probe = false;
  app.add_option("--gpu", gpu, "EGL device: auto, software or a number")->capture_default_str();
  app.add_flag("--list", list, "Print one line per EGL device, opening none, then leave");
  app.add_flag("--probe", probe, "Print the renderer that --gpu chooses, then leave");
  std::filesystem::path config, picture;
  veduta::SectionRequest section;
  auto* const config_option =
      app.add_option("--section", config, "Draw a square of this configuration's city, then leave");
  app.add_option("--at", section.at, "Middle of the square")->needs(config_option)->delimiter(',');
  app.add_option("--size", section.size_m, "Edge of the square, m")->needs(config_option);
  app.add_option("--picture", picture, "The picture, SVG")->needs(config_option);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(veduta::ExitStatus::usage);
  }
  std::signal(SIGBUS, say_what_is_gone);
  std::signal(SIGPIPE, SIG_IGN);  // a shepherd that is gone shows as a write error
  try {
    if (!config.empty()) {
      const veduta::Settings settings = veduta::load_settings(config);
      veduta::write_section(picture, veduta::city_section(settings, section));
      return 0;
    }
    if (list) {
      for (const std::string& device : veduta::list_devices()) std::printf("%s\n", device.c_str());
      return 0;
    }
    if (!probe) {
      // Frames go to a private copy of standard output: whatever a driver prints there must not get between
      // them.
      const int frames = dup(STDOUT_FILENO);
      dup2(STDERR_FILENO, STDOUT_FILENO);
      return veduta::run_worker(STDIN_FILENO, frames, gpu);
    }
    const veduta::EglContext context(gpu);
    std::printf("%s, OpenGL %s%s\n", context.renderer().c_str(), context.version().c_str(),
                context.software() ? " (software)" : "");
    return 0;
  } catch (const veduta::Error& error) {
    std::fprintf(stderr, "veduta-worker: %s\n", error.what());
    return static_cast<int>(error.status());
  }
}
