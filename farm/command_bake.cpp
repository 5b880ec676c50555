#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "farm/bake.h"
#include "farm/commands.h"
#include "worker/settings.h"

namespace veduta {

void add_bake(CLI::App& app, CommandLine& line) {
  auto* const command =
      app.add_subcommand("bake", "Bake a city; the same command again continues (also under mpirun)");
  auto options = std::make_shared<BakeOptions>();
  auto no_merge = std::make_shared<bool>(false);
  command->add_option("CONFIG", options->config, "The configuration, TOML")->required();
  command->add_option("--out", options->out, "The run directory [out/<name of CONFIG>]");
  command
      ->add_option("--workers", options->workers,
                   "Worker processes a rank [one per GPU, or per core without one]")
      ->check(CLI::Range(1, 1024));
  command->add_option("--gpu", options->gpu,
                      "auto, software, or the number of an EGL device (veduta doctor lists them) [auto]");
  command
      ->add_option("--cell-timeout", options->cell_timeout_s,
                   "Seconds after which a silent worker is replaced [300]")
      ->check(CLI::Range(0.1, 1e6));
  command
      ->add_option("--rank-timeout", options->rank_timeout_s,
                   "Seconds after which others go on with what a silent rank had in hands [60]")
      ->check(CLI::Range(3.0, 1e6));
  command->add_flag("--fresh", options->fresh, "Start over: remove what an earlier bake left");
  command->add_flag("--dry-run", options->dry_run, "Print what would be done");
  command->add_flag("--no-merge", *no_merge, "Leave the shards; veduta merge makes the file");
  command->add_flag_callback(
      "--help-config",
      [] {
        std::cout << describe_settings();
        throw CLI::Success();
      },
      "Print every key of the configuration");
  command->callback([options, no_merge, &line] {
    line.run = [options, no_merge, &line] {
      options->merge = !*no_merge;
      options->verbosity = line.verbosity;
      options->command_line = line.typed;
      return run_bake(*options);
    };
  });
}

}  // namespace veduta
