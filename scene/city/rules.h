// The rules of a style: how a floor of a facade is split until all of it is windows, walls and doors.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "scene/city/terminal.h"

namespace veduta::city {

/// Of a fixed split: metres, or a share of what the metres leave.
struct Length {
  double amount = 1;
  bool is_metres = false;
};

/// How a rectangle becomes columns and rows (thesis A.4).
struct Split {
  enum class Type : uint8_t {
    random,  ///< columns of [min_width_m, 2 min_width_m], rows likewise
    repeat,  ///< as many equal columns of min_width_m or more as fit, rows likewise
    fixed,   ///< columns and rows as listed
  };
  Type type = Type::fixed;
  double min_width_m = 0, min_height_m = 0;  ///< of random and repeat; 0: one column, one row
  std::vector<Length> columns, rows;         ///< of fixed: from the left, from below
  std::string place;                         ///< for messages: "line 12: rule 'Window' of shape 'Face'"
  std::string file;                          ///< for messages
};

/// What stands in a cell of a split: a terminal, or a temporary shape with its attributes, as a state.
struct Successor {
  uint32_t index = 0;
  bool is_terminal = true;
};

/// A rule as it applies to a state.
struct Choice {
  uint32_t split = 0;
  double weight = 1;
  /// Fixed: one a cell, column by column, each from below. Random and repeat: those to choose from.
  std::vector<Successor> cells;
  std::vector<double> cell_weights;  ///< of random and repeat
};

/// A temporary shape with values for its attributes, and the rules that these leave.
struct State {
  std::vector<Choice> choices;  ///< one or more
};

enum class Level : uint8_t { ground, middle, top };
enum class Side : uint8_t { front, street, court };

/// A band between two floors that runs around the building.
struct Course {
  std::array<bool, 3> levels{true, true, true};  ///< on which floors, by Level
  bool at_bottom = false;                        ///< of the floor; else at its top
  double height_m = 0.3, depth_m = 0.15;
  uint16_t layer = 0;
};

struct Roof {
  enum class Type : uint8_t { flat, gabled, hipped, mansard };
  Type type = Type::flat;
  double pitch_deg = 35;        ///< mansard: of the lower slope
  double upper_pitch_deg = 20;  ///< mansard
  double height_m = 3;          ///< mansard: of the lower slope
  double overhang_m = 0;
  double parapet_m = 0;      ///< flat: height above the roof; 0: none
  double thickness_m = 0.3;  ///< of the parapet
  uint16_t layer = 0;
};

/// What differs when dice are thrown: every floor, every facade (its floors are alike), or every building.
enum class Vary : uint8_t { floor, facade, building };

/// A style, ready to derive: names resolved, attributes turned into states.
struct RuleSet {
  std::string name;
  std::string file;
  std::vector<std::string> layers;
  std::vector<Terminal> terminals;
  std::vector<Split> splits;
  std::vector<State> states;
  uint32_t wall = 0;  ///< the terminal for what no rule splits
  uint16_t wall_layer = 0, ground_layer = 0;

  double ground_height_m = 3, floor_height_m = 3, top_height_m = 3;  ///< one floor alone is a ground floor
  double min_edge_m = 1;  ///< facades of shorter edges are plain wall
  Vary vary = Vary::floor;
  std::vector<Course> courses;
  Roof roof;

  /// The state in which the derivation of a floor starts; floors count from 0.
  uint32_t start(int floor, int floor_count, Side side) const;

  std::vector<int> storeys, from_top;  ///< those that rules ask for; others are alike
  std::vector<uint32_t> starts;        ///< [3 levels][storeys + 1][from_top + 1][3 sides]
};

/// Reads a style (docs/city-rules.md) and the terminals that it names.
/// \throw Error(bad_input), "style.xml: line 12: what; what to do": XML that is not well-formed, a name that
///   nothing defines, an unknown element or attribute, numbers that are none, proportions without their
///   elements, a shape that no rule splits, a rule that never ends, a missing or open terminal.
RuleSet load_rules(const std::filesystem::path& file);

/// The height of each floor in m; they add up to `height_m` where it is not 0.
std::vector<double> floor_heights_m(const RuleSet& rules, int floors, double height_m);

}  // namespace veduta::city
