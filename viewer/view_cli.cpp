#include "viewer/view_cli.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <new>
#include <optional>

#include "scene/error.h"
#include "scene/text.h"
#include "viewer/compare.h"
#include "viewer/frame_stats.h"
#include "viewer/path.h"
#include "viewer/stroll.h"
#include "viewer/tour.h"
#include "viewer/view_options.h"
#include "viewer/window/window.h"
#include "viewer/witness.h"

namespace veduta {
namespace {

constexpr size_t default_frames = 8, compared_frames = 100;

// One line, whatever words of the command line or of a file it quotes.
void warn(const std::string& line) {
  fmt::print(stderr, "veduta-view: {}\n", printable(line, 2000));
}

void make_folder(const std::string& folder) {
  std::error_code fault;
  std::filesystem::create_directories(folder, fault);
  if (fault)
    throw Error(ExitStatus::input_output, fmt::format("{}: cannot be made: {}", folder, fault.message()));
}

std::vector<Pose> choose_path(const ViewCommand& command, const CitySource& source) {
  if (!command.path.empty()) {
    const std::vector<Pose> path = read_path(command.path);
    return command.frames ? resample(path, command.frames) : path;
  }
  const PvsIndex& index = source.index();
  if (command.compare) return make_stroll(index, command.frames ? command.frames : compared_frames);
  const size_t frames = command.frames ? command.frames : command.headless ? default_frames : 1;
  const auto row = [&](uint32_t cell) { return source.read_row(index.cell_row[cell]); };
  return make_tour(index, row, frames);
}

/// By its whole name, else the first that has the text in it.
uint32_t find_object(const PvsIndex& index, const std::string& name) {
  std::optional<uint32_t> part;
  for (uint32_t object = 0; object < index.objects.size(); ++object) {
    if (index.objects[object].name == name) return object;
    if (!part && index.objects[object].name.find(name) != std::string::npos) part = object;
  }
  if (!part) throw Error(ExitStatus::usage, fmt::format("--find: no object has \"{}\" in its name", name));
  return *part;
}

void show_witness(const ViewCommand& command, std::unique_ptr<const CitySource> source) {
  const Witness witness = find_witness(source->index(), command.file, command.witness);
  HeadlessOptions options = command.view;
  if (command.own_fov) options.begin.optics.vertical_fov_deg = fov_of(witness, *source);
  make_folder(command.out);
  const size_t number = command.witness.rfind(':') + 1;  // 0 without one
  const std::filesystem::path picture =
      std::filesystem::path(command.out) / fmt::format("witness_{}.png", command.witness.substr(number));
  const std::string name = printable(source->index().objects[witness.object].name);
  const WitnessPicture drawn = draw_witness(std::move(source), witness, options, command.memory_mb << 20);
  write_png(picture, drawn.image);
  fmt::print("{}: {}, cell {}, object {} \"{}\", triangle {}: {} red pixels, {:.3g} degrees high\n",
             picture.string(), witness.gap_m > 0 ? "seen through a narrow gap" : "false invisible",
             witness.cell, witness.object, name, witness.triangle, drawn.red_pixels,
             options.begin.optics.vertical_fov_deg);
  if (drawn.red_pixels == 0) warn("what the row lacks is smaller than a pixel; try a smaller --fov");
}

void draw_pictures(const ViewCommand& command, CityStream& stream, const std::vector<Pose>& path) {
  bool said = false;
  const std::vector<FrameStats> stats =
      draw_path(stream, path, command.view, [&](const FrameStats& frame, Image&& image) {
        if (frame.all_drawn && command.view.begin.pvs != PvsUse::off && !std::exchange(said, true))
          warn(fmt::format("frame {}: the eye is outside every view-cell; everything is drawn there",
                           frame.frame));
        if (frame.frame == 0) make_folder(command.out);
        write_png(std::filesystem::path(command.out) / fmt::format("frame_{:04}.png", frame.frame), image);
      });
  if (!command.stats.empty()) write_frame_stats(command.stats, stats);

  std::vector<double> ms;
  for (const FrameStats& frame : stats) ms.push_back(frame.ms);
  std::nth_element(ms.begin(), ms.begin() + static_cast<ptrdiff_t>(ms.size() / 2), ms.end());
  fmt::print("{} pictures in {}, median {:.1f} ms each\n", stats.size(), command.out, ms[ms.size() / 2]);
}

/// \return are they equal, but for cracks?
bool compare(const ViewCommand& command, CityStream& stream, const std::vector<Pose>& path) {
  make_folder(command.out);
  const std::filesystem::path folder = command.out;
  uint64_t of_rows = 0, with_cracks = 0, different = 0, worst = 0;
  compare_with_all(
      stream, path, command.view, [&](const FrameStats& frame) { of_rows += !frame.all_drawn; },
      [&](const FrameDifference& found) {
        worst = std::max(worst, found.pixels);
        ++(found.cracks_only ? with_cracks : different);
        write_png(folder / fmt::format("frame_{:04}_pvs.png", found.frame), found.with_pvs);
        write_png(folder / fmt::format("frame_{:04}_all.png", found.frame), found.without_pvs);
      });
  fmt::print("{} frames, {} of them in view-cells: ", path.size(), of_rows);
  if (different + with_cracks == 0) fmt::print("every pixel is the same without the PVS\n");
  if (different + with_cracks > 0)
    fmt::print(
        "{} differ without the PVS, the worst in {} pixels; {} of these show, magnified, only cracks between "
        "triangles, thinner than a thousandth of a pixel; pictures are in {}\n",
        different + with_cracks, worst, with_cracks, command.out);
  return different == 0;
}

void open_window(const ViewCommand& command, CityStream& stream, const std::vector<Pose>& path) {
  WindowOptions options;
  options.width = command.view.picture.x, options.height = command.view.picture.y;
  options.fullscreen = command.fullscreen;
  options.frame = command.view.frame;
  options.begin = command.view.begin;
  options.begin.pose = path.front();
  options.begin.hud = true;
  if (!command.path.empty()) options.path = path;
  options.play = command.play;
  options.folder = command.out.empty() ? "." : command.out;
  options.stats = command.stats;
  if (!command.out.empty()) make_folder(command.out);
  show_window(stream, options);
}

ExitStatus run(ViewCommand& command) {
  ViewState& state = command.view.begin;
  check(command);
  std::unique_ptr<const CitySource> source = open_source(command.file);
  if (!command.witness.empty()) return show_witness(command, std::move(source)), ExitStatus::done;
  const std::vector<Pose> path = choose_path(command, *source);
  if (path.empty())
    throw Error(ExitStatus::bad_input,
                fmt::format("{}: has no view-cells to look from; give --path", command.file));
  if (!command.find.empty()) state.chosen = find_object(source->index(), command.find);
  if (const float parallax = parallax_at_infinity_deg(state.optics);
      state.stereo != StereoMode::mono && parallax > comfortable_parallax_deg)
    warn(
        fmt::format("far points are {:.1f} degrees apart between the eyes, over the comfortable {:.1f}; "
                    "use a larger --screen-distance or a smaller --iod",
                    parallax, comfortable_parallax_deg));
  CityStream city(std::move(source), command.memory_mb << 20);
  if (command.compare) return compare(command, city, path) ? ExitStatus::done : ExitStatus::check_failed;
  if (command.headless)
    draw_pictures(command, city, path);
  else
    open_window(command, city, path);
  return ExitStatus::done;
}

}  // namespace

int view_main(int argc, const char* const* argv) {
  CLI::App app("veduta-view: looks at a baked city, in a window or with --headless in pictures");
  ViewCommand command;
  declare(app, command);
  try {
    app.parse(argc, argv);
    return static_cast<int>(run(command));
  } catch (const CLI::CallForHelp& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    warn(fmt::format("{}; see veduta-view --help", error.what()));
    return static_cast<int>(ExitStatus::usage);
  } catch (const Error& error) {
    warn(error.what());
    return static_cast<int>(error.status());
  } catch (const std::bad_alloc&) {
    warn("out of memory");
    return static_cast<int>(ExitStatus::defect);
  } catch (const std::exception& error) {
    warn(fmt::format("a defect of ours: {}", error.what()));
    return static_cast<int>(ExitStatus::defect);
  }
}

}  // namespace veduta
