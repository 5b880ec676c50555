// A hard case: a folder of tests/cases with a case.toml, baked as the product does, judged by the exact
// reference.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pvs/pvs_file.h"
#include "tests/hard/sightings.h"
#include "tests/pvs/small_city.h"
#include "worker/occluders.h"
#include "worker/settings.h"

namespace veduta::hard {

/// What case.toml says: the configuration of a bake, and a section [case].
struct HardCase {
  std::string name, hard;                 ///< a sentence: what makes it hard
  Settings settings;                      ///< of its bake
  std::vector<Point> stands;              ///< where a viewer certainly can be
  std::vector<PointBox> gaps;             ///< narrower than two seeds: may be open or closed
  std::vector<std::string> hidden, seen;  ///< objects: in no row, in every row of cells with a certain eye
  std::string refused;                    ///< the import throws Error(bad_input) with this text
  std::string known_fault;  ///< what is wrong and not yet mended: the case fails when it is no longer wrong
  size_t looks = LookAbout{}.looks;
  std::string generated;  ///< scene that is made at test time: generated_scenes.h
};

/// \throw std::runtime_error for a key that it does not know.
HardCase read_case(const std::filesystem::path& folder);

/// What all methods bake from.
struct PreparedCase {
  City city;
  std::vector<WindowOccluders> occluders;
};
PreparedCase prepare_case(const Settings& settings);

/// Bakes every cell by a method.
PvsFile bake_case(const PreparedCase& prepared, Settings settings, const std::string& method);

/// What a reference has to hold besides the model: stands, and the corners of the cells.
std::vector<Point> places_of_eyes(const HardCase& hard_case, const City& city);

/// What is seen for certain, by cell. The cells are those of the file; the same for all methods.
struct CellSightings {
  uint32_t cell = 0;
  size_t eyes = 0;
  std::vector<Sighting> sightings;
};
std::vector<CellSightings> look_from_cells(const ExactReference& reference, const HardCase& hard_case,
                                           const PvsFile& file);

/// What the rows leave out though it is seen, each in words; and what they leave out of what is seen through
/// nothing but gaps that may close.
struct Verdict {
  std::vector<std::string> wrong, through_gaps;
};
Verdict judge(const PvsFile& file, const ExactReference& reference, const std::vector<CellSightings>& cells);

/// Is an object (or a tile of it) in the row?
bool lists(const PvsFile& file, uint32_t cell, const std::string& name);

}  // namespace veduta::hard
