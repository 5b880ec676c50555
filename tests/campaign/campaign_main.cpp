// veduta-campaign: random scenes, baked and checked, until one fails.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <iostream>

#include "gl/egl_context.h"
#include "scene/error.h"
#include "tests/campaign/campaign.h"
#include "tests/pvs/small_city.h"

namespace veduta::campaign {
namespace {

constexpr int skipped = 77;  // for ctest
constexpr double least_hidden = 0.1;

struct Options {
  CampaignOptions campaign;
  CheckOptions check;
  std::filesystem::path bake, json;
};

Outcome check_alone(const std::function<Outcome()>& check) {
  // Scenes run side by side instead.
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  return check();
}

bool gl_is_here() {
  const test::TemporaryDirectory scratch;
  Isolated isolated(scratch.path(), 60);
  return isolated
             .run([] {
               Outcome outcome;
               try {
                 const EglContext context("software");
               } catch (const Error& error) {
                 outcome.verdict = Verdict::threw;
               }
               return outcome;
             })
             .verdict == Verdict::passed;
}

int run(const Options& options) {
  if (!gl_is_here()) {
    std::cerr << "veduta-campaign: skipped: no EGL device with OpenGL 4.3 here\n";
    return skipped;
  }
  setenv("LP_NUM_THREADS", "0", 0);  // of the software renderer: as with TBB
  if (!options.bake.empty()) {
    const Outcome outcome = check_bake(load_settings(options.bake), options.check);
    std::cout << name_of(outcome.verdict) << (outcome.what.empty() ? "" : ": ") << outcome.what << "\n";
    return is_failure(outcome.verdict) ? 1 : 0;
  }
  const CampaignReport report = run_campaign(options.campaign, [&](const CampaignScene& scene) {
    return check_alone([&] { return check_scene(scene, options.check); });
  });
  std::cout << describe(report) << std::flush;
  if (!options.json.empty()) {
    std::ofstream out(options.json);
    out << describe_json(report, options.campaign) << std::flush;
    if (!out) throw Error(ExitStatus::input_output, options.json.string() + ": cannot be written");
  }
  if (report.passed() && options.campaign.numbers.empty() && report.hidden_share() < least_hidden) {
    std::cout << "almost nothing is hidden in these scenes: they test nothing\n";
    return 1;
  }
  return report.passed() ? 0 : 1;
}

int main_of(int argc, char** argv) {
  CLI::App app{
      "Bakes random scenes and checks each with rays and with segments against its occluders. Exit "
      "status: 0 none failed, 1 one did, 77 no OpenGL here."};
  Options options;
  CampaignOptions& c = options.campaign;
  app.add_option("--scenes", c.scenes, "How many [2000]")
      ->check(CLI::Range(uint64_t{1}, uint64_t{1'000'000'000}));
  app.add_option("--seed", c.seed, "Of the campaign: its scenes follow from it [1]");
  app.add_option("--scene", c.numbers, "These scenes alone, by number");
  app.add_option("--bake", options.bake, "Check this bake.toml with its model instead")
      ->check(CLI::ExistingFile);
  app.add_option("--seconds", c.seconds, "After which no scene is begun")->check(CLI::PositiveNumber);
  app.add_option("--timeout", c.timeout_s, "s; a scene that takes longer hangs [120]")
      ->check(CLI::PositiveNumber);
  app.add_option("--jobs", c.jobs, "Scenes at a time [1]")->check(CLI::Range(1u, 1024u));
  app.add_option("--rays", options.check.rays_per_cell, "Rays a cell [80000]")->check(CLI::Range(1.0, 1e12));
  app.add_option("--cells", options.check.cells, "Most cells of a scene that are baked [2]")
      ->check(CLI::Range(1, 1000));
  app.add_option("--out", c.out, "Folder for what failed, made small");
  app.add_option("--json", options.json, "Also write the report as JSON to this file");
  app.add_flag("--quiet", c.quiet, "No progress");
  try {
    app.parse(argc, argv);
    return run(options);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ExitStatus::usage);
  } catch (const Error& error) {
    std::cerr << "veduta-campaign: " << error.what() << "\n";
    return static_cast<int>(error.status());
  }
}

}  // namespace
}  // namespace veduta::campaign

int main(int argc, char** argv) {
  return veduta::campaign::main_of(argc, argv);
}
