#include "farm/commands.h"

#include <CLI/CLI.hpp>
#include <iostream>

#include "farm/progress.h"
#include "farm/transport.h"
#include "scene/error.h"

namespace veduta {
namespace {

std::string quoted_for_shell(const std::string& word) {
  const bool plain = !word.empty() && word.find_first_not_of(
                                          "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                          "-_./=:,+@%") == std::string::npos;
  if (plain) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string typed_command(int argc, char** argv) {
  std::string out = "veduta";
  for (int i = 1; i < argc; ++i)
    if (const std::string word = argv[i]; word != "--fresh") out += " " + quoted_for_shell(word);
  return out;
}

/// The command line's own mistakes: one line, once, also when many ranks were started.
int report_usage(const CLI::App& app, const CLI::ParseError& error) {
  if (launched_rank().value_or(0) != 0) return static_cast<int>(ExitStatus::usage);
  if (error.get_exit_code() == 0) return app.exit(error);  // --help and --version
  say(std::string("veduta: ") + error.what() + "; see veduta --help");
  return static_cast<int>(ExitStatus::usage);
}

int run_guarded(const CommandLine& line) {
  try {
    return line.run();
  } catch (const Error& error) {
    say(std::string("veduta: ") + error.what());
    return static_cast<int>(error.status());
  } catch (const std::bad_alloc&) {
    say("veduta: not enough memory; use a machine with more");
    return static_cast<int>(ExitStatus::input_output);
  } catch (const std::exception& error) {
    say(std::string("veduta: ") + error.what() + "; this is a defect of veduta");
    return static_cast<int>(ExitStatus::defect);
  }
}

}  // namespace

int veduta_main(int argc, char** argv) {
  CommandLine line;
  line.typed = typed_command(argc, argv);
  bool verbose = false, quiet = false;
  CLI::App app{
      "Veduta bakes from-region visibility for cities: what can be seen from anywhere inside each "
      "view-cell."};
  app.set_version_flag("--version", "veduta " VEDUTA_VERSION);
  auto* const quiet_flag = app.add_flag("-q,--quiet", quiet, "Errors and results only");
  app.add_flag("-v,--verbose", verbose, "Also what the log gets")->excludes(quiet_flag);
  app.require_subcommand(1);
  app.fallthrough();
  app.footer(
      "Exit status: 0 done; 1 a check failed; 2 wrong use; 3 complete, with cells recorded all visible; 4 "
      "the run directory\n"
      "belongs to another job; 5 locked; 65 bad input; 70 a defect; 74 input/output; 75 stopped early, "
      "resumable.");
  add_bake(app, line);
  add_merge(app, line);
  add_info(app, line);
  add_verify(app, line);
  add_export(app, line);
  add_sweep(app, line);
  add_import(app, line);
  add_section(app, line);
  add_city(app, line);
  add_status(app, line);
  add_doctor(app, line);
  app.parse_complete_callback([&] {
    line.verbosity = verbose ? Verbosity::verbose : quiet ? Verbosity::quiet : Verbosity::normal;
  });
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return report_usage(app, error);
  }
  return run_guarded(line);
}

}  // namespace veduta
