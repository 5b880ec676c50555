// Reads FILE.pvs.h5: a city, and what can be seen of it from each of its view-cells. This header is the whole
// interface of the installed library (find_package(veduta), target veduta::pvs) and needs the standard
// library only. A frame of a renderer:
//
//   veduta::pvs::City city("city.pvs.h5");
//   veduta::pvs::Geometry geometry = city.read_geometry(0, city.object_count());   // upload it, once
//   ...
//   if (auto cell = city.find_cell(eye)) {
//     city.read_row(*cell, row);
//     ranges.clear();
//     for (const auto& entry : row) geometry.add_ranges(entry, ranges);            // glMultiDrawElements
//   }
//
// Lengths are metres, z is up, and points are relative to City::origin(). What is read is checked before it
// is believed: damage is an Error, not a crash and not another answer (docs/library.md has the small print).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace veduta::pvs {

/// One line: file, dataset and what is wrong with it.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

using Point = std::array<float, 3>;  ///< x, y, z, m

/// A closed box.
struct Box {
  Point lower{}, upper{};
};

enum class Kind : uint8_t { building, terrain, road, water, vegetation, bridge, other };

struct Object {
  std::string name;
  Kind kind = Kind::other;
  Box bounds;                              ///< lower above upper for an object without triangles
  uint64_t triangles = 0;                  ///< how many it has
  std::array<uint8_t, 3> slices{1, 1, 1};  ///< how many it is cut into along x, y, z, 1..127
};

/// What is visible of one object: three bytes (docs/format.md). A triangle is to be drawn when z >= 1 and its
/// last z-slice is >= z; or x > 0 and its first x-slice is <= x; or x < 0 and its last x-slice is >= -x + 1;
/// or the same for y.
struct Entry {
  uint32_t object = 0;
  int8_t x = 0, y = 0, z = 0;
  bool operator==(const Entry&) const = default;
};

/// Visible objects by ascending number.
using Row = std::vector<Entry>;

/// What either row draws, for two eyes in two cells: replaces `out`. An object may then have two entries, one
/// after the other. What was united may be united again.
void unite(const Row& left, const Row& right, Row& out);

/// Elements [first, first + count) of Geometry::indices.
struct DrawRange {
  uint64_t first = 0, count = 0;
};

/// Triangles of some objects that follow one another, ready to be drawn: an indexed mesh whose indices are
/// there in five orders, so that what an entry draws is at most two ranges.
class Geometry {
 public:
  uint32_t first_object = 0, last_object = 0;  ///< [first, last)
  std::vector<Point> vertices;                 ///< [V]
  std::vector<uint32_t> indices;               ///< [5 * 3T] corners of triangles, one order after the other
  std::vector<uint8_t> material;  ///< [5T] of the triangle of indices[3i..3i+2] (docs/format.md says which)

  /// Adds what the entry draws of its object to `out`, in constant time. Ranges of one entry may overlap.
  /// Objects that are not of this geometry add nothing.
  void add_ranges(const Entry& entry, std::vector<DrawRange>& out) const;

  Geometry();
  ~Geometry();
  Geometry(Geometry&&) noexcept;
  Geometry& operator=(Geometry&&) noexcept;

 private:
  friend class City;
  struct Slices;
  std::unique_ptr<Slices> slices_;
};

enum class CellStatus : uint8_t { baked, coarse, all_visible };

/// An open file. In memory are its objects and cells, and as much of rows and geometry as `memory_bytes`
/// allows; the rest is read when it is asked for. One thread at a time uses the Cities of a process, and HDF5
/// where the program uses it itself. A number of an object or cell that is not there is an Error.
class City {
 public:
  /// \param memory_bytes room for what was read of rows and geometry, so that it need not be read again; less
  ///   than 1 MiB counts as 1 MiB.
  /// \throw Error when the file is missing, not ours, of another version or damaged.
  explicit City(const std::filesystem::path& file, uint64_t memory_bytes = uint64_t{256} << 20);
  ~City();
  City(City&&) noexcept;
  City& operator=(City&&) noexcept;

  const std::string& crs() const;               ///< e.g. "EPSG:7415"; empty: not known
  const std::array<double, 3>& origin() const;  ///< of all points, m, in that system
  const std::string& content_digest() const;    ///< equal content, equal digest: 32 hex digits
  bool conservative() const;                    ///< what rows leave out is hidden for certain

  uint32_t object_count() const;
  const Object& object(uint32_t number) const;
  /// Objects whose bounds touch the box, ascending. Every object is looked at.
  std::vector<uint32_t> objects_in(const Box& box) const;

  uint32_t cell_count() const;
  Box cell(uint32_t number) const;
  CellStatus cell_status(uint32_t number) const;
  /// The lowest cell that holds the point; none: outside of all. Constant time.
  std::optional<uint32_t> find_cell(const Point& point) const;

  /// Replaces `out` by the row of a cell. \throw Error when it is damaged.
  void read_row(uint32_t cell, Row& out) const;

  /// Of objects [first, last): 65 bytes a triangle and 12 a vertex. \throw Error when it is damaged.
  Geometry read_geometry(uint32_t first, uint32_t last) const;

 private:
  struct Open;
  std::unique_ptr<Open> open_;
};

}  // namespace veduta::pvs
