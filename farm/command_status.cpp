#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "farm/cell_map.h"
#include "farm/commands.h"
#include "farm/grants.h"
#include "farm/run_status.h"
#include "pvs/pvs_file.h"
#include "scene/error.h"

namespace veduta {
namespace {

struct Options {
  RunPaths run;
  std::filesystem::path map;
  bool json = false, exit_code = false;
};

void write_map(const Options& options, const RunStatus& status) {
  if (!status.city)
    throw Error(ExitStatus::stopped_early,
                options.run.directory.string() + ": there are no view-cells to draw before it is prepared");
  const City city = read_city(options.run.city());
  std::vector<CellProgress> progress(city.cells.size(), CellProgress::waiting);
  const auto cell_count = static_cast<uint32_t>(city.cells.size());
  const std::vector<bool> in_hands =
      status.state == "running" ? cells_in_hands(options.run.log(), cell_count) : std::vector<bool>();
  for (size_t c = 0; c < progress.size(); ++c) {
    const JournalEntry& entry = status.journal.cells[c];
    if (entry.shard >= 0)
      progress[c] = entry.status == CellStatus::all_visible ? CellProgress::all_visible : CellProgress::baked;
    else if (!in_hands.empty() && in_hands[c])
      progress[c] = CellProgress::in_hands;
  }
  write_file_atomically(options.map, cell_map_svg(city.cells, progress, status_line(options.run, status)));
}

int run_status(const Options& options) {
  const RunStatus status = read_run_status(options.run);
  std::cout << (options.json ? status_json(status) : status_line(options.run, status)) << std::endl;
  if (!options.map.empty()) write_map(options, status);
  if (!options.exit_code) return 0;
  return static_cast<int>(!status.complete()               ? ExitStatus::stopped_early
                          : status.journal.all_visible > 0 ? ExitStatus::all_visible
                                                           : ExitStatus::done);
}

}  // namespace

void add_status(CLI::App& app, CommandLine& line) {
  auto* const command =
      app.add_subcommand("status", "How far a bake is, from its journal; also while it runs");
  auto options = std::make_shared<Options>();
  command->add_option("DIR", options->run.directory, "The run directory")->required();
  command->add_flag("--json", options->json, "Print JSON");
  command->add_option("--map", options->map, "Also draw the view-cells as far as they are: an SVG file");
  command->add_flag("--exit-code", options->exit_code,
                    "0 complete, 3 complete with cells all visible, 75 not complete");
  command->callback([options, &line] { line.run = [options] { return run_status(*options); }; });
}

}  // namespace veduta
