// Rays against the answers of a method of occlusion.
#pragma once

#include <vector>

#include "tests/worker/occlusion_city.h"
#include "verify/verify.h"
#include "worker/occlusion_method.h"

namespace veduta::test {

/// What rays into the model say of the rows that the answers make. The file names no size of seeds, so that
/// nothing is excused for being seen through a narrow gap.
/// \param beside_m how far eyes may be beside their cell
inline VerifyReport shoot(const OcclusionCity& city, const std::vector<CellOcclusion>& answers,
                          uint64_t rays_per_cell, double beside_m = 0) {
  PvsFile file;
  file.city = city.city();
  file.city.cells.clear();  // those that were not asked for are left out
  file.row_begin.push_back(0);
  for (const CellOcclusion& answer : answers) {
    file.cell_row.push_back(static_cast<uint32_t>(file.city.cells.size()));
    file.cell_status.push_back(CellStatus::baked);
    file.bake_us.push_back(0);
    file.overestimate.push_back(0);
    const Box& cell = city.city().cells[answer.cell];
    const auto beside = static_cast<float>(beside_m);
    file.city.cells.push_back({cell.lower - beside, cell.upper + beside});
    for (uint32_t o = 0; o < city.city().scene.objects.size(); ++o) {
      const VisibilityIndex index = city.row_entry(answer, o);
      if (!index.nothing()) file.entries.push_back({o, index});
    }
    file.row_begin.push_back(file.entries.size());
  }
  VerifyOptions options;
  options.cells = static_cast<uint32_t>(answers.size());
  options.rays_per_cell = rays_per_cell;
  return verify(file, options);
}

}  // namespace veduta::test
