#include "viewer/view_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "gl/egl_context.h"
#include "scene/error.h"

namespace veduta {
namespace {

const std::map<std::string, PvsUse> pvs_words{
    {"off", PvsUse::off}, {"buildings", PvsUse::buildings}, {"slices", PvsUse::slices}};
const std::map<std::string, Culling> cull_words{
    {"single", Culling::single_location}, {"multiple", Culling::multiple_location}, {"none", Culling::none}};
const std::map<std::string, MapShown> map_words{
    {"off", MapShown::off}, {"inset", MapShown::inset}, {"full", MapShown::full}};
const std::map<std::string, CellColour> cell_words{{"off", CellColour::off},
                                                   {"size", CellColour::pvs_size},
                                                   {"time", CellColour::bake_time},
                                                   {"worker", CellColour::worker}};

/// An option that takes one of some words.
template <typename Value>
void add_choice(CLI::App& app, const std::string& name, Value& value,
                const std::map<std::string, Value>& meanings, const std::string& description) {
  std::vector<std::string> words;
  std::string chosen;
  for (const auto& [word, meaning] : meanings) {
    words.push_back(word);
    if (meaning == value) chosen = word;
  }
  app.add_option_function<std::string>(
         name, [&value, &meanings](const std::string& word) { value = meanings.at(word); }, description)
      ->check(CLI::IsMember(words))
      ->default_str(chosen);
}

void declare_place(CLI::App& app, ViewCommand& command) {
  app.add_option("file", command.file, "City with its visibility (city.pvs.h5)")
      ->type_name("FILE")
      ->required();
  app.add_flag("--headless", command.headless, "Draw to PNG files in --out, without a window");
  app.add_option("--out", command.out, "Folder for pictures and recorded paths; made when missing")
      ->type_name("DIR");
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
  app.add_option(
         "--frames", command.frames,
         "How many pictures, evenly along the path [as many as it has; without one 8, of --compare 100]")
      ->check(CLI::Range(size_t{1}, size_t{1000000}))
      ->type_name("N")
      ->excludes(witness);
  app.add_option("--stats", command.stats, "Write a line of figures for each frame")
      ->excludes(witness)
      ->type_name("CSV");
  app.add_flag("--compare", command.compare,
               "Draw each frame with the PVS and without, keep those that differ in --out, and end with "
               "status 1 when there are any. Without --path: a walk through the cells")
      ->excludes(witness);
  app.add_flag("--play", command.play, "In a window: play --path from its start, then end");
  app.add_flag("--fullscreen", command.fullscreen, "A window over the whole screen");
}

void declare_eyes(CLI::App& app, ViewCommand& command) {
  Optics& optics = command.view.begin.optics;
  app.add_option("--stereo", command.stereo, "How the eyes' pictures are put together")
      ->excludes("--witness")
      ->check(CLI::IsMember(stereo_mode_words()))
      ->capture_default_str();
  app.add_flag("--swap-eyes", command.view.begin.swap_eyes, "Left is shown to the right eye");
  app.add_option("--size", command.size, "Pixels of one eye's picture; of a window, of the whole")
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
}

void declare_drawing(CLI::App& app, ViewCommand& command) {
  ViewState& state = command.view.begin;
  add_choice(app, "--pvs", state.pvs, pvs_words, "How much of the PVS is used; off: all is drawn");
  add_choice(app, "--cull", state.culling, cull_words,
             "Leaving out what is beside the picture: once for both eyes, for each, or not");
  add_choice(app, "--map", state.map, map_words, "The map of what is visible");
  add_choice(app, "--cells", state.cells, cell_words, "Boxes of view-cells, and what colours them");
  app.add_flag("--missing", state.missing, "Draw in red what the full model shows and the PVS lacks");
  app.add_flag("--freeze", command.view.freeze_first,
               "Keep to what is visible from the first pose; look at it from the others");
  app.add_option("--find", command.find, "A box around the object of this name, or with this in its name")
      ->type_name("NAME");
  app.add_flag("--hud", state.hud, "Write the figures of the frame over it");
  app.add_option("--memory", command.memory_mb, "Geometry and rows that are held at a time, MB")
      ->check(CLI::Range(uint64_t{16}, uint64_t{1} << 20))
      ->type_name("MB")
      ->capture_default_str();
  app.add_option("--samples", command.view.frame.samples,
                 "Of a pixel: 1 has jagged edges, and is drawn three times as fast as 4 without a GPU")
      ->check(CLI::Range(1, 16))
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--gpu", command.view.gpu, "auto, software, or the number of an EGL device (--headless)")
      ->type_name("GPU")
      ->capture_default_str();
}

glm::uvec2 parse_size(const std::string& text) {
  unsigned width = 0, height = 0;
  char rest = 0;
  const bool whole = std::sscanf(text.c_str(), "%5ux%5u%c", &width, &height, &rest) == 2;
  if (!whole || width < 1 || height < 1 || width > 16384 || height > 16384)
    throw Error(ExitStatus::usage,
                fmt::format("--size: \"{}\" is not WIDTHxHEIGHT, 1..16384 each, e.g. 1280x720", text));
  return {width, height};
}

}  // namespace

void declare(CLI::App& app, ViewCommand& command) {
  declare_place(app, command);
  declare_eyes(app, command);
  declare_drawing(app, command);
}

void check(ViewCommand& command) {
  const Optics& optics = command.view.begin.optics;
  if (std::isnan(optics.iod_m + optics.screen_distance_m +
                 optics.vertical_fov_deg))  // CLI::Range lets it pass
    throw Error(ExitStatus::usage, "--iod, --screen-distance, --fov: \"nan\" is not a number");
  command.view.picture = parse_size(command.size);
  GpuChoice::parse(command.view.gpu);
  command.view.begin.stereo = *parse_stereo_mode(command.stereo);
  if (!command.witness.empty() || command.compare) command.headless = true;
  if (command.headless && command.out.empty())
    throw Error(ExitStatus::usage, "--out: name a folder for the pictures");
  if (command.play && command.path.empty()) throw Error(ExitStatus::usage, "--play: needs a --path");
  if (command.headless && command.view.begin.stereo == StereoMode::quad_buffer)
    throw Error(ExitStatus::usage, "--stereo quad-buffer: is for a window; use side-by-side for pictures");
}

}  // namespace veduta
