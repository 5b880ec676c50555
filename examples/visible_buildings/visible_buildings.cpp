// visible_buildings FILE CELL
// visible_buildings FILE X Y Z     (m, from the origin of the file)
//
// Prints which buildings can be seen from a view-cell, given its number or a point in it.
#include <veduta/pvs.h>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>

using veduta::pvs::City;

namespace {

std::optional<uint32_t> asked_cell(const City& city, int count, char** arguments) {
  if (count == 1) return static_cast<uint32_t>(std::strtoul(arguments[0], nullptr, 10));
  return city.find_cell({std::strtof(arguments[0], nullptr), std::strtof(arguments[1], nullptr),
                         std::strtof(arguments[2], nullptr)});
}

void print_buildings(const City& city, uint32_t cell) {
  const veduta::pvs::Box box = city.cell(cell);
  std::printf("cell %u, (%g, %g, %g) to (%g, %g, %g) m\n", cell, box.lower[0], box.lower[1], box.lower[2],
              box.upper[0], box.upper[1], box.upper[2]);
  veduta::pvs::Row row;
  city.read_row(cell, row);
  for (const veduta::pvs::Entry& entry : row) {
    const veduta::pvs::Object& object = city.object(entry.object);
    if (object.kind != veduta::pvs::Kind::building) continue;
    if (entry.z == 1)
      std::printf("%s: all of it\n", object.name.c_str());
    else
      std::printf("%s: in part, x %+d y %+d z %d\n", object.name.c_str(), entry.x, entry.y, entry.z);
  }
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3 && count != 5) {
    std::fprintf(stderr, "usage: visible_buildings FILE CELL | visible_buildings FILE X Y Z\n");
    return 2;
  }
  try {
    const City city(arguments[1]);
    const std::optional<uint32_t> cell = asked_cell(city, count - 2, arguments + 2);
    if (!cell) {
      std::printf("in no cell\n");
      return 1;
    }
    print_buildings(city, *cell);
    return 0;
  } catch (const veduta::pvs::Error& error) {
    std::fprintf(stderr, "visible_buildings: %s\n", error.what());
    return 65;
  }
}
