// A PVS file read piece by piece: for cities that are larger than memory, and for who wants one row of many.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pvs/cell_grid.h"
#include "pvs/city.h"
#include "pvs/pvs_file.h"
#include "pvs/verification.h"
#include "pvs/visibility.h"

namespace veduta {

/// All of a file but geometry and entries of rows.
struct PvsIndex {
  PvsHeader header;
  std::string crs;
  std::array<double, 3> origin{0, 0, 0};
  std::string content_digest;
  std::vector<Object> objects;          ///< [N] their triangles by the numbers of the file
  std::vector<Box> bounds;              ///< [N] empty for an object without triangles
  std::vector<SliceCounts> slices;      ///< [N]
  std::vector<Box> cells;               ///< [C]
  CellGrid grid;                        ///< of the cells
  std::vector<uint32_t> cell_row;       ///< [C]
  std::vector<CellStatus> cell_status;  ///< [C]
  std::vector<uint32_t> bake_us;        ///< [C]
  std::vector<float> overestimate;      ///< [C]
  std::vector<uint32_t> cell_worker;  ///< [C] number in `workers` or no_worker; empty: the file does not say
  std::vector<std::string> workers;   ///< names of those who baked
  std::vector<uint64_t> row_begin;    ///< [R+1]
  Navigation navigation;              ///< after PvsStream::read_navigation()
  std::optional<Verification> verification;

  /// As PvsFile::find_cell: the lowest cell that holds the point, or -1. Constant time.
  int64_t find_cell(const glm::vec3& point) const { return grid.find(cells, point); }
  uint32_t row_size(uint32_t cell) const {
    return static_cast<uint32_t>(row_begin[cell_row[cell] + 1] - row_begin[cell_row[cell]]);
  }
};

/// An open file. Opening reads and checks the index, digests included; rows and geometry are checked as they
/// are read: the checksum of every chunk, every number in range, and triangles against the bounds of their
/// object. HDF5 is not safe with threads: a process uses all of its streams and files from one thread at a
/// time. Unpacked chunks are kept, so that neighbouring rows and objects are cheap to read one after the
/// other; those that were not used for longest go first. Their index has a checksum too. What only read_pvs
/// notices, which compares the digests of rows and geometry: two chunks of one dataset, packed to the same
/// number of bytes, that changed places; and what was changed on purpose.
class PvsStream {
 public:
  /// \param memory_bytes  of unpacked chunks, also while they are unpacked; 1 MiB at least is taken. The
  /// index
  ///   is not among them.
  /// \throw Error as read_pvs.
  explicit PvsStream(const std::filesystem::path& file, uint64_t memory_bytes = uint64_t{48} << 20);
  ~PvsStream();
  PvsStream(PvsStream&&) noexcept;
  PvsStream& operator=(PvsStream&&) noexcept;

  const PvsIndex& index() const { return index_; }

  /// Reads and checks index().navigation, in which there are only the lattices before: it grows with the
  /// ground and the surfaces of a city, and is most of an index. \throw Error(bad_input) when it is damaged.
  void read_navigation();

  /// Of unpacked chunks that are kept now.
  uint64_t kept_bytes() const;

  /// Entries of a row (not: of a cell; see PvsIndex::cell_row), one of 0 to R-1.
  /// \throw Error(bad_input) when it is damaged, naming the dataset.
  PvsRow read_row(uint32_t row) const;
  /// The same in the place of `out`, whose room is used again. From what is kept, in a microsecond or two.
  void read_row(uint32_t row, PvsRow& out) const;

  /// Is the row kept? Then reading it does not call HDF5, and it begins to come closer to the processor.
  bool keeps_row(uint32_t row) const;

  /// Objects [first, last), last <= N, as a city of their own: scene (vertices that are used, in the order of
  /// the file, triangles, material, objects with triangle numbers from 0; no parts), slices and
  /// triangle_slices. No cells, no navigation. Memory and time are those of these objects.
  /// \throw Error(bad_input) when it is damaged, naming the dataset.
  City read_objects(uint32_t first, uint32_t last) const;

 private:
  struct Open;
  std::unique_ptr<Open> open_;
  PvsIndex index_;
};

}  // namespace veduta
