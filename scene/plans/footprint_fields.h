// What the attributes of a footprint say: names that plans use for heights and floors.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/footprints.h"

namespace veduta {

/// Which columns of a table hold what is asked of a footprint. Names are compared without case and
/// punctuation, and in the first 10 characters that a Shapefile leaves of them.
class FootprintFields {
 public:
  /// \param columns "HAUTEUR", "building:levels", "numberOfFloors.value"
  /// \throw Error(bad_input) when a field that the options name is not there
  FootprintFields(const std::string& file, const std::vector<std::string>& columns,
                  const ImportOptions& options);

  /// Fills name, ground, height_m and floors. \param value of a column as text; empty: none
  template <typename Value>
  void fill(const Value& value, Footprint& footprint) const {
    const auto text = [&](int column) { return column < 0 ? std::string() : value(column); };
    footprint.name = printable(text(name_), 10000);
    footprint.floors = floors_in(text(floors_));
    footprint.ground = number_in(text(ground_));
    footprint.height_m = number_in(text(height_));
    const std::optional<double> roof = number_in(text(roof_));
    if (!footprint.height_m && roof && footprint.ground) footprint.height_m = *roof - *footprint.ground;
    if (footprint.height_m && !(*footprint.height_m > 0)) footprint.height_m.reset();
  }

 private:
  static std::optional<double> number_in(std::string_view text);  // "9.2", "9.2 m"
  static std::optional<int> floors_in(std::string_view text);     // 0 to 1000

  int name_ = -1, height_ = -1, floors_ = -1, ground_ = -1, roof_ = -1;
};

/// The number behind "_ETAGES_", "_FLOORS_" or "_KAT_" at the end of a layer's name, in any case.
std::optional<int> floors_of_layer(std::string_view layer);

}  // namespace veduta
