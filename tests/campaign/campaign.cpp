#include "tests/campaign/campaign.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "farm/progress.h"
#include "scene/random.h"
#include "tests/campaign/generate.h"
#include "tests/campaign/minimise.h"
#include "tests/pvs/small_city.h"

namespace veduta::campaign {
namespace {

constexpr size_t patience = 20;  // checks of a scene that hangs

void add(const Isolated::Answer& answer, CampaignReport& report) {
  const Outcome& o = answer.outcome;
  ++report.scenes, ++report.verdicts[o.verdict];
  report.sum.cells += o.cells, report.sum.pairs += o.pairs, report.sum.hidden += o.hidden;
  report.sum.hidden_heights += o.hidden_heights, report.sum.rays += o.rays;
  report.sum.narrow_gap_objects += o.narrow_gap_objects;
  if (answer.elapsed_s > report.slowest_s)
    report.slowest_s = answer.elapsed_s, report.slowest = answer.number;
  if (o.verdict == Verdict::turned_gap) report.turned_gaps.push_back(answer.number);
  if (is_failure(o.verdict)) report.failures.push_back({answer.number, o, {}, 0});
}

/// scene.obj, bake.toml, and what.txt for people.
void write_case(const CampaignScene& scene, const Outcome& outcome, const std::string& title,
                const std::filesystem::path& folder) {
  write_scene(scene, folder);
  std::ofstream(folder / "what.txt") << fmt::format("{}\n{}: {}\n", title, name_of(outcome.verdict),
                                                    outcome.what);
}

void keep(Failure& failure, const CampaignOptions& options, const SceneCheck& check, Isolated& isolated) {
  const CampaignScene scene = generate(failure.number);
  const std::filesystem::path folder = options.out / fmt::format("scene_{}", failure.number);
  write_case(scene, failure.outcome, fmt::format("scene {} as generated", failure.number), folder / "whole");
  // Every check of a scene that hangs may take as long as is allowed.
  const size_t most = failure.outcome.verdict == Verdict::hung ? std::min(options.minimising_checks, patience)
                                                               : options.minimising_checks;
  const Minimal minimal = minimise(
      scene, failure.outcome,
      [&](const CampaignScene& candidate) { return isolated.run([&] { return check(candidate); }); }, most);
  failure.folder = folder, failure.things = minimal.scene.things.size();
  write_case(minimal.scene, minimal.outcome,
             fmt::format("scene {}, made small in {} checks", failure.number, minimal.checks), folder);
}

}  // namespace

std::vector<uint64_t> scene_numbers(const CampaignOptions& options) {
  if (!options.numbers.empty()) return options.numbers;
  std::vector<uint64_t> numbers;
  for (uint64_t n = 0; n < options.scenes; ++n) numbers.push_back(Random(options.seed, n).bits());
  return numbers;
}

CampaignReport run_campaign(const CampaignOptions& options, const SceneCheck& check) {
  const auto began = std::chrono::steady_clock::now();
  const auto elapsed_s = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  };
  const test::TemporaryDirectory scratch;
  Isolated isolated(scratch.path(), options.timeout_s);
  Progress progress(options.quiet);
  const std::vector<uint64_t> numbers = scene_numbers(options);
  CampaignReport report;
  size_t begun = 0;
  for (;;) {
    while (isolated.running() < options.jobs && begun < numbers.size() && elapsed_s() < options.seconds) {
      const uint64_t number = numbers[begun++];
      isolated.start(number, [&check, number] { return check(generate(number)); });
    }
    if (isolated.running() == 0) break;
    const Isolated::Answer answer = isolated.next();
    add(answer, report);
    if (is_failure(answer.outcome.verdict))
      progress.note(fmt::format("scene {}: {}: {}", answer.number, name_of(answer.outcome.verdict),
                                answer.outcome.what));
    progress.work(fmt::format("scenes, {} failed:", report.failures.size()), report.scenes, numbers.size());
  }
  for (size_t f = 0; f < std::min(report.failures.size(), options.minimised) && !options.out.empty(); ++f) {
    progress.work("making small", f, report.failures.size());
    keep(report.failures[f], options, check, isolated);
  }
  report.elapsed_s = elapsed_s();
  return report;
}

}  // namespace veduta::campaign
