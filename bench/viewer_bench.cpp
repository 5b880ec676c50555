// What the viewer's frames cost, with and without the PVS, its slices and the culling of both eyes: thesis
// table 6.3 and figs 6.4-6.6 (no culling, building level, slices), fig. 6.9 (single-location,
// multiple-location, none) and table 6.4 (memory). JSON in, JSON out:
//
//   echo '{"file": "out/city/city.pvs.h5", "frames": 300}' | veduta-bench-viewer
//   echo '{"blocks": 20, "path": "path.csv"}' | veduta-bench-viewer
//
// "blocks": in place of a file, a city of so many houses squared, without slices.
// "frames" (300) of a walk through the city, or of "path", a file as --path of veduta-view; "width" (1280),
// "height" (720) of one eye's picture, "samples" (4), "gpu" (auto), "one_pass" (true): both eyes by one call
// where the driver can. Every configuration draws the same "stretch" (20) of frames in turn, so that what
// else the machine does meets them all; the least time of "repeats" (3) counts for each frame. A frame ends
// when the GPU is done with it. All is in memory by then: hitches of a window are not seen here.
#include <epoxy/gl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>

#include "bench/verify_city.h"
#include "bench/viewer_report.h"
#include "gl/egl_context.h"
#include "scene/error.h"
#include "viewer/draw/offscreen.h"
#include "viewer/path.h"
#include "viewer/stroll.h"

