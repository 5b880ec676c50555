#include "viewer/frame_stats.h"

#include <fmt/format.h>

#include <fstream>

#include "scene/atomic_file.h"
#include "scene/error.h"

namespace veduta {

void write_frame_stats(const std::filesystem::path& file, const std::vector<FrameStats>& stats) {
  write_atomically(file, [&](const std::filesystem::path& part) {
    std::ofstream stream(part);
    stream << "frame,cell,objects,triangles,draws,ms,cull_ms,interval_ms,all_drawn,waiting,x,y,z,yaw_deg,"
              "pitch_deg\n";
    for (const FrameStats& f : stats) {
      const glm::vec3& eye = f.pose.position_m;
      stream << fmt::format("{},{},{},{},{},{:.3f},{:.3f},{:.3f},{},{},{},{},{},{},{}\n", f.frame, f.cell,
                            f.objects, f.triangles, f.draws, f.ms, f.cull_ms, f.interval_ms, int{f.all_drawn},
                            int{f.waiting}, eye.x, eye.y, eye.z, f.pose.yaw_deg, f.pose.pitch_deg);
    }
    if (!stream.flush()) throw Error(ExitStatus::input_output, file.string() + ": cannot be written");
  });
}

}  // namespace veduta
