// veduta sweep: speed against error over a grid of settings, one point after the other, kept as it goes.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <thread>

#include "farm/commands.h"
#include "farm/fingerprint.h"
#include "farm/lock.h"
#include "farm/run_directory.h"
#include "farm/sweep_point.h"
#include "scene/error.h"
#include "sweep/chart.h"

namespace veduta {
namespace {

struct Options {
  std::filesystem::path config, out, grid;
  SweepOptions sweep;
  double recommend = 0;  ///< 0: not asked for
  bool fresh = false;
};

std::string machine() {
  std::ifstream info("/proc/cpuinfo");
  std::string model = "an unknown processor";
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name"))
      if (const size_t colon = line.find(": "); colon != std::string::npos) {
        model = line.substr(colon + 2);
        break;
      }
  return fmt::format("{} cores of {}", std::thread::hardware_concurrency(), model);
}

/// What an earlier sweep of the same configuration and question found; else an empty one.
SweepReport report_so_far(const Options& options, const Settings& base, const std::filesystem::path& file) {
  SweepReport report;
  report.title = options.config.stem().string(), report.config = to_toml(base), report.machine = machine();
  report.version = VEDUTA_VERSION;
  report.cells = options.sweep.cells, report.rays_per_cell = options.sweep.rays_per_cell;
  report.seed = options.sweep.seed;
  const auto text = options.fresh ? std::nullopt : read_text_file(file);
  if (!text) return report;
  const SweepReport before = sweep_from_json(*text, file.string());
  const auto refuse = [&](const std::string& what) {
    throw Error(ExitStatus::other_job,
                fmt::format("{}: is of another sweep: {}; use another --out, or --fresh "
                            "to start over",
                            file.string(), what));
  };
  if (before.config != report.config) refuse("its configuration differs");
  if (before.cells != report.cells) refuse(fmt::format("of {} cells, not {}", before.cells, report.cells));
  if (before.rays_per_cell != report.rays_per_cell)
    refuse(fmt::format("of {} rays a cell, not {}", before.rays_per_cell, report.rays_per_cell));
  if (before.seed != report.seed) refuse(fmt::format("of seed {}, not {}", before.seed, report.seed));
  if (before.machine != report.machine) refuse("times are of " + before.machine);
  return before;
}

std::string line_of(const SweepPoint& point) {
  if (!point.failed.empty()) return fmt::format("{}: no figures: {}", point_name(point), point.failed);
  return fmt::format(
      "{}: {:.3g} ms a cell ({:.3g} ms of processors), {:.2f}x buildings, {:.1f}x triangles, {} false "
      "invisible, {:.0f} bytes a cell",
      point_name(point), point.cell_ms, point.cell_core_ms, point.overestimate_buildings,
      point.overestimate_triangles, point.false_invisible_triangles, point.bytes_per_cell);
}

/// Points that share a preparation come together, so that one is on the disk at a time; the first stays
/// first.
class Sweep {
 public:
  Sweep(const Options& options, const std::filesystem::path& out, SweepReport report, Verbosity verbosity)
      : options_(options), out_(out), report_(std::move(report)), progress_(verbosity == Verbosity::quiet) {}

  SweepReport run(const std::vector<GridPoint>& grid) {
    std::vector<std::string> preparations;  // in the order of their coming
    std::map<std::string, std::vector<const GridPoint*>> points;
    for (const GridPoint& point : grid) {
      const std::string key = preparation_key(point.settings);
      if (!points.contains(key)) preparations.push_back(key);
      points[key].push_back(&point);
    }
    for (const std::string& key : preparations) {
      const RunPaths run{out_ / ("prepared-" + key.substr(0, 12))};
      double prepare_s = 0;
      for (const GridPoint* point : points[key]) {
        if (done(*point)) continue;
        keep(measure(run, *point, prepare_s));
      }
      std::filesystem::remove_all(run.directory);
    }
    write();  // as this version draws it, though nothing was left to measure
    return report_;
  }

 private:
  static std::string key_of(const GridPoint& point) { return make_fingerprint(point.settings).hash; }

  bool done(const GridPoint& point) const {
    const std::string key = key_of(point);
    return std::any_of(report_.points.begin(), report_.points.end(),
                       [&](const SweepPoint& before) { return before.key == key && before.failed.empty(); });
  }

  SweepPoint measure(const RunPaths& run, const GridPoint& grid, double& prepare_s) {
    SweepPoint point;
    point.changed = grid.changed;
    progress_.note(fmt::format("sweep: {}", point_name(point)));
    try {
      if (const double took_s = prepare_for_sweep(run, grid.settings, progress_); took_s > 0)
        prepare_s = took_s;
      point = sweep_point(run, grid, options_.sweep, report_.places, progress_);
      point.prepare_s = prepare_s;
    } catch (const Error& error) {
      // Without the first there is nothing to compare with, and a full disk is full for all.
      if (report_.places.empty() || error.status() == ExitStatus::input_output) throw;
      point.failed = error.what();
    }
    point.key = key_of(grid);
    point.cells_of_first = report_.points.empty() ? point.cells_in_all : report_.points.front().cells_in_all;
    return point;
  }

