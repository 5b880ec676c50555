// toy_file FILE: writes the small city of the tests, whose rows are known.
#include <cstdio>

#include "tests/pvs/small_city.h"

int main(int count, char** arguments) {
  if (count != 2) return 2;
  try {
    veduta::write_pvs(arguments[1], veduta::test::small_city(), veduta::test::small_header(),
                      veduta::test::small_row);
    return 0;
  } catch (const veduta::Error& error) {
    std::fprintf(stderr, "toy_file: %s\n", error.what());
    return 74;
  }
}
