#include "viewer/view_cli.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <new>

#include "gl/egl_context.h"
#include "scene/error.h"
#include "scene/text.h"
#include "viewer/path.h"
#include "viewer/tour.h"
#include "viewer/view.h"
#include "viewer/witness.h"

namespace veduta {
namespace {

constexpr size_t default_frames = 8;

struct Command {
  std::string file, path, out, stats, witness;
  std::string stereo = "mono", size = "1280x720", pvs = "on";
  size_t frames = 0;  ///< 0: as many as the path has
  bool headless = false;
  bool own_fov = true;  ///< of the triangle, where a witness is looked at and the user names none
  ViewOptions view;
};

void declare(CLI::App& app, Command& command) {
  Optics& optics = command.view.optics;
  app.add_option("file", command.file, "City with its visibility (city.pvs.h5)")
      ->type_name("FILE")
      ->required();
  app.add_flag("--headless", command.headless, "Draw to PNG files, without a window")->required();
  app.add_option("--out", command.out, "Folder for the pictures; made when missing")
      ->type_name("DIR")
      ->required();
  CLI::Option* const witness =
      app.add_option(
             "--witness", command.witness,
             "Look at an example of a verification, by its number: what the row draws, and beside it in "
             "red what it lacks. N: kept in FILE (veduta verify --store); JSON:N: of verify --json")
          ->type_name("N");
  app.add_option("--path", command.path,
                 "Eye points: x,y,z,yaw_deg,pitch_deg in m relative to the scene origin")
      ->type_name("CSV")
      ->excludes(witness);
  app.add_option("--frames", command.frames,
                 "How many pictures, evenly along the path [as many as it has; 8 without one]")
      ->check(CLI::Range(size_t{1}, size_t{1000000}))
      ->type_name("N")
      ->excludes(witness);
  app.add_option("--stereo", command.stereo, "How the eyes' pictures are put together")
      ->excludes(witness)
      ->check(CLI::IsMember(stereo_mode_words()))
      ->capture_default_str();
  app.add_option("--size", command.size, "Pixels of one eye's picture")
      ->type_name("WxH")
      ->capture_default_str();
  app.add_option("--iod", optics.iod_m, "Between the eyes, m")
      ->check(CLI::Range(0.0, 10.0))
      ->type_name("M")
      ->capture_default_str();
  app.add_option("--screen-distance", optics.screen_distance_m, "From the eyes to the plane of the screen, m")
      ->check(CLI::Range(0.1, 10000.0))
      ->type_name("M")
      ->capture_default_str();
  app.add_option_function<float>(
         "--fov", [&](float degrees) { optics.vertical_fov_deg = degrees, command.own_fov = false; },
         fmt::format("Vertical field of view, degrees [{:g}; of a witness: what shows its triangle]",
                     optics.vertical_fov_deg))
      ->check(CLI::Range(1.0, 150.0))
      ->type_name("DEG");
  app.add_option("--pvs", command.pvs, "off: draw everything, to compare")
      ->excludes(witness)
      ->check(CLI::IsMember({"on", "off"}))
      ->capture_default_str();
  app.add_option("--stats", command.stats, "Write frame, cell, objects, triangles, draws, ms per frame")
      ->excludes(witness)
      ->type_name("CSV");
  app.add_option("--gpu", command.view.gpu, "auto, software, or the number of an EGL device")
      ->type_name("GPU")
      ->capture_default_str();
}

void parse_size(const std::string& text, ViewOptions& options) {
  unsigned width = 0, height = 0;
  char rest = 0;
  const bool whole = std::sscanf(text.c_str(), "%5ux%5u%c", &width, &height, &rest) == 2;
  if (!whole || width < 1 || height < 1 || width > 16384 || height > 16384)
    throw Error(ExitStatus::usage,
                fmt::format("--size: \"{}\" is not WIDTHxHEIGHT, 1..16384 each, e.g. 1280x720", text));
  options.width = width, options.height = height;
}

std::vector<Pose> choose_path(const Command& command, const PvsFile& file) {
  if (!command.path.empty()) {
    const std::vector<Pose> path = read_path(command.path);
    return command.frames ? resample(path, command.frames) : path;
  }
  std::vector<Pose> tour = make_tour(file, command.frames ? command.frames : default_frames);
  if (tour.empty())
    throw Error(ExitStatus::bad_input,
                fmt::format("{}: has no view-cells to look from; give --path", command.file));
  return tour;
}

void warn(const std::string& line) {
  fmt::print(stderr, "veduta-view: {}\n", line);
}

void make_folder(const std::string& folder) {
  std::error_code fault;
  std::filesystem::create_directories(folder, fault);
  if (fault)
    throw Error(ExitStatus::input_output, fmt::format("{}: cannot be made: {}", folder, fault.message()));
}

void show_witness(const Command& command, const PvsFile& file) {
  const Witness witness = find_witness(file, command.file, command.witness);
  ViewOptions options = command.view;
  if (command.own_fov) options.optics.vertical_fov_deg = fov_of(witness, file.city);
  make_folder(command.out);
  const size_t number = command.witness.rfind(':') + 1;  // 0 without one
  const std::filesystem::path picture =
      std::filesystem::path(command.out) / fmt::format("witness_{}.png", command.witness.substr(number));
  const WitnessPicture drawn = draw_witness(file, witness, options);
  write_png(picture, drawn.image);
  fmt::print("{}: {}, cell {}, object {} \"{}\", triangle {}: {} red pixels, {:.3g} degrees high\n",
             picture.string(), witness.gap_m > 0 ? "seen through a narrow gap" : "false invisible",
             witness.cell, witness.object, printable(file.city.scene.objects[witness.object].name),
             witness.triangle, drawn.red_pixels, options.optics.vertical_fov_deg);
  if (drawn.red_pixels == 0) warn("what the row lacks is smaller than a pixel; try a smaller --fov");
}

void run(Command& command) {
  ViewOptions& options = command.view;
  parse_size(command.size, options);
  GpuChoice::parse(options.gpu);
  options.mode = *parse_stereo_mode(command.stereo);
  options.use_pvs = command.pvs == "on";

  const PvsFile file = read_pvs(command.file);
  if (!command.witness.empty()) return show_witness(command, file);
  const std::vector<Pose> path = choose_path(command, file);
  if (const float parallax = parallax_at_infinity_deg(options.optics);
      options.mode != StereoMode::mono && parallax > comfortable_parallax_deg)
    warn(
        fmt::format("far points are {:.1f} degrees apart between the eyes, over the comfortable {:.1f}; "
                    "use a larger --screen-distance or a smaller --iod",
                    parallax, comfortable_parallax_deg));

  make_folder(command.out);
  bool said = false;
  const std::vector<FrameStats> stats =
      view(file, path, options, [&](const FrameStats& frame, Image&& image) {
        if (frame.all_drawn && options.use_pvs && !std::exchange(said, true))
          warn(fmt::format("frame {}: the eye is outside every view-cell; everything is drawn there",
                           frame.frame));
        write_png(std::filesystem::path(command.out) / fmt::format("frame_{:04}.png", frame.frame), image);
      });
  if (!command.stats.empty()) write_stats(command.stats, stats);

  std::vector<double> ms;
  for (const FrameStats& frame : stats) ms.push_back(frame.ms);
  std::nth_element(ms.begin(), ms.begin() + static_cast<ptrdiff_t>(ms.size() / 2), ms.end());
  fmt::print("{} pictures in {}, median {:.1f} ms each\n", stats.size(), command.out, ms[ms.size() / 2]);
}

}  // namespace

int view_main(int argc, const char* const* argv) {
  CLI::App app("veduta-view: looks at a baked city");
  Command command;
  declare(app, command);
  try {
    app.parse(argc, argv);
    run(command);
    return static_cast<int>(ExitStatus::done);
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
