#include "viewer/compare.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>

#include "gl/egl_context.h"
#include "scene/error.h"
#include "viewer/draw/offscreen.h"

namespace veduta {
namespace {

constexpr uint32_t magnified_pixels = 256;  // edge of the picture of one pixel and its neighbours
constexpr double magnified_edge = 3;        // pixels that it shows along an edge
constexpr uint64_t crack_pixels = magnified_pixels * magnified_pixels / 9 / 1000;  // a thousandth of a pixel
constexpr size_t most_magnified = 64;  // in a picture; where more differ, it is no crack

class Comparison {
 public:
  Comparison(CityStream& stream, const HeadlessOptions& options)
      : state_(options.begin),
        picture_(options.picture),
        drawer_(stream, waiting(options.frame), nullptr),
        whole_(output_size(state_.stereo, picture_)),
        eye_(picture_),
        magnified_({magnified_pixels, magnified_pixels}) {}

  /// Draws with the PVS, then without it.
  FrameStats draw(const Pose& pose, FrameDifference& found) {
    ViewState state = state_;
    state.pose = pose;
    return draw_both(state, whole_, found);
  }

  /// Every eye's picture is looked at by itself, its pixels that differ magnified.
  bool cracks_only(const Pose& pose) {
    for (const Eye eye : eyes(state_.stereo)) {
      ViewState state = state_;
      state.pose = pose;
      state.stereo = eye == Eye::left    ? StereoMode::left
                     : eye == Eye::right ? StereoMode::right
                                         : StereoMode::mono;
      FrameDifference found;
      draw_both(state, eye_, found);
      if (found.pixels > most_magnified) return false;
      for (uint32_t y = 0; y < picture_.y; ++y)
        for (uint32_t x = 0; x < picture_.x; ++x) {
          const size_t at = size_t{3} * (size_t{y} * picture_.x + x);
          if (std::equal(&found.with_pvs.rgb[at], &found.with_pvs.rgb[at] + 3, &found.without_pvs.rgb[at]))
            continue;
          if (!is_crack(state, eye, {x, y})) return false;
        }
    }
    return true;
  }

 private:
  static FrameOptions waiting(FrameOptions options) {
    options.wait = true;
    return options;
  }

  FrameStats draw_both(ViewState state, const Offscreen& target, FrameDifference& found) {
    const Output output{target.framebuffer(), target.size(), {0, 0}};
    const FrameStats stats = drawer_.draw(state, glm::vec3(0), output);
    found.with_pvs = read_picture(target.framebuffer(), target.size());
    state.pvs = PvsUse::off;
    drawer_.draw(state, glm::vec3(0), output);
    found.without_pvs = read_picture(target.framebuffer(), target.size());
    found.pixels = pixels_that_differ(found.with_pvs, found.without_pvs);
    return stats;
  }

  /// Through a pixel of an eye's picture, counted from the upper left, by a narrow view from the same eye.
  bool is_crack(const ViewState& of_eye, Eye eye, const glm::uvec2& pixel) {
    Optics optics = of_eye.optics;
    optics.aspect = static_cast<float>(picture_.x) / static_cast<float>(picture_.y);
    if (of_eye.stereo == StereoMode::mono) optics.iod_m = 0;
    const Axes a = axes(of_eye.pose);
    const glm::dvec2 part((pixel.x + 0.5) / picture_.x * 2 - 1, 1 - (pixel.y + 0.5) / picture_.y * 2);
    // The screen's window is that of the midpoint; the eye stands beside it.
    const glm::vec3 to = optics.screen_distance_m * a.forward +
                         static_cast<float>(part.x) * optics.half_width_m() * a.right +
                         static_cast<float>(part.y) * optics.half_height_m() * a.up -
                         static_cast<float>(eye) * optics.iod_m / 2 * a.right;
    ViewState state = of_eye;
    state.stereo = StereoMode::mono;
    state.pose.position_m = eye_view(of_eye.pose, optics, eye).position_m;
    state.pose.yaw_deg = glm::degrees(std::atan2(to.y, to.x));
    state.pose.pitch_deg = glm::degrees(std::asin(to.z / glm::length(to)));
    const double pixel_m = 2.0 * optics.half_height_m() / picture_.y;
    state.optics.vertical_fov_deg = static_cast<float>(
        glm::degrees(2 * std::atan(magnified_edge / 2 * pixel_m / double{glm::length(to)})));
    FrameDifference found;
    draw_both(state, magnified_, found);
    return found.pixels <= crack_pixels;
  }

  const ViewState state_;
  const glm::uvec2 picture_;
  FrameDrawer drawer_;
  const Offscreen whole_, eye_, magnified_;
};

}  // namespace

void compare_with_all(CityStream& stream, const std::vector<Pose>& path, const HeadlessOptions& options,
                      const std::function<void(const FrameStats&)>& drawn,
                      const std::function<void(const FrameDifference&)>& differs) {
  if (!stream.fits())
    throw Error(ExitStatus::usage,
                "--memory: the whole city is drawn for comparison and does not fit; give more");
  const EglContext context(options.gpu);
  Comparison comparison(stream, options);
  uint32_t frame = 0;
  for (const Pose& pose : path) {
    FrameDifference found;
    drawn(comparison.draw(pose, found));
    found.frame = frame++;
    if (found.pixels == 0) continue;
    found.cracks_only = comparison.cracks_only(pose);
    differs(found);
  }
}

}  // namespace veduta
