// Two files held against each other, value by value.
#include <fmt/format.h>

#include <cstring>

#include "tests/fuzz/read_every_way.h"

namespace veduta::test {

namespace {

/// Floats bit by bit: the ground has NaN where there is none.
bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), 4 * a.size()) == 0);
}

bool same_ground(const HeightField& a, const HeightField& b) {
  return a.lower_x == b.lower_x && a.lower_y == b.lower_y && a.step_m == b.step_m && a.nx == b.nx &&
         a.ny == b.ny && same_bits(a.height, b.height);
}

std::string difference(const Object& a, const Object& b) {
  if (a.name != b.name) return "name";
  if (a.kind != b.kind) return "kind";
  return a.triangle_begin == b.triangle_begin && a.triangle_end == b.triangle_end ? "" : "triangles";
}

std::string difference(const City& a, const City& b) {
  const Scene &s = a.scene, &t = b.scene;
  if (s.crs != t.crs || s.origin != t.origin) return "place of the city";
  if (s.objects.size() != t.objects.size()) return "number of objects";
  for (size_t i = 0; i < s.objects.size(); ++i)
    if (const std::string what = difference(s.objects[i], t.objects[i]); !what.empty())
      return fmt::format("{} of object {}", what, i);
  if (s.triangles.size() != t.triangles.size()) return "number of triangles";
  for (size_t i = 0; i < s.triangles.size(); ++i)
    for (int corner = 0; corner < 3; ++corner)
      if (s.vertices[s.triangles[i][corner]] != t.vertices[t.triangles[i][corner]])
        return fmt::format("corner {} of triangle {}", corner, i);
  if (s.material != t.material) return "material";
  if (a.slices != b.slices || a.triangle_slices != b.triangle_slices) return "slices";
  if (!s.parts.empty() && !t.parts.empty()) {
    if (s.parts.size() != t.parts.size()) return "number of parts";
    for (size_t i = 0; i < s.parts.size(); ++i)
      if (s.parts[i].name != t.parts[i].name || s.parts[i].object != t.parts[i].object ||
          s.parts[i].triangle_begin != t.parts[i].triangle_begin ||
          s.parts[i].triangle_end != t.parts[i].triangle_end)
        return fmt::format("part {}", i);
  }
  if (a.cells != b.cells) return "cells";
  if (a.navigation.free != b.navigation.free || a.navigation.surfaces != b.navigation.surfaces)
    return "trees of the navigation";
  return same_ground(a.navigation.ground, b.navigation.ground) ? "" : "ground";
}

}  // namespace

std::string difference(const PvsFile& a, const PvsFile& b) {
  const PvsHeader &h = a.header, &k = b.header;
  if (h.fingerprint != k.fingerprint || h.config != k.config || h.renderer != k.renderer ||
      h.complete != k.complete || h.conservative != k.conservative)
    return "header";
  if (a.content_digest != b.content_digest) return "content digest";
  if (std::string what = difference(a.city, b.city); !what.empty()) return what;
  if (a.cell_row != b.cell_row) return "rows of cells";
  if (a.cell_status != b.cell_status) return "statuses of cells";
  if (a.bake_us != b.bake_us) return "times of cells";
  if (!same_bits(a.overestimate, b.overestimate)) return "over-estimates of cells";
  if (a.cell_worker != b.cell_worker || a.workers != b.workers) return "workers of cells";
  if (a.row_begin != b.row_begin) return "beginnings of rows";
  if (a.entries != b.entries) return "entries";
  return a.verification == b.verification ? "" : "verification";
}

}  // namespace veduta::test
