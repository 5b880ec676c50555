#include "tests/campaign/check_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gl/egl_context.h"
#include "tests/worker/occlusion_city.h"
#include "verify/verify.h"
#include "worker/reference/cell_reference.h"

namespace veduta::campaign {
namespace {

using test::OcclusionCity;

std::string text(const glm::dvec3& p) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z);
}

/// As many as are wanted, spread over all.
std::vector<uint32_t> some_cells(size_t all, size_t most) {
  std::vector<uint32_t> cells;
  const size_t count = std::min(all, most);
  for (size_t n = 0; n < count; ++n) cells.push_back(static_cast<uint32_t>(n * all / count));
  return cells;
}

std::vector<CellOcclusion> bake(const OcclusionCity& city, const CheckOptions& options) {
  std::vector<WindowOccluders> windows = city.windows();
  if (options.spoil_occluders) options.spoil_occluders(windows);
  const EglContext context("software");
  const OcclusionInput input{city.city(), city.slices(), windows, city.settings};
  const auto method = make_occlusion_method(city.settings.occlusion.method, input);
  std::vector<CellOcclusion> answers;
  method->bake(some_cells(city.city().cells.size(), options.cells), [&](const CellOcclusion& answer) {
    answers.push_back(answer);
    if (options.spoil_answer) options.spoil_answer(answers.back(), input);
  });
  return answers;
}

/// The rows that the answers make, of their cells alone.
PvsFile rows_of(const OcclusionCity& city, const std::vector<CellOcclusion>& answers) {
  PvsFile file;
  file.header.config = to_toml(city.settings);  // names the size of seeds
  file.city = city.city();
  file.city.cells.clear();
  file.row_begin.push_back(0);
  for (const CellOcclusion& answer : answers) {
    file.cell_row.push_back(static_cast<uint32_t>(file.city.cells.size()));
    file.cell_status.push_back(CellStatus::baked);
    file.bake_us.push_back(0);
    file.overestimate.push_back(0);
    file.city.cells.push_back(city.city().cells[answer.cell]);
    for (uint32_t o = 0; o < city.city().scene.objects.size(); ++o) {
      const VisibilityIndex index = city.row_entry(answer, o);
      if (!index.nothing()) file.entries.push_back({o, index});
    }
    file.row_begin.push_back(file.entries.size());
  }
  return file;
}

void count(const OcclusionCity& city, const PvsFile& rows, const std::vector<CellOcclusion>& answers,
           Outcome& outcome) {
  outcome.cells = answers.size();
  outcome.pairs = answers.size() * city.city().scene.objects.size();
  outcome.hidden = outcome.pairs - rows.entries.size();
  for (const CellOcclusion& answer : answers) {
    for (size_t s = 0; s < answer.occlusion.occluded.size(); ++s) {
      if (answer.occlusion.visible[city.slices().slices[s].object] != 0)
        outcome.hidden_heights += answer.occlusion.occluded[s];
    }
  }
}

void fail(const OcclusionCity& city, Verdict verdict, const Box& cell, const std::string& what,
          Outcome& outcome) {
  const auto& o = city.city().scene.origin;
  outcome.verdict = verdict;
  outcome.cell_lower = glm::dvec2(o[0], o[1]) + glm::dvec2(cell.lower);
  outcome.cell_upper = glm::dvec2(o[0], o[1]) + glm::dvec2(cell.upper);
  outcome.what = fmt::format("{}; cell {} to {}, scene origin {}", what, text(cell.lower), text(cell.upper),
                             text({o[0], o[1], o[2]}));
}

VerifyReport shoot(const PvsFile& rows, const CheckOptions& options) {
  VerifyOptions verify_options;
  verify_options.cells = static_cast<uint32_t>(rows.city.cells.size());
  verify_options.rays_per_cell = options.rays_per_cell;
  return verify(rows, verify_options);
}

/// The largest |x| + |y| + |z| of the normals of what is around a gap: 1 where all of it is parallel to the
/// axes, and how wide a cube of edge 1 is across the gap at most.
double cube_across(const Scene& scene, const RayScene& rays, const FalseInvisible& seen) {
  const glm::vec3 place = seen.eye + seen.gap.distance_m * glm::normalize(seen.direction);
  double widest = 1;
  for (const uint32_t t : rays.triangles_around(place, seen.gap.width_m)) {
    const glm::uvec3& corner = scene.triangles[t];
    const glm::dvec3 a(scene.vertices[corner.x]), b(scene.vertices[corner.y]), c(scene.vertices[corner.z]);
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double length = glm::length(normal);
    if (length > 0)
      widest = std::max(widest, (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z)) / length);
  }
  return widest;
}

