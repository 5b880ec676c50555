// Charts of a sweep: time per cell against what it gets.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "sweep/sweep.h"

namespace veduta {

/// What stands on the vertical axis.
enum class Chart : uint8_t { buildings, triangles, objects, false_invisible, bytes };
inline constexpr std::array all_charts{Chart::buildings, Chart::triangles, Chart::objects,
                                       Chart::false_invisible, Chart::bytes};

/// "over-estimate in buildings"
const char* chart_title(Chart chart);

/// A picture of its own (an SVG file), light or dark as the reader's screen, with a line on how it was
/// measured. Where there is nothing to draw it says so.
std::string chart_svg(const SweepReport& report, Chart chart);

/// The same for a page that has `chart_style()`: an <svg> element, or a paragraph where there is nothing to
/// draw.
std::string chart_element(const SweepReport& report, Chart chart);

}  // namespace veduta
