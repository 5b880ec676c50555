#include "farm/finish.h"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "farm/child.h"
#include "farm/machine.h"
#include "farm/progress.h"
#include "farm/signals.h"
#include "scene/error.h"

namespace veduta {
namespace {

using nlohmann::json;

double seconds_since(std::chrono::steady_clock::time_point then) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - then).count();
}

/// Our own `merge` as a program of its own: it can be stopped, and it does not carry MPI along.
json merge_in_child(const BakeEnd& end) {
  const auto log = end.run.directory / "workers" / fmt::format("{:04}-merge.log", end.tally.attempt);
  // By this name it is the same program also when another version was installed meanwhile.
  Child child({{"/proc/self/exe", "merge", end.run.directory.string(), "--json"}, log, {}});
  pollfd polled{child.output(), POLLIN, 0};
  const auto began = std::chrono::steady_clock::now();
  std::string said;
  while (poll(&polled, 1, 100) <= 0) {
    if (stop_requested())
      throw Error(ExitStatus::stopped_early,
                  fmt::format("{}: every cell is done, stopped before the merge; continue with: {}",
                              end.run.directory.string(), end.command_line));
    // Its progress, which it writes for nobody in particular, when it takes so long that somebody wonders.
    if (end.quiet || seconds_since(began) < 3) continue;
    if (const std::string line = last_line(log); line != said && !line.empty()) say(said = line);
  }
  const std::string answer = child.read_text();
  const std::string ending = child.reap(false);
  if (child.exit_status() == 0) return json::parse(answer);
  if (child.exit_status() <= 0)
    throw Error(ExitStatus::defect, fmt::format("{}: the merge ended with {}; see {}",
                                                end.run.directory.string(), ending, log.string()));
  std::string message = last_line(log);
  if (message.rfind("veduta: ", 0) == 0) message.erase(0, 8);
  if (message.empty())
    message = fmt::format("{}: the merge ended with {}", end.run.directory.string(), ending);
  throw Error(static_cast<ExitStatus>(child.exit_status()), message);
}

json stages_of(const BakeTally& tally) {
  json stages = json::array();
  for (const StageTally& stage : tally.stages)
    stages.push_back({{"stage", name_of(stage.stage)},
                      {"parts", stage.parts},
                      {"runs", stage.runs},
                      {"elapsed_s", stage.seconds},
                      {"worker_s", stage.worker_s},
                      {"peak_mb", stage.peak_mb}});
  return stages;
}

json report_of(const BakeEnd& end, const json& merged) {
  const BakeTally& tally = end.tally;
  const auto baked_now = tally.done - tally.resumed;
  return json{{"fingerprint", end.fingerprint},
              {"attempt", tally.attempt},
              {"ranks", end.ranks},
              {"workers_per_rank", end.workers_per_rank},
              {"renderers", tally.renderers},
              {"cells", tally.city.cells},
              {"objects", tally.city.objects},
              {"triangles", tally.city.triangles},
              {"cells_all_visible", tally.all_visible},
              {"cells_of_this_attempt", baked_now},
              {"retries", tally.retries},
              {"prepare_s", tally.prepare_s},
              {"preparation", stages_of(tally)},
              {"bake_s", tally.bake_s},
              {"mean_cell_ms",
               baked_now ? static_cast<double>(tally.bake_us) / 1000 / static_cast<double>(baked_now) : 0},
              {"elapsed_s", seconds_since(end.began)},
              {"merge", merged}};
}

void print_summary(const BakeEnd& end, const json& report) {
  const BakeTally& tally = end.tally;
  std::string renderers;
  for (const auto& renderer : tally.renderers) renderers += (renderers.empty() ? "" : "; ") + renderer;
  const auto plural = [](uint64_t count, const char* one, const char* many) {
    return fmt::format("{} {}", count, count == 1 ? one : many);
  };
  std::cout << fmt::format("{} ({} in this run, {} all visible), {}, {} x {}, {}\n",
                           plural(tally.city.cells, "cell", "cells"), tally.done - tally.resumed,
                           tally.all_visible, plural(tally.retries, "retry", "retries"),
                           plural(static_cast<uint64_t>(end.ranks), "rank", "ranks"),
                           plural(end.workers_per_rank, "worker", "workers"), renderers);
  std::cout << fmt::format("prepared in {:.1f} s, baked in {:.1f} s, {:.1f} s in all\n", tally.prepare_s,
                           tally.bake_s, seconds_since(end.began));
  if (const json& merged = report["merge"]; merged.is_object())
    std::cout << fmt::format("{} ({}), digest {}\n", end.run.result().string(),
                             bytes_text(merged.value("bytes", uint64_t{0})),
                             merged.value("content_digest", ""));
}

}  // namespace

int finish_bake(const BakeEnd& end, bool merge, RunLog& log) {
  const BakeTally& tally = end.tally;
  if (!tally.complete()) {
    const std::string how_far = tally.city.cells == 0
                                    ? "in the preparation"
                                    : fmt::format("at {} of {} cells", tally.done, tally.city.cells);
    log.info("stopped", json{{"done", tally.done}, {"cells", tally.city.cells}});
    throw Error(ExitStatus::stopped_early,
                fmt::format("{}: stopped {}; continue with: {}", end.run.directory.string(), how_far,
                            end.command_line));
  }
  const json merged = merge ? merge_in_child(end) : json();
  json report = report_of(end, merged);
  // A bake that had nothing left to do keeps what the one that did it measured.
  json before = json::parse(read_text_file(end.run.report()).value_or(""), nullptr, false);
  if (tally.resumed == tally.city.cells && before.is_object()) {
    before["merge"] = report["merge"];
    report = before;
  }
  write_file_atomically(end.run.report(), report.dump(2) + "\n");
  log.info("complete", report);
  print_summary(end, report);
  return static_cast<int>(tally.all_visible > 0 ? ExitStatus::all_visible : ExitStatus::done);
}

}  // namespace veduta
