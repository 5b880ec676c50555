#include "viewer/headless.h"

#include <optional>

#include "gl/egl_context.h"
#include "scene/error.h"
#include "viewer/draw/offscreen.h"
#include "viewer/window/hud.h"

namespace veduta {

std::vector<FrameStats> draw_path(CityStream& stream, const std::vector<Pose>& path,
                                  const HeadlessOptions& options,
                                  const std::function<void(const FrameStats&, Image&&)>& show) {
  const EglContext context(options.gpu);
  ViewState state = options.begin;
  const Offscreen target(output_size(state.stereo, options.picture));
  std::optional<Hud> hud;
  if (state.hud || state.help || state.map != MapShown::off || state.cells != CellColour::off) hud.emplace();
  FrameOptions how = options.frame;
  how.wait = true;
  FrameDrawer drawer(stream, how, hud ? &*hud : nullptr);
  if (options.freeze_first && !path.empty()) state.frozen = path.front();

  std::vector<FrameStats> stats;
  for (const Pose& pose : path) {
    state.pose = pose;
    stats.push_back(drawer.draw(state, glm::vec3(0), {target.framebuffer(), target.size(), {0, 0}}));
    show(stats.back(), read_picture(target.framebuffer(), target.size()));
  }
  return stats;
}

uint32_t compare_with_all(CityStream& stream, const std::vector<Pose>& path, const HeadlessOptions& options,
                          const std::function<void(const FrameStats&)>& drawn,
                          const std::function<void(const FrameDifference&)>& differs) {
  if (!stream.fits())
    throw Error(ExitStatus::usage,
                "--memory: the whole city is drawn for comparison and does not fit; give more");
  const EglContext context(options.gpu);
  const Offscreen target(output_size(options.begin.stereo, options.picture));
  const Output output{target.framebuffer(), target.size(), {0, 0}};
  FrameOptions how = options.frame;
  how.wait = true;
  FrameDrawer drawer(stream, how, nullptr);
  ViewState state = options.begin, all = options.begin;
  all.pvs = PvsUse::off;
  uint32_t different = 0;
  for (const Pose& pose : path) {
    state.pose = all.pose = pose;
    const FrameStats stats = drawer.draw(state, glm::vec3(0), output);
    FrameDifference found{different, 0, read_picture(target.framebuffer(), target.size()), {}};
    drawer.draw(all, glm::vec3(0), output);
    found.without_pvs = read_picture(target.framebuffer(), target.size());
    found.frame = stats.frame / 2;
    found.pixels = pixels_that_differ(found.with_pvs, found.without_pvs);
    drawn(stats);
    if (found.pixels > 0) ++different, differs(found);
  }
  return different;
}

}  // namespace veduta
