#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>

#include "farm/commands.h"
#include "pvs/pvs_file.h"
#include "scene/import.h"

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

void add_import(CLI::App& app, CommandLine& line) {
  auto* const command =
      app.add_subcommand("import", "Read city models and say what was found and what was dropped");
  auto files = std::make_shared<std::vector<std::filesystem::path>>();
  command->add_option("MODEL", *files, "CityJSON, CityJSONSeq or OBJ")->required();
  auto info = std::make_shared<bool>(false);
  command->add_flag("--info", *info, "Print the report; nothing else can be done with a model on its own")
      ->required();
  command->callback([files, info, &line] {
    line.run = [files] {
      std::cout << describe(import_scene(*files)) << std::flush;
      return 0;
    };
  });
}

}  // namespace veduta
