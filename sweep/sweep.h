// Speed against error: a sample of cells baked and verified over a grid of settings (DESIGN section 11).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "verify/verify.h"

namespace veduta {

/// Which keys of a configuration take which other values: by key path ("occlusion.subdivide"), the value as
/// TOML. None: the configuration as it is.
using ChangedKeys = std::vector<std::pair<std::string, std::string>>;

/// One point of the grid. Times, in ms, are means over the sampled cells, which are baked one lease by one
/// worker; a first cell outside of the clock warms it up.
struct SweepPoint {
  ChangedKeys changed;
  std::string key;  ///< hash of all that the figures depend on, save for the machine; equal: the same point
  std::string failed;  ///< why there are no figures; empty: there are
  std::string renderer;
  double prepare_s = 0;       ///< of all stages; shared by points that differ in nothing that it depends on
  double cell_ms = 0;         ///< by the clock on the wall
  double cell_core_ms = 0;    ///< of processor time of the worker, all its threads: 0 work of a GPU
  double bytes_per_cell = 0;  ///< of rows, as stored
  uint32_t cells = 0;         ///< sampled; as near to those of the other points as its lattice has them
  uint64_t cells_in_all = 0;
  uint64_t cells_of_first = 0;  ///< cells_in_all of the first point; 0: the same
  // of the verification:
  uint64_t rays_per_cell = 0;
  double overestimate_objects = 0, overestimate_buildings = 0, overestimate_triangles = 0;
  double overestimate_objects_median = 0, overestimate_objects_worst = 0;
  double tightest_triangles = 0;  ///< what the format of a row costs of the triangles
  uint64_t false_invisible_objects = 0, false_invisible_triangles = 0, narrow_gap_objects = 0;
  double false_invisible_solid_angle_mean = 0, false_invisible_solid_angle_worst = 0;
};

/// What a sweep found so far. As JSON it is also what a sweep that was stopped goes on from.
struct SweepReport {
  std::string title;    ///< the configuration's file name
  std::string config;   ///< resolved, TOML: the point without changed keys
  std::string machine;  ///< "2 cores of Intel Xeon ..., 24 GB"
  std::string version;  ///< of the program
  uint32_t cells = 32;  ///< asked for
  uint64_t rays_per_cell = 1'000'000;
  uint64_t seed = 1;
  /// Middles of the sampled cells of the first point, in the scene's CRS, m; other points take what cells
  /// are there.
  std::vector<std::array<double, 3>> places;
  std::vector<SweepPoint> points;
};

/// Is the renderer software? Then a point is judged by the time of processors, which other work on the
/// machine hardly changes, else by the clock.
bool judged_by_processor(const SweepPoint& point);
/// That time, ms a cell. Of cells of another size it is the time of as many as come to a cell of the first
/// point: four that are half as wide.
double judged_ms(const SweepPoint& point);

/// "default", or "subdivide 4, method zoom": the changed keys without their tables, on one line.
std::string point_name(const SweepPoint& point);

std::string to_json(const SweepReport& report);
/// \throw Error(bad_input) naming `name` for what is no sweep, is of another version or is damaged.
SweepReport sweep_from_json(const std::string& text, const std::string& name);

/// Numbers of the points worth having, by `judged_ms` and the given over-estimate, fastest first: no other is
/// tighter by more than 1 % and as fast, or as tight and faster by more than 5 %: less is noise. Points that
/// failed or have false invisible triangles are never among them.
std::vector<size_t> pareto_front(const SweepReport& report, double SweepPoint::*overestimate);

/// The fastest point without false invisible triangles whose over-estimate in buildings is at most the given
/// one; -1: there is none.
int recommend(const SweepReport& report, double max_overestimate);

/// A self-contained page of SVG charts and a table: opens in any browser, asks for nothing from elsewhere.
std::string sweep_page(const SweepReport& report);

}  // namespace veduta
