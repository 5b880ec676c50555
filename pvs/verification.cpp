#include "pvs/verification.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "pvs/pvs_file.h"

namespace veduta {
namespace {

template <typename Member>
uint64_t sum(const std::vector<VerifiedCell>& cells, Member member) {
  uint64_t out = 0;
  for (const VerifiedCell& cell : cells) out += cell.*member;
  return out;
}

bool finite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool is_share(double value) {
  return value >= 0 && value <= 1;
}

/// A plain text: what is printed goes to terminals.
bool is_plain(const std::string& text) {
  for (const char c : text)
    if (c < ' ' || c > '~') return false;
  return text.size() <= 64;
}

std::optional<std::string> find_number_defect(const Verification& v) {
  if (!is_plain(v.when)) return "/verification@when: not a short plain text";
  if (!is_plain(v.program)) return "/verification@program: not a short plain text";
  for (const double share : {v.false_invisible_solid_angle_mean, v.false_invisible_solid_angle_worst,
                             v.narrow_gap_solid_angle_mean, v.narrow_gap_solid_angle_worst})
    if (!is_share(share)) return "/verification: a solid angle that is not a share of the sphere";
  for (const double ratio : {v.overestimate_objects, v.overestimate_buildings, v.overestimate_triangles,
                             v.tightest_triangles, v.narrow_gap_limit_m})
    if (!std::isfinite(ratio) || ratio < 0)
      return "/verification: an attribute that is not finite and positive";
  return {};
}

}  // namespace

uint64_t Verification::rays() const {
  return sum(cells, &VerifiedCell::rays);
}

uint64_t Verification::cells_without_eye() const {
  uint64_t out = 0;
  for (const VerifiedCell& cell : cells) out += cell.rays == 0;
  return out;
}

uint64_t Verification::false_invisible_objects() const {
  return sum(cells, &VerifiedCell::false_invisible_objects);
}

uint64_t Verification::false_invisible_triangles() const {
  return sum(cells, &VerifiedCell::false_invisible_triangles);
}

uint64_t Verification::narrow_gap_objects() const {
  return sum(cells, &VerifiedCell::narrow_gap_objects);
}

bool Verification::passed() const {
  return rays() > 0 && false_invisible_objects() == 0 && false_invisible_triangles() == 0;
}

std::optional<std::string> find_defect(const Verification& v, size_t cells, const std::vector<Object>& all) {
  if (auto defect = find_number_defect(v)) return defect;
  const uint64_t objects = all.size(), triangles = all.empty() ? 0 : all.back().triangle_end;
  for (size_t i = 0; i < v.cells.size(); ++i) {
    const VerifiedCell& cell = v.cells[i];
    if (cell.cell >= cells) return fmt::format("/verification/cells/cell: no cell {}", cell.cell);
    if (i > 0 && cell.cell <= v.cells[i - 1].cell)
      return fmt::format("/verification/cells/cell: cell {} is not in ascending order", cell.cell);
    if (std::max({cell.pvs_objects, cell.seen_objects, cell.false_invisible_objects,
                  cell.narrow_gap_objects}) > objects)
      return fmt::format("/verification/cells/objects: cell {}: more than there are", cell.cell);
    if (std::max({cell.pvs_triangles, cell.seen_triangles, cell.false_invisible_triangles}) > triangles)
      return fmt::format("/verification/cells/triangles: cell {}: more than there are", cell.cell);
    if (!is_share(double{cell.false_invisible_solid_angle}))
      return fmt::format("/verification/cells/solid_angle: cell {}: no share of the sphere", cell.cell);
  }
  for (size_t i = 0; i < v.witnesses.size(); ++i) {
    const Witness& w = v.witnesses[i];
    if (w.cell >= cells) return fmt::format("/verification/examples/cell: no cell {}", w.cell);
    if (w.object >= objects) return fmt::format("/verification/examples/object: no object {}", w.object);
    const Object& object = all[w.object];
    if (w.triangle < object.triangle_begin || w.triangle >= object.triangle_end)
      return fmt::format("/verification/examples/triangle: {} is not of object {}", w.triangle, w.object);
    const float length = glm::dot(w.direction, w.direction);
    if (!finite(w.eye) || !finite(w.direction) || !finite(w.hit) || !(std::abs(length - 1) < 1e-3f))
      return fmt::format("/verification/examples/ray: example {} is no ray", i);
    if (!std::isfinite(w.gap_m) || !std::isfinite(w.gap_from_eye_m) || w.gap_m < 0 || w.gap_from_eye_m < 0)
      return fmt::format("/verification/examples/gap: example {}: no widths", i);
  }
  return {};
}

std::string describe_verification(const Verification& v, const PvsFile& file) {
  std::string out =
      fmt::format("  verified   {} {}: {} of {} cells, {} rays, seed {}\n", v.when,
                  v.passed() ? "passed" : "FAILED", v.cells.size(), file.city.cells.size(), v.rays(), v.seed);
  out += fmt::format("             false invisible: {} objects, {} triangles; narrow gaps: {} objects\n",
                     v.false_invisible_objects(), v.false_invisible_triangles(), v.narrow_gap_objects());
  out += fmt::format(
      "             over-estimate: {:.2f}x in objects, {:.2f}x in buildings, {:.2f}x in triangles\n",
      v.overestimate_objects, v.overestimate_buildings, v.overestimate_triangles);
  if (!v.witnesses.empty())
    out += fmt::format(
        "             {} examples to look at: veduta-view FILE --headless --witness 0 --out DIR\n",
        v.witnesses.size());
  return out;
}

}  // namespace veduta
