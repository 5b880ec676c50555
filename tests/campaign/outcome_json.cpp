#include "tests/campaign/outcome_json.h"

namespace veduta::campaign {

nlohmann::json to_json(const Outcome& o) {
  return {{"verdict", name_of(o.verdict)},
          {"what", o.what},
          {"cell", {o.cell_lower.x, o.cell_lower.y, o.cell_upper.x, o.cell_upper.y}},
          {"cells", o.cells},
          {"pairs", o.pairs},
          {"hidden", o.hidden},
          {"hidden_heights", o.hidden_heights},
          {"rays", o.rays},
          {"narrow_gap_objects", o.narrow_gap_objects}};
}

Outcome outcome_from_json(const nlohmann::json& json) {
  Outcome o;
  for (const Verdict verdict : all_verdicts) {
    if (name_of(verdict) == json.at("verdict")) o.verdict = verdict;
  }
  o.what = json.at("what");
  const auto& cell = json.at("cell");
  o.cell_lower = {cell.at(0), cell.at(1)}, o.cell_upper = {cell.at(2), cell.at(3)};
  o.cells = json.at("cells"), o.pairs = json.at("pairs"), o.hidden = json.at("hidden");
  o.hidden_heights = json.at("hidden_heights"), o.rays = json.at("rays");
  o.narrow_gap_objects = json.at("narrow_gap_objects");
  return o;
}

}  // namespace veduta::campaign