namespace veduta::bench {
namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

struct Job {
  std::string file, path, gpu;
  uint32_t blocks = 0;
  size_t frames = 0, stretch = 0, repeats = 0;
  glm::uvec2 picture{0};
  FrameOptions how;
};

Job read_job(const Json& json) {
  for (const auto& [key, value] : json.items())
    if (key != "file" && key != "blocks" && key != "path" && key != "gpu" && key != "frames" &&
        key != "stretch" && key != "repeats" && key != "width" && key != "height" && key != "samples" &&
        key != "one_pass")
      throw Error(ExitStatus::usage, "no key \"" + key + "\"");
  Job job;
  if (json.contains("file"))
    job.file = json["file"].get<std::string>();
  else
    job.blocks = std::clamp(json.at("blocks").get<uint32_t>(), 2u, 1000u);
  job.path = json.value("path", ""), job.gpu = json.value("gpu", "auto");
  job.frames = std::max(2u, json.value("frames", 300u));
  job.stretch = std::max(1u, json.value("stretch", 20u)),
  job.repeats = std::max(1u, json.value("repeats", 3u));
  job.picture = {json.value("width", 1280u), json.value("height", 720u)};
  job.how.samples = json.value("samples", 4), job.how.allow_one_pass = json.value("one_pass", true);
  job.how.wait = true;
  return job;
}

ViewState state_of(PvsUse pvs, StereoMode stereo, Culling culling) {
  ViewState state;
  state.pvs = pvs, state.stereo = stereo, state.culling = culling;
  return state;
}

std::vector<Configuration> configurations() {
  // Pictures beside each other are copied, not computed.
  constexpr StereoMode both = StereoMode::side_by_side;
  constexpr Culling single = Culling::single_location;
  return {{"all", state_of(PvsUse::off, StereoMode::mono, single), {}},
          {"buildings", state_of(PvsUse::buildings, StereoMode::mono, single), {}},
          {"slices", state_of(PvsUse::slices, StereoMode::mono, single), {}},
          {"stereo_single", state_of(PvsUse::slices, both, single), {}},
          {"stereo_multiple", state_of(PvsUse::slices, both, Culling::multiple_location), {}},
          {"stereo_none", state_of(PvsUse::slices, both, Culling::none), {}}};
}

// Draws frames [begin, end) of the path, and keeps the least time of each.
void draw_stretch(FrameDrawer& drawer, const std::vector<Pose>& path, size_t begin, size_t end,
                  const Output& output, Configuration& configuration) {
  const auto frame = [&](size_t i) {
    configuration.state.pose = path[i];
    const Clock::time_point start = Clock::now();
    FrameStats stats = drawer.draw(configuration.state, glm::vec3(0), output);
    glFinish();
    stats.ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    return stats;
  };
  frame(begin);  // buffers take the size of its pictures
  configuration.frames.resize(path.size());
  for (size_t i = begin; i < end; ++i) {
    const FrameStats now = frame(i);
    FrameStats& kept = configuration.frames[i];
    const bool first = kept.ms == 0;
    const double ms = first ? now.ms : std::min(kept.ms, now.ms);
    const double cull_ms = first ? now.cull_ms : std::min(kept.cull_ms, now.cull_ms);
    kept = now;
    kept.ms = ms, kept.cull_ms = cull_ms;
  }
}

// The file of a job; one that was made goes with it.
class JobFile {
 public:
  explicit JobFile(const Job& job) : path_(job.file), made_(job.blocks > 0) {
    if (!made_) return;
    path_ =
        std::filesystem::temp_directory_path() / ("veduta-bench-viewer." + std::to_string(getpid()) + ".h5");
    const PvsFile city = block_city(job.blocks, 8);
    write_pvs(path_, city.city, {}, [&](uint32_t cell) {
      const PvsFile::Span row = city.row(cell);
      return BakedCell{CellStatus::baked, 1, {row.begin(), row.end()}};
    });
  }
  ~JobFile() {
    std::error_code ignored;
    if (made_) std::filesystem::remove(path_, ignored);
  }
  JobFile(const JobFile&) = delete;
  JobFile& operator=(const JobFile&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  bool made_;
};

Json measure(const Job& job) {
  const EglContext context(job.gpu);
  const JobFile file(job);
  const Json rows = rows_json(file.path());  // before a stream reads on its own thread
  CityStream stream(file.path(), uint64_t{1} << 40);
  const std::vector<Pose> path =
      job.path.empty() ? make_stroll(stream.index(), job.frames) : resample(read_path(job.path), job.frames);
  if (path.empty())
    throw Error(ExitStatus::bad_input, file.path().string() + ": nowhere to walk; give a path");
  FrameDrawer drawer(stream, job.how, nullptr);
  std::vector<Configuration> all = configurations();
  const Offscreen one(job.picture), two(output_size(StereoMode::side_by_side, job.picture));
  for (size_t repeat = 0; repeat < job.repeats; ++repeat)
    for (size_t begin = 0; begin < path.size(); begin += job.stretch)
      for (Configuration& configuration : all) {
        const Offscreen& shown = eyes(configuration.state.stereo).size() == 1 ? one : two;
        draw_stretch(drawer, path, begin, std::min(begin + job.stretch, path.size()),
                     {shown.framebuffer(), shown.size(), {}}, configuration);
      }
  Json out = {{"file", job.blocks > 0 ? std::to_string(job.blocks) + " blocks squared" : job.file},
              {"renderer", context.renderer()},
              {"one_pass", drawer.one_pass()},
              {"picture", {job.picture.x, job.picture.y}},
              {"frames", path.size()},
              {"repeats", job.repeats}};
  out.update(report_json(all, stream.index()));
  out.update(rows);
  return out;
}

}  // namespace
}  // namespace veduta::bench

int main() {
  try {
    using namespace veduta::bench;
    std::cout << measure(read_job(Json::parse(std::cin))).dump(2) << std::endl;
    return 0;
  } catch (const veduta::Error& error) {
    std::cerr << "veduta-bench-viewer: " << error.what() << "\n";
    return static_cast<int>(error.status());
  } catch (const std::exception& error) {
    std::cerr << "veduta-bench-viewer: " << error.what()
              << "; give {\"file\": \"city.pvs.h5\"} or {\"blocks\": 20}\n";
    return 2;
  }
}
