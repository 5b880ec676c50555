#include "worker/shrink_sections.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "worker/exposed_surface.h"
#include "worker/sealed_columns.h"
#include "worker/section_cover.h"

namespace veduta {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

class BlockSections {
 public:
  BlockSections(const SealedBlock& block, const ShrinkRequest& request)
      : block_(block),
        request_(request),
        frame_(block.region.frame()),
        surface_(exposed_surface(block)),
        columns_(block) {
    double widest = 0, lowest = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& e : request.half_extents_m)
      widest = std::max({widest, e.x, e.y}), lowest = std::min(lowest, e.z);
    // Far enough to find ground beside a house, near enough to follow a slope.
    ground_ = columns_.ground_around(4 * widest);
    find_runs();
    // Corners are rounded to float, and heights of samples are.
    const double farthest =
        std::max({std::abs(frame_.x(0)), std::abs(frame_.x(frame_.nx)), std::abs(frame_.y(0)),
                  std::abs(frame_.y(frame_.ny)), std::abs(frame_.z(0)), std::abs(frame_.z(frame_.nz))});
    margin_m_ = std::max(1e-3 * frame_.size_m / seeds_per_voxel, 2.5e-7 * farthest);
  }

  OccluderMesh shrink(const glm::dvec3& half_extent_m, double h_m) {
    const glm::dvec3 reach = half_extent_m + h_m;
    const SectionPieces pieces(surface_, reach + margin_m_, frame_.size_m);
    SectionHeights heights(samples(reach));
    CoverOptions options;
    options.keep = request_.keep;
    options.rise_m = 0.5 * half_extent_m.z;
    options.least_m3 = 0.5 * half_extent_m.x * half_extent_m.y * half_extent_m.z;  // a 16th of the cell
    options.margin_m = margin_m_;
    options.reach_m = reach;
    OccluderMesh mesh;
    start(heights, reach);
    cover(heights, pieces, options, mesh);
    // Beside a passage, a house stands on the ground and yet its window meets the passage: once more, from
    // above.
    if (start_beside_hanging(heights, reach)) cover(heights, pieces, options, mesh);
    return mesh;
  }

 private:
  PlanSamples samples(const glm::dvec3& reach) const {
    const double apart = 0.1 * std::min(reach.x, reach.y);
    const int per_voxel = static_cast<int>(std::clamp(std::round(frame_.size_m / apart), 1.0, 4.0));
    PlanSamples samples;
    samples.lower = {frame_.x(block_.i0), frame_.y(block_.j0)};
    samples.spacing_m = frame_.size_m / per_voxel;
    samples.nx = (block_.i1 - block_.i0) * per_voxel, samples.ny = (block_.j1 - block_.j0) * per_voxel;
    return samples;
  }

  void find_runs() {
    const size_t columns = ground_.size();
    runs_.resize(columns), hanging_from_.assign(columns, -infinity);
    for (int j = 0; j < frame_.ny; ++j) {
      for (int i = 0; i < frame_.nx; ++i) {
        const auto run = runs_[column(i, j)] = columns_.thickest_run(i, j, ground_[column(i, j)]);
        if (run.first > 0) hanging_from_[column(i, j)] = middle_of(run);
      }
    }
  }

  float middle_of(const std::pair<int, int>& run) const {
    return static_cast<float>(0.5 * (frame_.z(run.first) + frame_.z(run.second)));
  }

  void cover(SectionHeights& h, const SectionPieces& pieces, const CoverOptions& options,
             OccluderMesh& mesh) const {
    pieces.limit_heights(h);
    const float thinnest = static_cast<float>(2 * options.reach_m.z);
    for (size_t s = 0; s < h.covered.size(); ++s)
      h.covered[s] = std::max(h.covered[s], h.lower[s] + thinnest);
    for (const Section& section : cover_with_sections(h, pieces, columns_, options)) {
      const double bottom_m = std::isinf(section.lower_m) ? lowest_ground(h.samples, section) - thinnest
                                                          : section.lower_m + options.reach_m.z;
      add_prism(mesh, section, options.reach_m, bottom_m);
    }
  }

  /// Calls visit(s, i, j) for each sample s whose window stays in the region, and its column (i, j).
  template <typename Visit>
  void each_sample(const PlanSamples& samples, const glm::dvec3& reach, const Visit& visit) const {
    const int per_voxel = static_cast<int>(std::lround(frame_.size_m / samples.spacing_m));
    // A section may reach a square beyond its samples.
    const glm::dvec2 room = glm::dvec2(reach) + samples.spacing_m + 2 * margin_m_;
    for (int y = 0; y < samples.ny; ++y) {
      for (int x = 0; x < samples.nx; ++x) {
        const glm::dvec2 p = samples.point(x, y);
        if (p.x - room.x < frame_.x(0) || p.x + room.x > frame_.x(frame_.nx) || p.y - room.y < frame_.y(0) ||
            p.y + room.y > frame_.y(frame_.ny))
          continue;
        visit(static_cast<size_t>(y) * static_cast<size_t>(samples.nx) + static_cast<size_t>(x),
              block_.i0 + x / per_voxel, block_.j0 + y / per_voxel);
      }
    }
  }

