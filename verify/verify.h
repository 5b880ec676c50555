// Trust: rays from sampled eye points over the full model, against what the rows say (DESIGN §11).
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "pvs/pvs_file.h"
#include "verify/narrow_gap.h"

namespace veduta {

struct VerifyOptions {
  uint32_t cells = 64;  ///< sampled without replacement; all, when the file has fewer
  uint64_t rays_per_cell = 1'000'000;
  uint32_t eyes_per_cell = 64;  ///< corners, edges, faces and inside (Halton)
  uint64_t seed = 1;
};

/// A triangle that a ray hit and that the row does not draw.
struct FalseInvisible {
  uint32_t cell = 0, object = 0;
  uint64_t triangle = 0;
  glm::vec3 eye{0}, direction{0}, hit{0};
  NarrowGap gap;  ///< that it was seen through, where the report says so
};

/// What was found for one of the cells checked.
struct CellVerdict {
  uint32_t cell = 0;
  bool has_eye = false;  ///< else nothing below is filled in
  uint64_t rays = 0;
  uint64_t pvs_objects = 0, seen_objects = 0, pvs_triangles = 0, seen_triangles = 0;
  uint64_t false_invisible_objects = 0, false_invisible_triangles = 0, narrow_gap_objects = 0;
  double false_invisible_solid_angle = 0;  ///< share, 0..1
};

/// The over-estimate after so many of the rays: how it still falls says how far it may be from the truth.
struct Convergence {
  uint64_t rays_per_cell = 0;
  double overestimate_objects = 0, overestimate_buildings = 0, overestimate_triangles = 0;
};

/// Where the time went: seconds, added up over threads.
struct VerifyTimes {
  double set_up_s = 0;      ///< the ray tracer's hierarchy and what else all cells share; by one thread
  double eyes_s = 0;        ///< where a viewer can be
  double directions_s = 0;  ///< which rays to shoot
  double tracing_s = 0;     ///< Embree
  double settling_s = 0;    ///< exact arithmetic, narrow gaps
  double total_s = 0;       ///< of all that and the rest: keeping the books
};

struct VerifyReport {
  uint32_t cells_checked = 0, cells_without_eye = 0;
  uint64_t rays = 0, hits = 0;
  uint64_t grazing_settled =
      0;  ///< hits on undrawn triangles in float arithmetic that exact arithmetic did not confirm
  // false invisible: distinct (cell, object) and (cell, triangle) pairs; and the share of solid angle (0..1),
  // its mean over cells and its worst over eye points
  uint64_t false_invisible_objects = 0, false_invisible_triangles = 0;
  double false_invisible_solid_angle_mean = 0, false_invisible_solid_angle_worst = 0;
  std::vector<FalseInvisible> examples;  ///< at most 16, one a cell and object, the nearest first
  // The same of what was seen through nothing but gaps narrower than two seeds, which is the tolerance that
  // the user chose: not false invisible, but counted. One ray through anything wider makes it a fault.
  double narrow_gap_limit_m = 0;  ///< two seeds
  uint64_t narrow_gap_objects = 0, narrow_gap_triangles = 0;
  double narrow_gap_solid_angle_mean = 0, narrow_gap_solid_angle_worst = 0;
  std::vector<FalseInvisible> narrow_gap_examples;  ///< chosen as `examples` are
  // over-estimate: PVS over what was seen (a lower bound of what can be seen), summed over cells; and
  // per-cell spread
  double overestimate_objects = 0, overestimate_buildings = 0, overestimate_triangles = 0;
  double overestimate_objects_median = 0, overestimate_objects_worst = 0;
  /// What the format of a row costs of that: the smallest rows that draw all that was seen, and whole
  /// objects of which anything was seen, over what was seen. No bake can do better than the first.
  double tightest_triangles = 0, whole_seen_objects_triangles = 0;
  // what the bake's own rays certified for the cells checked, where they looked
  uint32_t cells_certified = 0;
  double certified_median = 0, certified_worst = 0;
  double mean_pvs_objects = 0, mean_seen_objects = 0, mean_pvs_triangles = 0, mean_seen_triangles = 0;
  double drawn_of_whole_objects = 0;     ///< triangles drawn with slices over triangles of the listed objects
  std::vector<CellVerdict> verdicts;     ///< by ascending cell
  std::vector<Convergence> convergence;  ///< by growing rays_per_cell; the last is of all rays
  double elapsed_s = 0, rays_per_second = 0;
  VerifyTimes times;
  /// A check that shot no ray has not passed. Narrow gaps do not count.
  bool passed() const { return rays > 0 && false_invisible_objects == 0 && false_invisible_triangles == 0; }
};

/// `count` distinct cells of so many, all when there are fewer; ascending. The same for a seed.
std::vector<uint32_t> sample_cells(size_t cells, size_t count, uint64_t seed);

/// Eye points are taken where a viewer can be: in navigable space, or within one seed of it with nothing in
/// between. A quarter of the rays go all over the sphere, from which solid angles are estimated; the others
/// at what the row does not draw, at what no ray has met, and past the borders of what was met. Deterministic
/// for a seed, whatever the number of threads. `progress` is called from one thread at a time. \throw
/// Error(bad_input) when the scene has no triangle.
VerifyReport verify(const PvsFile& file, const VerifyOptions& options,
                    const std::function<void(uint32_t done, uint32_t total)>& progress = {});

std::string describe(const VerifyReport& report, const PvsFile& file);
std::string describe_json(const VerifyReport& report, const PvsFile& file);

}  // namespace veduta
