// Which points of a sweep belong together, and the mark that each kind has.
#pragma once

#include <string>
#include <vector>

#include "sweep/sweep.h"

namespace veduta {

/// Methods of occlusion, and of shrinking where that is not the configured one.
struct Methods {
  std::vector<std::string> names;  ///< in the order of their first points
  std::vector<size_t> of_point;    ///< [points of the report] numbers of names
};
Methods methods_of(const SweepReport& report);

/// An SVG shape around a point, in the colour and the form of a method. Colours (Okabe and Ito's, darkened or
/// lightened for the ground) are told apart without red and green; forms without any. `kind` is "mark", and
/// "mark hollow" for a point that has false invisible triangles.
std::string mark(size_t method, double x, double y, const std::string& kind);

/// The style sheet that marks and charts are drawn with, light and dark.
const char* chart_style();

}  // namespace veduta
