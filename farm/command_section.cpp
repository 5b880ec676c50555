#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "farm/child.h"
#include "farm/commands.h"
#include "scene/error.h"

namespace veduta {
namespace {

struct Options {
  std::filesystem::path config, picture;
  std::optional<std::array<double, 2>> at;
  double size_m = 60;
};

/// The worker program draws, since the farm knows no geometry; it takes the place of this process.
int run_section(const Options& options) {
  std::vector<std::string> arguments{
      worker_program().string(), "--section", options.config.string(),          "--picture",
      options.picture.string(),  "--size",    fmt::format("{}", options.size_m)};
  if (options.at) arguments.push_back(fmt::format("--at={},{}", (*options.at)[0], (*options.at)[1]));
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  execv(pointers[0], pointers.data());
  throw Error(ExitStatus::input_output, arguments[0] + ": cannot be started");
}

}  // namespace

void add_section(CLI::App& app, CommandLine& line) {
  auto* const command = app.add_subcommand(
      "section", "Draw a square of a city from close: seeds, octrees, sealed space, cells, shrunk occluders");
  auto options = std::make_shared<Options>();
  command->add_option("CONFIG", options->config, "The configuration of a bake (TOML)")->required();
  command->add_option("-o,--out", options->picture, "The picture, SVG")->required();
  command
      ->add_option("--at", options->at, "X,Y: middle of the square, in the scene's CRS [that of the region]")
      ->delimiter(',');
  command->add_option("--size", options->size_m, "Edge of the square, m [60]")
      ->check(CLI::Range(1.0, 1000.0));
  command->callback([options, &line] { line.run = [options] { return run_section(*options); }; });
}

}  // namespace veduta
