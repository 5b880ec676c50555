#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>

#include "farm/commands.h"
#include "pvs/pvs_file.h"

namespace veduta {

void add_info(CLI::App& app, CommandLine& line) {
  struct Options {
    std::filesystem::path file;
    bool json = false;
  };
  auto* const command = app.add_subcommand("info", "Check a result and say what it holds");
  auto options = std::make_shared<Options>();
  command->add_option("FILE", options->file, "A city.pvs.h5")->required();
  command->add_flag("--json", options->json, "Print JSON");
  command->callback([options, &line] {
    line.run = [options] {
      const PvsFile file = read_pvs(options->file);
      std::cout << (options->json ? describe_json(file, options->file) : describe(file, options->file))
                << std::flush;
      return 0;
    };
  });
}

}  // namespace veduta