  size_t column(int i, int j) const {
    return static_cast<size_t>(j) * static_cast<size_t>(frame_.nx) + static_cast<size_t>(i);
  }

  /// The run may end anywhere in the open voxel above it; the pieces in that will tell.
  float end_of(int layer) const { return static_cast<float>(frame_.z(std::min(layer + 1, frame_.nz))); }

  void start(SectionHeights& h, const glm::dvec3& reach) const {
    each_sample(h.samples, reach, [&](size_t s, int i, int j) {
      const float ground = ground_[column(i, j)];
      // What stands out neither from the ground nor above the lowest eye hides nothing.
      h.covered[s] = static_cast<float>(std::max<double>(ground, request_.lowest_eye_m) + reach.z);
      start_sample(h, s, runs_[column(i, j)], hanging_from_[column(i, j)]);
      if (h.from[s] == -infinity) h.foot[s] = ground + static_cast<float>(2 * reach.z);
    });
  }

  void start_sample(SectionHeights& h, size_t s, const std::pair<int, int>& run, float from_m) const {
    h.from[s] = from_m;
    h.upper[s] = end_of(run.second);
    h.lower[s] = run.first == 0 ? -infinity : static_cast<float>(frame_.z(run.first - 1));
    h.wanted[s] = run.first < run.second && h.upper[s] > h.covered[s];
  }

  /// \return whether there is anything.
  bool start_beside_hanging(SectionHeights& h, const glm::dvec3& reach) const {
    bool any = false;
    const std::vector<float> near = highest_around(hanging_from_, reach);
    each_sample(h.samples, reach, [&](size_t s, int i, int j) {
      const float from_m = near[column(i, j)];
      const bool stands = h.wanted[s] != 0 && h.from[s] == -infinity && from_m > -infinity;
      h.wanted[s] = 0;
      if (!stands || h.upper[s] > from_m) return;
      const auto run = runs_[column(i, j)];
      if (frame_.layer(from_m) < run.first || frame_.layer(from_m) >= run.second) return;
      start_sample(h, s, run, from_m);
      h.foot[s] = -infinity;
      any = any || h.wanted[s] != 0;
    });
    return any;
  }

  /// The highest of the columns within a window's reach, twice over: half the window on either side.
  std::vector<float> highest_around(std::vector<float> values, const glm::dvec3& reach) const {
    const int rx = static_cast<int>(std::ceil(2 * reach.x / frame_.size_m)),
              ry = static_cast<int>(std::ceil(2 * reach.y / frame_.size_m));
    for (float& value : values) value = -value;
    lowest_around(values, frame_.nx, frame_.ny, rx, ry);
    for (float& value : values) value = -value;
    return values;
  }

  double lowest_ground(const PlanSamples& samples, const Section& section) const {
    const int per_voxel = static_cast<int>(std::lround(frame_.size_m / samples.spacing_m));
    float lowest = infinity;
    visit_samples(samples, section.polygon, [&](int x0, int x1, int y) {
      for (int x = x0; x < x1; ++x)
        lowest = std::min(lowest, ground_[column(block_.i0 + x / per_voxel, block_.j0 + y / per_voxel)]);
    });
    return lowest;
  }

  void add_prism(OccluderMesh& mesh, const Section& section, const glm::dvec3& reach, double bottom_m) const {
    const double top_m = section.upper_m - reach.z;
    if (!(top_m > bottom_m)) return;
    std::vector<glm::vec3> top, bottom;
    for (const glm::dvec2& corner : section.polygon) {
      top.emplace_back(corner.x, corner.y, top_m);
      bottom.emplace_back(corner.x, corner.y, bottom_m);
    }
    for (size_t n = 0; n < top.size(); ++n) {
      const size_t next = (n + 1) % top.size();
      mesh.add_face({bottom[n], bottom[next], top[next], top[n]});
    }
    mesh.add_face(top);
    std::reverse(bottom.begin(), bottom.end());
    mesh.add_face(bottom);
    mesh.end_body();
  }

  const SealedBlock& block_;
  const ShrinkRequest& request_;
  const GridFrame& frame_;
  const ExposedSurface surface_;
  const SealedColumns columns_;
  std::vector<float> ground_;              // [ny * nx] m
  std::vector<std::pair<int, int>> runs_;  // [ny * nx] layers of sealed space to be covered
  std::vector<float> hanging_from_;        // [ny * nx] m: in a run that hangs; -infinity where it stands
  double margin_m_ = 0;                    // more than what rounding to float may move a corner
};

}  // namespace

std::vector<WindowOccluders> SectionsShrinker::shrink(const SealedBlock& block,
                                                      const ShrinkRequest& request) const {
  BlockSections sections(block, request);
  std::vector<WindowOccluders> windows;
  for (const glm::dvec3& half_extent_m : request.half_extents_m) {
    windows.push_back({half_extent_m, {}});
    for (const RingWindow& ring : request.rings(half_extent_m)) {
      windows.back().rings.push_back(
          {ring.h_m, static_cast<float>(ring.depth_limit_m), sections.shrink(half_extent_m, ring.h_m)});
    }
  }
  return windows;
}

}  // namespace veduta
