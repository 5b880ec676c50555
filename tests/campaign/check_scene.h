// One scene against two oracles that know nothing of how it was baked.
//
// Rays (verify/verify.h) are aimed at what rows do not draw; one that meets such a triangle is a witness, but
// for gaps narrower than two seeds, which are counted. And segments from eyes to what is hidden
// (worker/reference/cell_reference.h): one that no occluder stops is a witness.
#pragma once

#include <array>
#include <functional>
#include <string>

#include "tests/campaign/campaign_scene.h"
#include "worker/occlusion_method.h"

namespace veduta::campaign {

enum class Verdict : uint8_t {
  passed,
  no_place,    ///< to stand in: there is nothing to check
  turned_gap,  ///< seen through nothing but gaps that a cube of two seeds does not pass (docs/campaign.md)
  false_invisible,  ///< a ray meets what a row does not draw
  unfounded,        ///< something is hidden that no occluder hides
  threw,            ///< an exception ended it
  crashed,          ///< a signal did (isolate.h)
  hung,             ///< it took too long (isolate.h)
};

inline constexpr std::array all_verdicts{Verdict::passed,          Verdict::no_place,  Verdict::turned_gap,
                                         Verdict::false_invisible, Verdict::unfounded, Verdict::threw,
                                         Verdict::crashed,         Verdict::hung};
std::string name_of(Verdict verdict);
bool is_failure(Verdict verdict);

/// What came of a scene.
struct Outcome {
  Verdict verdict = Verdict::passed;
  std::string what;  ///< a line: which object from where, or the message
  /// Of a failure that is seen: the square of its cell, m, relative to the scene's origin of coordinates.
  glm::dvec2 cell_lower{0}, cell_upper{0};
  uint64_t cells = 0, pairs = 0, hidden = 0;  ///< pairs of an object and a cell; of these, not in the row
  uint64_t hidden_heights = 0;                ///< of slices of objects that are in the row
  uint64_t rays = 0, narrow_gap_objects = 0;  ///< pairs seen through nothing but narrow gaps
};

struct CheckOptions {
  size_t cells = 2;  ///< most that are baked
  uint64_t rays_per_cell = 80'000;
  size_t eyes_per_cell = 14;
  /// For tests that a check can fail: what is done to the occluders before the bake, and to its answers.
  std::function<void(std::vector<WindowOccluders>&)> spoil_occluders;
  std::function<void(CellOcclusion&, const OcclusionInput&)> spoil_answer;
};

/// Prepares, bakes and checks a configuration with its model, in this process. Needs EGL. Throws nothing.
Outcome check_bake(const Settings& settings, const CheckOptions& options = {});

/// The same of a scene, which is written to a temporary folder.
Outcome check_scene(const CampaignScene& scene, const CheckOptions& options = {});

}  // namespace veduta::campaign
