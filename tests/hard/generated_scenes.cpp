#include "tests/hard/generated_scenes.h"

#include <cmath>
#include <fstream>
#include <stdexcept>

namespace veduta::hard {
namespace {

void box(std::ostream& out, const std::string& name, double x0, double y0, double z0, double x1, double y1,
         double z1) {
  out << "o " << name << "\n";
  for (int corner = 0; corner < 8; ++corner)
    out << "v " << (corner & 1 ? x1 : x0) << " " << (corner & 2 ? y1 : y0) << " " << (corner & 4 ? z1 : z0)
        << "\n";
  out << "f -8 -6 -5 -7\nf -4 -3 -1 -2\nf -8 -7 -3 -4\nf -6 -2 -1 -5\nf -8 -4 -2 -6\nf -7 -5 -1 -3\n";
}

/// A million triangles: a screen of tiles with a relief, before and behind which there are houses.
void million(std::ostream& out) {
  constexpr int columns = 1000, rows = 500;
  box(out, "ground", -8, -16, -1, 52, 16, 0);
  box(out, "before", 10, -6, 0, 14, -2, 4);
  box(out, "wall", 20, -14, 0, 30, 14, 12);
  box(out, "behind", 36, -4, 0, 40, 4, 3);
  box(out, "tower", 44, -5, 0, 50, 5, 45);
  out << "o relief\n";
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column)
      out << "v " << 18 + 0.5 * std::sin(0.1 * row) * std::cos(0.07 * column) << " " << -10 + 0.02 * column
          << " " << 0.02 * row << "\n";
  }
  const auto at = [](int row, int column) { return 41 + row * (columns + 1) + column; };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const int a = at(row, column), b = at(row, column + 1), c = at(row + 1, column + 1),
                d = at(row + 1, column);
      out << "f " << a << " " << b << " " << c << "\nf " << a << " " << c << " " << d << "\n";
    }
  }
}

}  // namespace

void write_generated_scene(const std::string& name, const std::filesystem::path& obj) {
  std::ofstream out(obj);
  if (name == "million")
    million(out);
  else
    throw std::runtime_error("no generated scene " + name);
}

}  // namespace veduta::hard
