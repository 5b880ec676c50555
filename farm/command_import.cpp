#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "farm/commands.h"
#include "scene/import.h"
#include "scene/peak_memory.h"

namespace veduta {
namespace {

struct Options {
  std::vector<std::filesystem::path> models;
  ImportOptions import;
  std::string up = "auto";
  bool json = false;
};

int run_import(Options options) {
  if (options.up != "auto") options.import.up = options.up == "y" ? UpAxis::y : UpAxis::z;
  const auto begin = std::chrono::steady_clock::now();
  const ImportResult result = import_scene(options.models, options.import);
  const double elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const double rate_mb_s = static_cast<double>(result.report.bytes_read) / 1e6 / elapsed_s;
  if (!options.json) {
    std::cout << describe(result)
              << fmt::format("{:<11}{:.2f} s, {:.1f} MB/s, {:.0f} MB of memory at most\n", "time", elapsed_s,
                             rate_mb_s, peak_memory_mb())
              << std::flush;
    return 0;
  }
  auto report = nlohmann::ordered_json::parse(describe_json(result));
  report["elapsed_s"] = elapsed_s;
  report["rate_mb_s"] = rate_mb_s;
  report["peak_memory_mb"] = peak_memory_mb();
  std::cout << report.dump(2) << std::endl;
  return 0;
}

}  // namespace

void add_import(CLI::App& app, CommandLine& line) {
  auto* const command =
      app.add_subcommand("import", "Read city models and say what was found and what was dropped");
  auto options = std::make_shared<Options>();
  command->add_option("MODEL", options->models, "Files, folders or archives; see docs/importing.md")
      ->required();
  command->add_option("--up", options->up, "Axis of the files that points up; auto: as they say")
      ->check(CLI::IsMember({"auto", "y", "z"}));
  command->add_option("--unit", options->import.unit_m, "Metres in a unit of the files; 0: as they say")
      ->check(CLI::Range(0.0, 1e6));
  command->add_option("--crs", options->import.crs,
                      "Of the scene, and of files that state none (EPSG:28992)");
  command->add_option("--height-field", options->import.height_field, "Attribute of footprints: height in m");
  command->add_option("--floors-field", options->import.floors_field, "Attribute of footprints: floors");
  command->add_option("--floor-height", options->import.floor_height_m, "Height of a floor in m")
      ->check(CLI::Range(1.0, 100.0));
  command->add_flag("--json", options->json, "Print JSON");
  auto info = std::make_shared<bool>(false);
  command->add_flag("--info", *info, "Print the report; nothing else can be done with a model on its own")
      ->required();
  command->callback([options, info, &line] { line.run = [options] { return run_import(*options); }; });
}

}  // namespace veduta
