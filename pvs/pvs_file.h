// city.pvs.h5 (DESIGN §9): reading it with every check, and writing it so that a crash leaves the old file or
// a whole one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pvs/cell_grid.h"
#include "pvs/city.h"
#include "pvs/verification.h"
#include "pvs/visibility.h"

namespace veduta {

/// Attributes of the root group beside format, version, unit, up, crs and origin.
struct PvsHeader {
  std::string fingerprint;  ///< of scene content, settings and algorithm version
  std::string config;       ///< the resolved configuration, TOML
  std::string
      renderer;  ///< GL_RENDERER of the bake, e.g. "llvmpipe (LLVM 15.0.6, 256 bits)"; several joined by "; "
  bool complete = false;  ///< every cell has status baked
  bool conservative = true;
};

inline constexpr uint32_t no_worker = UINT32_MAX;  ///< nobody baked the cell, or nobody knows who

/// A file in memory, checked: every digest compared, every index in range, every offset monotone. Row
/// `cell_row[c]` is entries [row_begin[r], row_begin[r+1]).
struct PvsFile {
  PvsHeader header;
  City city;
  std::vector<uint32_t> cell_row;       ///< [C] index of a unique row
  std::vector<CellStatus> cell_status;  ///< [C]
  std::vector<uint32_t> bake_us;        ///< [C] time of the bake of the cell, us
  std::vector<float> overestimate;      ///< [C] certified (pvs/visibility.h), 0: nobody looked
  std::vector<uint32_t> cell_worker;  ///< [C] number in `workers` or no_worker; empty: the file does not say
  std::vector<std::string> workers;   ///< names of those who baked
  std::vector<uint64_t> row_begin;    ///< [R+1]
  std::vector<PvsEntry> entries;      ///< [K]
  std::string content_digest;  ///< 32 hex digits over the logical content; not over bake_us, workers, config
                               ///< and renderer

  /// What a verification of this content found; none: nobody looked, or nobody stored it.
  std::optional<Verification> verification;

  /// The entries of a cell's row.
  struct Span {
    const PvsEntry* first;
    const PvsEntry* last;
    const PvsEntry* begin() const { return first; }
    const PvsEntry* end() const { return last; }
    size_t size() const { return static_cast<size_t>(last - first); }
  };
  Span row(uint32_t cell) const;

  /// The cell that holds the point, or -1. A point on a shared face belongs to the cell with the lowest
  /// number.
  int64_t find_cell(const glm::vec3& point) const;

  /// What find_cell looks in. read_pvs has made it; who changes city.cells makes it again. Made of another
  /// number of cells, it is not used and find_cell looks at every cell.
  CellGrid grid;
  void index_cells() { grid = CellGrid(city.cells); }
};

/// Reads and checks a whole file.
/// \throw Error(bad_input) when it is missing, not ours, of another version or damaged (naming the dataset);
///   Error(input_output) when it cannot be read.
PvsFile read_pvs(const std::filesystem::path& file);

/// Where the writer asks for the row of cell c, c ascending; called once per cell. Memory does not grow with
/// cells.
struct BakedCell {
  CellStatus status = CellStatus::all_visible;
  uint32_t bake_us = 0;
  PvsRow row;                   ///< of an all-visible cell it is not looked at: all objects are in it
  float overestimate = 0;       ///< certified; 0: nobody looked
  uint32_t worker = no_worker;  ///< who baked it, as a number in the writer's list of names
};
using CellSource = std::function<BakedCell(uint32_t cell)>;

/// Writes a complete file, as yet without a verification, to a temporary name beside `file`, reads it back,
/// compares the digests, syncs and renames. Equal rows are stored once. `header.complete` is set from the
/// statuses seen. Of what `workers` names, the file says who baked each cell; without a name it does not.
/// \return the content digest. \throw Error(input_output) when the disk is full or not
/// writable; nothing is left behind.
std::string write_pvs(const std::filesystem::path& file, const City& city, const PvsHeader& header,
                      const CellSource& cells, const std::vector<std::string>& workers = {});

/// How far a long work has come, for who waits: what it does now, and done of total.
using WorkHeard = std::function<void(const char* what, uint64_t done, uint64_t total)>;

/// What writing rows needs to know of a prepared city: all but its geometry, its cells' bounds and its trees.
struct CityOutline {
  uint64_t cells = 0;
  std::vector<SliceCounts> slices;             ///< [N] per object
  City frame;                                  ///< crs, origin and the lattices of its navigation; else empty
  std::map<std::string, std::string> digests;  ///< by path of the dataset
};

/// Reads a prepared city in little memory and checks every dataset, but not the relations between them, which
/// its writer checked. \throw Error as read_city.
CityOutline read_city_outline(const std::filesystem::path& city_file, const WorkHeard& heard = {});

/// As write_pvs of the city that was read from `city_file`, in little memory: the city is copied from file to
/// file. For each cell 21 to 27 bytes are kept, 18 to 26 for each form (pvs/forms.h) and 13 for each object.
std::string write_pvs(const std::filesystem::path& file, const std::filesystem::path& city_file,
                      const CityOutline& city, const PvsHeader& header, const CellSource& cells,
                      const WorkHeard& heard = {}, const std::vector<std::string>& workers = {});

/// The prepared city (`prepared/city.h5`): the same layout without /pvs and /cells rows, with the same
/// checks.
void write_city(const std::filesystem::path& file, const City& city);
City read_city(const std::filesystem::path& file);
/// The same without what baking does not look at: of the navigation, surfaces and ground have no values. What
/// is passed over may be damaged.
City read_city_to_bake(const std::filesystem::path& file);

/// The same in two steps, the large part once and first: a file of scene and slices, which is no prepared
/// city yet, and then one that has its copy, the cells, the navigation and `scene.crs` and `scene.origin` of
/// `places`. \throw Error(bad_input) for a scene file that is missing or damaged, else as write_city.
void write_city_scene(const std::filesystem::path& scene_file, const City& city);
void complete_city(const std::filesystem::path& scene_file, const std::filesystem::path& file,
                   const City& places);

/// Sizes as people ask for them (`veduta info`): several lines, or JSON.
std::string describe(const PvsFile& file, const std::filesystem::path& path);
std::string describe_json(const PvsFile& file, const std::filesystem::path& path);

}  // namespace veduta
