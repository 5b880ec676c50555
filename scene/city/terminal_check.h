// Whether a terminal closes its piece of the facade.
#pragma once

#include <string>

#include "scene/city/terminal.h"

namespace veduta::city {

/// A closed wall with solid things before it passes every line along z through the unit square once in all,
/// and every other line as often in as out. Anything else is a hole, a face inside out, or a sheet without
/// thickness. \throw Error(bad_input) with the line, for `file`
void check_closed(const Terminal& terminal, const std::string& file);

}  // namespace veduta::city
