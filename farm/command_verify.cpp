#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>

#include "farm/commands.h"
#include "farm/progress.h"
#include "farm/run_directory.h"
#include "farm/stored_form.h"
#include "scene/error.h"
#include "verify/verify.h"

namespace veduta {
namespace {

struct Options {
  std::filesystem::path file, json;
  VerifyOptions verify;
  bool store = false;
};

int run_verify(const Options& options, Verbosity verbosity) {
  const PvsFile file = read_pvs(options.file);
  Progress progress(verbosity == Verbosity::quiet);
  const VerifyReport report = verify(file, options.verify, [&](uint32_t done, uint32_t total) {
    progress.work("verifying cells", done, total);
  });
  progress.clear();
  std::cout << describe(report, file) << std::flush;
  if (!options.json.empty()) write_file_atomically(options.json, describe_json(report, file));
  if (options.store) store_verification(options.file, file, stored_form(report, options.verify));
  return static_cast<int>(report.passed() ? ExitStatus::done : ExitStatus::check_failed);
}

}  // namespace

void add_verify(CLI::App& app, CommandLine& line) {
  auto* const command = app.add_subcommand(
      "verify", "Shoot rays from sampled eye points: is anything seen that a row leaves out?");
  auto options = std::make_shared<Options>();
  command->add_option("FILE", options->file, "A city.pvs.h5")->required();
  command->add_option("--cells", options->verify.cells, "View-cells to sample [64]")
      ->check(CLI::Range(1u, 4000000000u));
  command->add_option("--rays", options->verify.rays_per_cell, "Rays a cell [1000000]")
      ->check(CLI::Range(1.0, 1e12));
  command
      ->add_option(
          "--eyes", options->verify.eyes_per_cell,
          "Eye points a cell: corners, edges, faces, inside; with 6024 or more, 1000 on each face [64]")
      ->check(CLI::Range(1u, 1000000u));
  command->add_option("--seed", options->verify.seed, "Of the sampling [1]");
  command->add_flag("--store", options->store, "Also keep the result in FILE, in place of an earlier one");
  command->add_option("--json", options->json, "Also write the report as JSON to this file");
  command->callback(
      [options, &line] { line.run = [options, &line] { return run_verify(*options, line.verbosity); }; });
}

}  // namespace veduta
