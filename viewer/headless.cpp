#include "viewer/headless.h"

#include <optional>

#include "gl/egl_context.h"
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

}  // namespace veduta
