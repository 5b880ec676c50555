#include "viewer/view.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <fstream>

#include "gl/egl_context.h"
#include "scene/error.h"
#include "viewer/active_cells.h"
#include "viewer/compose.h"
#include "viewer/draw_list.h"
#include "viewer/renderer.h"

namespace veduta {
namespace {

using Clock = std::chrono::steady_clock;

double elapsed_ms(Clock::time_point since) {
  return std::chrono::duration<double, std::milli>(Clock::now() - since).count();
}

}  // namespace

std::vector<FrameStats> view(const PvsFile& file, const std::vector<Pose>& path, const ViewOptions& options,
                             const std::function<void(const FrameStats&, Image&&)>& show) {
  Optics optics = options.optics;
  optics.aspect = static_cast<float>(options.width) / static_cast<float>(options.height);
  if (options.mode == StereoMode::mono) optics.iod_m = 0;
  const double margin_m = baked_eye_margin_m(file.header.config);

  const EglContext context(options.gpu);
  const IndexRanges ranges(file.city);
  const DrawLister lister(file.city, ranges);
  Renderer renderer(file.city, ranges, options.width, options.height, options.samples);

  std::vector<FrameStats> stats;
  for (const Pose& pose : path) {
    FrameStats frame;
    frame.frame = static_cast<uint32_t>(stats.size());
    const Clock::time_point start = Clock::now();
    ActiveCells active = active_cells(file, pose, optics, options.mode, margin_m);
    active.everything |= !options.use_pvs;
    const Frustum frustum = single_location_frustum(pose, optics);
    const DrawList list = lister.list(active, options.cull ? &frustum : nullptr);
    frame.ms = elapsed_ms(start);

    std::vector<Image> pictures;
    for (Eye eye : eyes(options.mode)) {
      const Clock::time_point begin = Clock::now();
      renderer.draw(eye_view(pose, optics, eye), list);
      frame.ms += elapsed_ms(begin);
      pictures.push_back(renderer.read());
    }
    frame.cell = active.cell, frame.all_drawn = active.everything;
    frame.objects = list.objects, frame.triangles = list.triangles;
    frame.draws = static_cast<uint32_t>(list.commands.size());
    stats.push_back(frame);
    show(frame, compose(options.mode, pictures));
  }
  return stats;
}

void write_stats(const std::filesystem::path& file, const std::vector<FrameStats>& stats) {
  const std::filesystem::path part = fmt::format("{}.{}.part", file.string(), getpid());
  std::ofstream stream(part);
  stream << "frame,cell,objects,triangles,draws,ms\n";
  for (const FrameStats& f : stats)
    stream << fmt::format("{},{},{},{},{},{:.3f}\n", f.frame, f.cell, f.objects, f.triangles, f.draws, f.ms);
  stream.close();
  std::error_code fault;
  if (stream) std::filesystem::rename(part, file, fault);
  if (stream && !fault) return;
  std::error_code ignored;
  std::filesystem::remove(part, ignored);
  throw Error(ExitStatus::input_output, fmt::format("{}: cannot be written", file.string()));
}

}  // namespace veduta
