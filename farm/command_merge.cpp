#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "farm/commands.h"
#include "farm/machine.h"
#include "farm/progress.h"
#include "merge/merge.h"

namespace veduta {
namespace {

struct Options {
  RunPaths run;
  std::filesystem::path output;
  bool partial = false, json = false;
};

int run_merge(const Options& options, bool quiet) {
  const auto output = options.output.empty() ? options.run.result() : options.output;
  Progress progress(quiet);
  const MergeResult result =
      merge_run(options.run, output, options.partial, [&](const char* what, uint64_t done, uint64_t total) {
        progress.work(std::string("merging: ") + what, done, total);
      });
  progress.clear();
  if (result.conflicts > 0)
    say(
        fmt::format("{}: {} second answers differ from the first, which counts; both are conservative. "
                    "See: veduta status {} --json",
                    output.string(), result.conflicts, options.run.directory.string()));
  if (options.json) {
    std::cout << nlohmann::json{{"file", output.string()},
                                {"content_digest", result.content_digest},
                                {"cells", result.cells},
                                {"baked", result.baked},
                                {"all_visible", result.all_visible},
                                {"unfinished", result.unfinished},
                                {"conflicts", result.conflicts},
                                {"bytes", result.bytes},
                                {"elapsed_s", result.elapsed_s}}
              << "\n";
  } else {
    std::cout << fmt::format(
        "{} ({}), {} cells, {} all visible, {} unfinished, merged in {:.1f} s, digest {}\n", output.string(),
        bytes_text(result.bytes), result.cells, result.all_visible, result.unfinished, result.elapsed_s,
        result.content_digest);
  }
  return 0;
}

}  // namespace

void add_merge(CLI::App& app, CommandLine& line) {
  auto* const command = app.add_subcommand("merge", "Make the result of a run directory from its shards");
  auto options = std::make_shared<Options>();
  command->add_option("DIR", options->run.directory, "The run directory")->required();
  command->add_option("-o,--output", options->output, "The file [DIR/city.pvs.h5]");
  command->add_flag("--partial", options->partial, "Record cells that are not baked yet all visible");
  command->add_flag("--json", options->json, "Print JSON");
  command->callback([options, &line] {
    line.run = [options, &line] { return run_merge(*options, line.verbosity == Verbosity::quiet); };
  });
}

}  // namespace veduta
