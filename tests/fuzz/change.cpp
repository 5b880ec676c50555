// Wrong values, chosen where they hurt: ends of ranges, neighbours of what is right, other values of the same
// dataset, numbers that are none.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "tests/fuzz/pieces.h"

namespace veduta::test {

namespace {

using Random = std::mt19937;
constexpr float infinity = std::numeric_limits<float>::infinity();

template <typename T, size_t N>
T any_of(const T (&choices)[N], Random& random) {
  return choices[random() % N];
}

std::string change_float(std::string& bytes, size_t at, Random& random) {
  float value = 0;
  std::memcpy(&value, bytes.data() + at, 4);
  value = any_of({NAN, infinity, -infinity, 0.0f, -0.0f, -value, value + 1, std::nextafter(value, infinity),
                  value * 1e30f, 1e-40f, std::bit_cast<float>(static_cast<uint32_t>(random()))},
                 random);
  std::memcpy(bytes.data() + at, &value, 4);
  return fmt::format("{}", value);
}

std::string change_integer(std::string& bytes, size_t at, size_t size, uint64_t near, Random& random) {
  uint64_t value = 0;
  std::memcpy(&value, bytes.data() + at, size);
  const uint64_t top = uint64_t{1} << (8 * size - 1);
  value =
      any_of({uint64_t{0}, uint64_t{1}, ~uint64_t{0}, value + 1, value - 1, ~value, near, near - 1, near + 1,
              top, top - 1, uint64_t{random()} << (random() % 33), uint64_t{random()} % (near + 1)},
             random);
  std::memcpy(bytes.data() + at, &value, size);
  return fmt::format("{:#x}", value);
}

std::string change_value(Piece& piece, uint64_t near, Random& random) {
  const size_t count = piece.bytes.size() / piece.element_bytes, size = piece.element_bytes;
  const size_t i = random() % count, at = i * size;
  std::string now;
  if (random() % 5 == 0) {
    const size_t other = random() % count * size;
    piece.bytes.replace(at, size, piece.bytes.substr(other, size));
    now = fmt::format("that of element {}", other / size);
  } else if (piece.column->element == hdf5::Element::f32) {
    now = change_float(piece.bytes, at, random);
  } else if (piece.column->element == hdf5::Element::text) {
    piece.bytes[at + random() % size] = static_cast<char>(random());
    now = "another text";
  } else {
    now = change_integer(piece.bytes, at, size, near, random);
  }
  return fmt::format("{}: element {} is {}", piece.column->path, i, now);
}

std::string change_length(Piece& piece, Random& random) {
  const size_t row = piece.row_bytes(), from = piece.rows == 0 ? 0 : random() % piece.rows * row;
  const std::string copy = piece.rows == 0 ? std::string(row, '\0') : piece.bytes.substr(from, row);
  switch (piece.rows == 0 ? 0 : random() % 4) {
    case 0:
      piece.bytes += copy;
      break;
    case 1:
      piece.bytes.erase(from, row);
      break;
    case 2:
      piece.bytes.insert(from, copy);
      break;
    default:
      piece.bytes.clear();
  }
  piece.rows = row == 0 ? 0 : piece.bytes.size() / row;
  return fmt::format("{}: {} rows", piece.column->path, piece.rows);
}

std::string change_attribute(Pieces& pieces, Random& random) {
  RootAttributes& root = pieces.root;
  Navigation& navigation = pieces.frame.navigation;
  OctreeForest& forest = random() % 2 == 0 ? navigation.free : navigation.surfaces;
  const float number = any_of({NAN, infinity, 0.0f, -1.0f, 1e30f, 1e-30f, 2.5f}, random);
  switch (random() % 9) {
    case 0:
      root.header.complete = !root.header.complete;
      return "/@complete";
    case 1:
      root.header.conservative = !root.header.conservative;
      return "/@conservative";
    case 2:
      root.version += any_of({1u, ~0u}, random);
      return "/@version";
    case 3:
      any_of({&root.crs, &root.unit, &root.up, &root.format, &root.header.config}, random)->assign(1, 'x');
      return "texts of the root";
    case 4:
      root.origin[random() % 3] = static_cast<double>(number);
      return "/@origin";
    case 5:
      forest.depth = any_of({0u, 1u, forest.depth + 1, 20u, 21u, 31u, 64u, ~0u}, random);
      return fmt::format("a tree's depth is {}", forest.depth);
    case 6:
      forest.leaf_size_m = number;
      return "a tree's leaf size";
    case 7:
      forest.lower[static_cast<int>(random() % 3)] = number;
      return "a tree's corner";
    default:
      any_of({&navigation.ground.lower_x, &navigation.ground.lower_y, &navigation.ground.step_m}, random)[0] =
          number;
      return "the ground's lattice";
  }
}

std::string change_verification(Verification& v, Random& random) {
  const double number = any_of({std::nan(""), HUGE_VAL, 0.0, -1.0, 1e300, 0.5}, random);
  const auto count = any_of({uint64_t{0}, uint64_t{1}, uint64_t{5}, uint64_t{7}, ~uint64_t{0}}, random);
  const auto less = static_cast<float>(number);
  if (v.cells.empty() || v.witnesses.empty() || random() % 4 == 0) {
    any_of({&v.overestimate_objects, &v.overestimate_buildings, &v.tightest_triangles,
            &v.false_invisible_solid_angle_worst, &v.narrow_gap_limit_m},
           random)[0] = number;
    return fmt::format("/verification: an attribute is {}", number);
  }
  VerifiedCell& cell = v.cells[random() % v.cells.size()];
  Witness& witness = v.witnesses[random() % v.witnesses.size()];
  switch (random() % 6) {
    case 0:
      any_of({&cell.rays, &cell.pvs_objects, &cell.seen_objects, &cell.false_invisible_objects,
              &witness.triangle},
             random)[0] = count;
      break;
    case 1:
      any_of({&cell.cell, &witness.cell, &witness.object}, random)[0] = static_cast<uint32_t>(count);
      break;
    case 2:
      any_of({&cell.false_invisible_solid_angle, &witness.gap_m, &witness.gap_from_eye_m, &witness.eye.x,
              &witness.direction.y, &witness.hit.z},
             random)[0] = less;
      break;
    case 3:
      v.cells.push_back(cell);
      break;
    case 4:
      v.witnesses.clear();
      break;
    default:
      std::swap(v.cells.front(), cell);
  }
  return fmt::format("/verification: a count is {} or a number {}", count, number);
}

}  // namespace

std::string change(Pieces& pieces, Random& random) {
  const unsigned kind = random() % 10;
  if (kind == 0) return change_attribute(pieces, random);
  if (kind == 1 && pieces.verification) return change_verification(*pieces.verification, random);
  Piece& piece = pieces.pieces[random() % pieces.pieces.size()];
  if (kind <= 3 || piece.bytes.empty()) return change_length(piece, random);
  // Lengths of other datasets are what numbers in this one are compared with.
  return change_value(piece, pieces.pieces[random() % pieces.pieces.size()].rows, random);
}

}  // namespace veduta::test