  void keep(SweepPoint point) {
    progress_.clear();
    progress_.note(line_of(point));
    // One that failed before is tried again.
    std::erase_if(report_.points, [&](const SweepPoint& before) { return before.key == point.key; });
    report_.points.push_back(std::move(point));
    write();
  }

  void write() const {
    write_file_atomically(out_ / "sweep.json", to_json(report_));
    write_file_atomically(out_ / "sweep.html", sweep_page(report_));
    write_file_atomically(out_ / "buildings.svg", chart_svg(report_, Chart::buildings));
    write_file_atomically(out_ / "triangles.svg", chart_svg(report_, Chart::triangles));
  }

  const Options& options_;
  std::filesystem::path out_;
  SweepReport report_;
  Progress progress_;
};

/// Says what to take, and writes it as a configuration.
int print_recommendation(const SweepReport& report, const std::vector<GridPoint>& grid, double bound,
                         const std::filesystem::path& file) {
  const int number = recommend(report, bound);
  if (number < 0) {
    fmt::print("no point has at most {:g}x buildings and nothing false invisible\n", bound);
    return static_cast<int>(ExitStatus::check_failed);
  }
  const SweepPoint& point = report.points[static_cast<size_t>(number)];
  const auto chosen = std::find_if(grid.begin(), grid.end(), [&](const GridPoint& each) {
    return make_fingerprint(each.settings).hash == point.key;
  });
  fmt::print("fastest within {:g}x buildings: {}\n", bound, line_of(point));
  if (chosen == grid.end()) return static_cast<int>(ExitStatus::done);
  write_file_atomically(file, to_toml(chosen->settings));
  fmt::print("its configuration  {}\n", file.string());
  return static_cast<int>(ExitStatus::done);
}

int run_sweep(const Options& options, Verbosity verbosity) {
  // A signal ends it: what is measured is kept, workers die with us. One of theirs that died is no signal.
  std::signal(SIGPIPE, SIG_IGN);
  const Settings base = load_settings(options.config);
  const std::vector<GridPoint> grid =
      options.grid.empty() ? default_grid(base) : read_grid(options.grid, base);
  const std::filesystem::path out =
      options.out.empty() ? std::filesystem::path("out") / "sweep" / options.config.stem() : options.out;
  std::error_code failure;
  std::filesystem::create_directories(out, failure);
  if (failure) throw Error(ExitStatus::input_output, out.string() + ": cannot be made: " + failure.message());
  const RunLock lock(out / "lock");
  const SweepReport report =
      Sweep(options, out, report_so_far(options, base, out / "sweep.json"), verbosity).run(grid);
  fmt::print("figures            {}\npage               {}\ncharts             {}, {}\n",
             (out / "sweep.json").string(), (out / "sweep.html").string(), (out / "buildings.svg").string(),
             (out / "triangles.svg").string());
  return options.recommend > 0
             ? print_recommendation(report, grid, options.recommend, out / "recommended.toml")
             : static_cast<int>(ExitStatus::done);
}

}  // namespace

void add_sweep(CLI::App& app, CommandLine& line) {
  auto* const command = app.add_subcommand(
      "sweep", "Speed against error: bake and verify a sample of cells over a grid of settings");
  auto options = std::make_shared<Options>();
  command->add_option("CONFIG", options->config, "The configuration of a bake (TOML)")->required();
  command->add_option("-o,--out", options->out,
                      "Where sweep.json, sweep.html and charts go [out/sweep/<name of CONFIG>]");
  command->add_option("--grid", options->grid,
                      "TOML: each [[grid]] is every combination of its lists, such as occlusion.subdivide = "
                      "[1, 2] [every knob by itself]");
  command->add_option("--cells", options->sweep.cells, "View-cells to sample, the same for all points [32]")
      ->check(CLI::Range(1u, 1000000u));
  command->add_option("--rays", options->sweep.rays_per_cell, "Rays a cell of the verification [1000000]")
      ->check(CLI::Range(1.0, 1e12));
  command->add_option("--seed", options->sweep.seed, "Of the sampling [1]");
  command->add_option("--gpu", options->sweep.gpu, "auto, software, or the number of an EGL device [auto]");
  command
      ->add_option("--recommend", options->recommend,
                   "Name the fastest setting within this over-estimate in buildings, write recommended.toml")
      ->check(CLI::Range(1.0, 1e6));
  command->add_flag("--fresh", options->fresh, "Measure again what was measured before");
  command->footer("The same command again goes on where it was stopped.");
  command->callback(
      [options, &line] { line.run = [options, &line] { return run_sweep(*options, line.verbosity); }; });
}

}  // namespace veduta
