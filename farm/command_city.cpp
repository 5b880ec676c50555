#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "farm/commands.h"
#include "farm/progress.h"
#include "scene/city/make_city.h"
#include "scene/peak_memory.h"
#include "scene/writers/write_model.h"

namespace veduta {
namespace {

struct Options {
  std::filesystem::path config, out;
  std::optional<uint64_t> seed;
};

void note_plan(const city::MadeCity& made, Progress& progress) {
  const city::FootprintCounts& counts = made.counts;
  if (!made.plan_format.empty())
    progress.note(fmt::format(
        "{} plan: floors of {} buildings stated, of {} from their heights, of {} drawn; {} heights and {} "
        "grounds stated; {} buildings with neighbours",
        made.plan_format, counts.floors_stated, counts.floors_from_height, counts.floors_drawn,
        counts.heights_stated, counts.ground_stated, counts.with_neighbours));
  for (const auto& [reason, dropped] : made.report.dropped)
    progress.note(fmt::format("{} x {}; first: {}", dropped.count, reason, dropped.first_place));
}

int run_city(const Options& options, Verbosity verbosity) {
  city::check_writable_format(options.out);
  city::CitySettings settings = city::load_city_settings(options.config);
  if (options.seed) settings.seed = *options.seed;
  Progress progress(verbosity == Verbosity::quiet);
  const city::MadeCity made = city::make_city(
      settings, [&](uint64_t done, uint64_t total) { progress.work("deriving buildings", done, total); });
  progress.clear();
  note_plan(made, progress);
  const city::CityModel& model = made.model;
  progress.note(fmt::format("writing {}", options.out.string()));
  const city::WrittenFile written = city::write_model(model, options.out);
  const auto buildings = static_cast<double>(model.meshes.size());
  std::cout << fmt::format(
      "{}: {} buildings of {} meshes, {} triangles, {:.1f} MB; plan {:.2f} s, derive {:.2f} s ({:.0f} "
      "buildings/s), write {:.2f} s ({:.0f} MB/s, {:.2f} s of it in the file system); {:.0f} MB of memory at "
      "most\n",
      options.out.string(), model.sites.size(), model.meshes.size(), model.triangle_count(),
      static_cast<double>(written.bytes) / 1e6, made.plan_s, made.derive_s, buildings / made.derive_s,
      written.seconds, static_cast<double>(written.bytes) / 1e6 / written.seconds, written.seconds_in_system,
      peak_memory_mb());
  std::cout << std::flush;
  return 0;
}

}  // namespace

void add_city(CLI::App& app, CommandLine& line) {
  auto* const command = app.add_subcommand("city", "Make a city of plans and rules (docs/city.md)");
  auto options = std::make_shared<Options>();
  command->add_option("CONFIG", options->config, "The configuration, TOML")->required();
  command->add_option("-o,--out", options->out, "What to write: .city.json, .obj or .dxf")->required();
  command->add_option("--seed", options->seed, "In place of the configuration's")
      ->check(CLI::Range(uint64_t{0}, uint64_t{1} << 62));
  command->add_flag_callback(
      "--help-config",
      [] {
        std::cout << city::describe_city_settings();
        throw CLI::Success();
      },
      "Print every key of the configuration");
  command->callback(
      [options, &line] { line.run = [options, &line] { return run_city(*options, line.verbosity); }; });
}

}  // namespace veduta
