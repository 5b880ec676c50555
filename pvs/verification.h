// What a verification found, kept in the file beside the cells that it checked (group /verification).
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

namespace veduta {

struct Object;
struct PvsFile;

/// Of one cell that was checked. Counts are of the cell's row and of what rays met.
struct VerifiedCell {
  uint32_t cell = 0;
  uint64_t rays = 0;  ///< 0: the cell has no point where a viewer can be, and all below is 0
  uint64_t pvs_objects = 0, seen_objects = 0, pvs_triangles = 0, seen_triangles = 0;
  uint64_t false_invisible_objects = 0, false_invisible_triangles = 0, narrow_gap_objects = 0;
  float false_invisible_solid_angle = 0;  ///< share, 0..1
  bool operator==(const VerifiedCell&) const = default;
};

/// A ray that met a triangle which the row of its cell does not draw: what is needed to look at it.
struct Witness {
  uint32_t cell = 0, object = 0;
  uint64_t triangle = 0;
  glm::vec3 eye{0}, direction{0}, hit{0};  ///< m, relative to the scene's origin; the direction has length 1
  float gap_m = 0;           ///< width of the narrow gap that it was seen through; 0: false invisible
  float gap_from_eye_m = 0;  ///< and how far away that is
  bool operator==(const Witness&) const = default;
};

struct Verification {
  std::string when;                                         ///< UTC, "2026-01-31T12:00:00Z"
  std::string program;                                      ///< version of the program that verified
  uint64_t seed = 0, rays_per_cell = 0, eyes_per_cell = 0;  ///< as asked for
  double overestimate_objects = 0, overestimate_buildings = 0, overestimate_triangles = 0;
  double tightest_triangles = 0;  ///< what the format of a row costs of that
  double false_invisible_solid_angle_mean = 0, false_invisible_solid_angle_worst = 0;  ///< worst: eye point
  double narrow_gap_limit_m = 0;
  uint64_t narrow_gap_triangles = 0;
  double narrow_gap_solid_angle_mean = 0, narrow_gap_solid_angle_worst = 0;
  std::vector<VerifiedCell> cells;  ///< ascending
  std::vector<Witness> witnesses;   ///< false invisible first, then narrow gaps
  bool operator==(const Verification&) const = default;

  // Sums over the cells. The file has them as attributes, too, for other readers.
  uint64_t rays() const;
  uint64_t cells_without_eye() const;
  uint64_t false_invisible_objects() const;
  uint64_t false_invisible_triangles() const;
  uint64_t narrow_gap_objects() const;
  /// A check that shot no ray has not passed. Narrow gaps do not count.
  bool passed() const;
};

/// Puts it into the file, in place of one that is there: a copy is written under a temporary name, read back,
/// synced and renamed, so that a kill leaves the old file or the new one. The cells and their content digest
/// stay as they are.
/// \param checked  the file as it was read and verified
/// \throw Error(bad_input) when the file holds other cells by now; Error(input_output) when it cannot be
///   written; Error(defect) when the verification does not fit the city.
void store_verification(const std::filesystem::path& file, const PvsFile& checked,
                        const Verification& verification);

/// What does not fit a city of so many cells and these objects: "/verification/cells/cell: what".
std::optional<std::string> find_defect(const Verification& verification, size_t cells,
                                       const std::vector<Object>& objects);

/// Lines for people (`veduta info`).
std::string describe_verification(const Verification& verification, const PvsFile& file);

}  // namespace veduta