/// Is all that rays met, and rows leave out, behind gaps that a cube of two seeds, parallel to the axes, does
/// not pass? The fill goes from seed to seed, so between walls that are parallel to the axes that is a gap of
/// two seeds; turned ones may close up to 2 sqrt(3).
bool only_turned_gaps(PvsFile rows, const Settings& settings, const CheckOptions& options) {
  Settings wider = settings;
  wider.navigation.seed_size_m *= std::sqrt(3.0);
  rows.header.config = to_toml(wider);
  const VerifyReport report = shoot(rows, options);
  if (!report.passed()) return false;
  const RayScene rays(rows.city.scene);
  return std::ranges::all_of(report.narrow_gap_examples, [&](const FalseInvisible& seen) {
    return seen.gap.width_m < 2 * settings.navigation.seed_size_m * cube_across(rows.city.scene, rays, seen);
  });
}

void check_rays(const OcclusionCity& city, const PvsFile& rows, const CheckOptions& options,
                Outcome& outcome) {
  const VerifyReport report = shoot(rows, options);
  outcome.rays = report.rays, outcome.narrow_gap_objects = report.narrow_gap_objects;
  if (report.false_invisible_objects == 0 && report.false_invisible_triangles == 0) return;
  const bool turned = only_turned_gaps(rows, city.settings, options);
  const FalseInvisible& first = report.examples.front();
  fail(city, turned ? Verdict::turned_gap : Verdict::false_invisible, rows.city.cells[first.cell],
       fmt::format("{}, triangle {}, from {} towards {}, {:.6g} m away",
                   city.city().scene.objects[first.object].name, first.triangle, text(first.eye),
                   text(first.direction), glm::distance(first.eye, first.hit)),
       outcome);
}

void stop_segments(const OcclusionCity& city, const std::vector<CellOcclusion>& answers,
                   const CheckOptions& options, Outcome& outcome) {
  const reference::CellReference exact(city.input());
  for (const CellOcclusion& answer : answers) {
    const auto wrong = exact.wrongly_hidden(answer, city.eyes(answer.cell, options.eyes_per_cell));
    if (wrong.empty()) continue;
    const reference::Witness& first = wrong.front();
    const std::string slice = first.slice ? fmt::format(", slice {}", *first.slice) : "";
    fail(city, Verdict::unfounded, city.city().cells[answer.cell],
         fmt::format("{}{}, from {} to {}, and {} boxes more", city.city().scene.objects[first.object].name,
                     slice, text(first.eye), text(first.point), wrong.size() - 1),
         outcome);
    return;
  }
}

}  // namespace

std::string name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::passed:
      return "passed";
    case Verdict::no_place:
      return "no place";
    case Verdict::turned_gap:
      return "turned gap";
    case Verdict::false_invisible:
      return "false invisible";
    case Verdict::unfounded:
      return "unfounded";
    case Verdict::threw:
      return "threw";
    case Verdict::crashed:
      return "crashed";
    case Verdict::hung:
      return "hung";
  }
  return "?";
}

bool is_failure(Verdict verdict) {
  return verdict != Verdict::passed && verdict != Verdict::no_place && verdict != Verdict::turned_gap;
}

Outcome check_bake(const Settings& settings, const CheckOptions& options) {
  Outcome outcome;
  try {
    OcclusionCity city;
    city.settings = settings;
    try {
      city.prepare();
    } catch (const Error& error) {
      if (std::string(error.what()).find("no place to stand") == std::string::npos) throw;
      outcome.verdict = Verdict::no_place;
      return outcome;
    }
    const std::vector<CellOcclusion> answers = bake(city, options);
    const PvsFile rows = rows_of(city, answers);
    count(city, rows, answers, outcome);
    check_rays(city, rows, options, outcome);
    if (!is_failure(outcome.verdict)) stop_segments(city, answers, options, outcome);
  } catch (const std::exception& error) {
    outcome.verdict = Verdict::threw, outcome.what = error.what();
  }
  return outcome;
}

Outcome check_scene(const CampaignScene& scene, const CheckOptions& options) {
  const test::TemporaryDirectory folder;
  try {
    write_scene(scene, folder.path());
  } catch (const std::exception& error) {
    Outcome outcome;
    outcome.verdict = Verdict::threw, outcome.what = error.what();
    return outcome;
  }
  return check_bake(scene.resolved(folder.path()), options);
}

}  // namespace veduta::campaign
