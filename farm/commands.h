// The subcommands of `veduta`. Each adds itself to the command line and says what to run when it was chosen.
#pragma once

#include <functional>
#include <string>

#include "farm/log.h"

namespace CLI {
class App;
}

namespace veduta {

/// What every subcommand shares; `run` is set by the one that was chosen and gives the exit status.
struct CommandLine {
  Verbosity verbosity = Verbosity::normal;
  std::string typed;  ///< the command as it was typed, without --fresh
  std::function<int()> run;
};

void add_bake(CLI::App& app, CommandLine& line);
void add_merge(CLI::App& app, CommandLine& line);
void add_info(CLI::App& app, CommandLine& line);
void add_verify(CLI::App& app, CommandLine& line);
void add_export(CLI::App& app, CommandLine& line);
void add_import(CLI::App& app, CommandLine& line);
void add_city(CLI::App& app, CommandLine& line);
void add_sweep(CLI::App& app, CommandLine& line);
void add_status(CLI::App& app, CommandLine& line);
void add_doctor(CLI::App& app, CommandLine& line);
void add_section(CLI::App& app, CommandLine& line);

/// The whole program. \return the exit status; errors have been printed, one line each.
int veduta_main(int argc, char** argv);

}  // namespace veduta
