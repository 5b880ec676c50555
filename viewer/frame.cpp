#include "viewer/frame.h"

#include <epoxy/gl.h>

#include <chrono>

#include "viewer/city_pages.h"
#include "viewer/draw/visible_objects.h"
#include "viewer/frame_overlays.h"
#include "viewer/frustum.h"
#include "viewer/window/hud.h"

namespace veduta {
namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

}  // namespace

struct FrameDrawer::Parts {
  Parts(CityStream& from, const FrameOptions& how, Hud* over)
      : stream(from),
        options(how),
        hud(over),
        city(from, how.samples, how.allow_one_pass),
        margin_m(baked_eye_margin_m(from.index().header.config)) {}

  VisibleObjects visible(const ViewState& state) const {
    return visible_objects(
        stream.index(), [&](uint32_t cell) { return stream.row(cell); }, state, margin_m);
  }

  /// What is to be drawn; what of it is here has gone up.
  VisibleObjects look(const ViewState& state, const glm::vec3& velocity_m_s) {
    const Pose& from = state.frozen ? *state.frozen : state.pose;
    const bool apart = state.stereo != StereoMode::mono && state.optics.iod_m / 2 > margin_m;
    Gaze gaze{from.position_m, velocity_m_s, apart ? state.optics.iod_m / 2 * axes(from).right : glm::vec3(0),
              state.pvs == PvsUse::off || state.missing || everything ||
                  (options.wait && state.map != MapShown::off)};
    const auto see = [&] {
      if (options.wait)
        city.fetch(gaze);
      else
        city.look(gaze, options.upload_bytes);
      return visible(state);
    };
    VisibleObjects found = see();
    everything = found.everything && !found.waiting;
    // Pictures wait for all; in a window it comes from the next frame on.
    if (options.wait && everything && !gaze.everything) gaze.everything = true, found = see();
    return found;
  }

  CityStream& stream;
  const FrameOptions options;
  Hud* const hud;
  CityPages city;
  Composer composer;
  const double margin_m;
  bool everything = false;  ///< no row held in the last frame
  FrameStats last;
  uint32_t frames = 0;
  const Clock::time_point begin = Clock::now();
};

FrameDrawer::FrameDrawer(CityStream& stream, const FrameOptions& options, Hud* hud)
    : parts_(std::make_unique<Parts>(stream, options, hud)) {}
FrameDrawer::~FrameDrawer() = default;

bool FrameDrawer::one_pass() const {
  return parts_->city.painter().one_pass();
}

FrameStats FrameDrawer::draw(const ViewState& asked, const glm::vec3& velocity_m_s, const Output& output) {
  Parts& p = *parts_;
  Painter& painter = p.city.painter();
  const Clock::time_point start = Clock::now();
  ViewState state = asked;
  state.optics.aspect = picture_aspect(state.stereo, output.size);
  if (state.stereo == StereoMode::mono) state.optics.iod_m = 0;
  const glm::uvec2 size = eye_picture_size(state.stereo, output.size);
  const std::vector<Eye> both = eyes(state.stereo);

  FrameStats stats;
  stats.frame = p.frames++, stats.pose = state.pose;
  const VisibleObjects visible = p.look(state, velocity_m_s);
  const Clock::time_point culling = Clock::now();
  const Pose& from = state.frozen ? *state.frozen : state.pose;
  // One for all eyes, or one for each; none: nothing is culled.
  const std::vector<Frustum> tested = frusta(state.culling, from, state.optics, state.stereo);
  const auto lists_of = [&](const VisibleObjects& objects) {
    std::vector<CommandList> lists;
    for (const Frustum& frustum : tested) lists.push_back(p.city.lister().list(objects, {&frustum, 1}));
    if (tested.empty()) lists.push_back(p.city.lister().list(objects, {}));
    return lists;
  };
  const std::vector<CommandList> lists = lists_of(visible);
  stats.cull_ms = ms_since(culling);

  std::vector<EyeView> views;
  for (const Eye eye : both) views.push_back(eye_view(state.pose, state.optics, eye));
  painter.begin(views, size.x, size.y);
  painter.draw_city(lists);
  if (state.missing) {
    VisibleObjects everything;
    everything.everything = true;
    painter.draw_missing(lists_of(everything));
  }
  painter.draw_sky();
  VisibleObjects of_map = visible;
  if (state.map != MapShown::off && state.pvs != PvsUse::slices) {  // it shows the rows all the same
    ViewState with_rows = state;
    with_rows.pvs = PvsUse::slices;
    of_map = p.visible(with_rows);
  }
  draw_overlays(painter, p.city.lister(), p.stream.index(), state, of_map, size);
  if (p.hud) {
    p.hud->layout(state, p.last, p.stream.status(), p.stream.index(), size,
                  std::chrono::duration<double>(Clock::now() - p.begin).count());
    painter.draw_over([&] { p.hud->draw(); });
  }
  p.composer.compose(state.stereo, state.swap_eyes, painter.end(), output);

  stats.cell = visible.cell, stats.all_drawn = visible.everything, stats.waiting = visible.waiting;
  // A list for all eyes is drawn for each of them.
  const size_t times = lists.size() == 1 ? both.size() : 1;
  for (const CommandList& list : lists) {
    stats.objects = std::max(stats.objects, list.objects);
    stats.triangles += times * list.triangles;
    stats.draws += static_cast<uint32_t>(times * list.commands.size());
    stats.waiting |= list.absent > 0;
  }
  if (p.options.wait) glFinish();
  stats.ms = ms_since(start);
  return p.last = stats;
}

}  // namespace veduta
