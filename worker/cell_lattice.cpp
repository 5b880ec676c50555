#include "worker/cell_lattice.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace veduta {

Box lattice_square(int i, int j, double size_m) {
  return {{static_cast<float>(i * size_m), static_cast<float>(j * size_m), 0},
          {static_cast<float>((i + 1) * size_m), static_cast<float>((j + 1) * size_m), 0}};
}

VoxelRange voxels_of(double lower_m, double upper_m, const GridFrame& lattice) {
  const double margin = 4e-3 * lattice.size_m;
  const auto number = [&](double m) {
    return static_cast<int>(std::floor((m + lattice.aside_m) / lattice.size_m));
  };
  return {number(lower_m + margin), number(upper_m - margin)};
}

std::vector<LatticeCell> unite_open_cells(std::vector<LatticeCell> cells, const CellOptions& options) {
  for (int size_class = 0; (1 << size_class) < options.largest; ++size_class) {
    const auto parent = [](const LatticeCell& c) { return std::tuple(c.k >> 1, c.j >> 1, c.i >> 1); };
    const auto open = [&](const LatticeCell& c) { return c.open && c.size_class == size_class; };
    std::map<std::tuple<int, int, int>, std::vector<const LatticeCell*>> children;
    for (const LatticeCell& c : cells)
      if (open(c)) children[parent(c)].push_back(&c);
    std::vector<LatticeCell> next;
    for (const LatticeCell& c : cells)
      if (!open(c) || children[parent(c)].size() < 8) next.push_back(c);
    for (const auto& [number, group] : children) {
      if (group.size() < 8) continue;
      LatticeCell united;
      std::tie(united.k, united.j, united.i) = number;
      united.size_class = static_cast<uint8_t>(size_class + 1);
      united.open = true;
      for (const LatticeCell* child : group) united.box.extend(child->box);
      next.push_back(united);
    }
    cells = std::move(next);
  }
  return cells;
}

uint64_t hilbert_index(uint32_t order, uint32_t x, uint32_t y) {
  uint64_t index = 0;
  for (uint32_t s = order; s-- > 0;) {
    const uint32_t rx = x >> s & 1, ry = y >> s & 1;
    index += (uint64_t{1} << (2 * s)) * ((3 * rx) ^ ry);
    if (ry == 0) {  // rotate the quadrant so that the curve joins up
      const uint32_t mask = (1u << s) - 1;
      if (rx == 1) x = ~x & mask, y = ~y & mask;
      std::swap(x, y);
    }
    x &= (1u << s) - 1, y &= (1u << s) - 1;
  }
  return index;
}

std::vector<Box> in_hilbert_order(std::vector<LatticeCell> cells, const CellOptions& options) {
  const GridFrame& city = options.city;
  const auto square_of = [&](double m) { return static_cast<int>(std::floor(m / options.size_m)); };
  const int before = options.fly ? options.largest : 0;  // a larger cell may begin before the city does
  const int i0 = square_of(city.x(0)) - before, i1 = square_of(city.x(city.nx));
  const int j0 = square_of(city.y(0)) - before, j1 = square_of(city.y(city.ny));
  uint32_t order = 1;
  while ((1 << order) <= std::max(i1 - i0, j1 - j0)) ++order;
  const auto key = [&](const LatticeCell& c) {
    const uint64_t along = hilbert_index(order, static_cast<uint32_t>((c.i << c.size_class) - i0),
                                         static_cast<uint32_t>((c.j << c.size_class) - j0));
    return std::pair(along, c.box.lower.z);
  };
  std::sort(cells.begin(), cells.end(),
            [&](const LatticeCell& a, const LatticeCell& b) { return key(a) < key(b); });
  std::vector<Box> boxes;
  for (const LatticeCell& c : cells) boxes.push_back(c.box);
  return boxes;
}

}  // namespace veduta
