#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "farm/commands.h"
#include "farm/lock.h"
#include "farm/preparation_state.h"
#include "farm/run_directory.h"
#include "scene/error.h"

namespace veduta {
namespace {

struct Options {
  RunPaths run;
  bool json = false, exit_code = false;
};

/// The report is written last: after the file, unless --no-merge was given.
bool has_ended(const RunPaths& run) {
  const auto report = nlohmann::json::parse(read_text_file(run.report()).value_or(""), nullptr, false);
  std::error_code ignored;
  return report.is_object() && (report.value("merge", nlohmann::json()).is_null() ||
                                std::filesystem::exists(run.result(), ignored));
}

std::string cells_text(const Journal& journal, uint64_t total) {
  std::string text = fmt::format("cells {}/{} ({} %), {} all visible", journal.done, total,
                                 total ? 100 * journal.done / total : 100, journal.all_visible);
  if (journal.conflicts > 0)
    text += fmt::format(", {} second answers differ from the first", journal.conflicts);
  return text;
}

/// From the journal alone: works during a bake, after it, and after one that was killed.
int run_status(const Options& options) {
  const RunPaths& run = options.run;
  const auto stored = read_text_file(run.fingerprint());
  if (!stored)
    throw Error(ExitStatus::bad_input,
                run.directory.string() + ": is no run directory of veduta bake; it has no fingerprint");
  const std::string fingerprint = stored->substr(0, stored->find('\n'));
  const auto city = read_city_counts(run);
  const Journal journal =
      city ? read_journal(run, fingerprint, static_cast<uint32_t>(city->cells)) : Journal{};
  const uint64_t total = city ? city->cells : 0;
  const std::string holder = lock_holder(run.lock());
  const bool complete = city && journal.done == total && has_ended(run);
  const std::optional<PreparationState> preparation = city ? std::nullopt : read_preparation_state(run);
  const char* const state = complete ? "complete" : !holder.empty() ? "running" : "stopped";
  if (options.json)
    std::cout << nlohmann::json{{"state", state},
                                {"prepared", city.has_value()},
                                {"preparing", preparation ? name_of(preparation->stage) : ""},
                                {"parts_done", preparation ? preparation->done.size() : 0},
                                {"cells", total},
                                {"done", journal.done},
                                {"all_visible", journal.all_visible},
                                {"torn_bytes", journal.torn_bytes},
                                {"duplicates", journal.duplicates},
                                {"conflicts", journal.conflicts},
                                {"conflict_examples", journal.conflict_examples},
                                {"renderers", journal.renderers},
                                {"fingerprint", fingerprint},
                                {"holder", holder}}
                     .dump(2)
              << "\n";
  else
    std::cout << fmt::format("{}: {}{}; {}\n", run.directory.string(), state,
                             holder.empty() ? "" : " (" + holder + ")",
                             city          ? cells_text(journal, total)
                             : preparation ? fmt::format("not prepared yet: {}", name_of(preparation->stage))
                                           : "not prepared yet");
  if (!options.exit_code) return 0;
  return static_cast<int>(!complete                 ? ExitStatus::stopped_early
                          : journal.all_visible > 0 ? ExitStatus::all_visible
                                                    : ExitStatus::done);
}

}  // namespace

void add_status(CLI::App& app, CommandLine& line) {
  auto* const command =
      app.add_subcommand("status", "How far a bake is, from its journal; also while it runs");
  auto options = std::make_shared<Options>();
  command->add_option("DIR", options->run.directory, "The run directory")->required();
  command->add_flag("--json", options->json, "Print JSON");
  command->add_flag("--exit-code", options->exit_code,
                    "0 complete, 3 complete with cells all visible, 75 not complete");
  command->callback([options, &line] { line.run = [options] { return run_status(*options); }; });
}

}  // namespace veduta
