#include <fmt/format.h>

#include "tests/campaign/campaign.h"
#include "tests/campaign/outcome_json.h"

namespace veduta::campaign {

std::string describe(const CampaignReport& report) {
  std::string text = fmt::format("{} scenes in {:.0f} s ({:.2f} a second):", report.scenes, report.elapsed_s,
                                 static_cast<double>(report.scenes) / std::max(report.elapsed_s, 1e-9));
  for (const auto& [verdict, count] : report.verdicts) text += fmt::format(" {} {}", count, name_of(verdict));
  text += fmt::format(
      "\n{} cells, {} rays; of {} pairs of an object and a cell {:.1f} % are hidden, and {} heights of "
      "slices\n"
      "seen through nothing but gaps narrower than two seeds: {} pairs; slowest: {:.1f} s (scene {})\n",
      report.sum.cells, report.sum.rays, report.sum.pairs, 100 * report.hidden_share(),
      report.sum.hidden_heights, report.sum.narrow_gap_objects, report.slowest_s, report.slowest);
  for (const Failure& failure : report.failures) {
    text += fmt::format("scene {}: {}: {}\n", failure.number, name_of(failure.outcome.verdict),
                        failure.outcome.what);
    if (!failure.folder.empty())
      text += fmt::format("  {} objects left: {}\n", failure.things, failure.folder.string());
  }
  return text;
}

std::string describe_json(const CampaignReport& report, const CampaignOptions& options) {
  nlohmann::json verdicts = nlohmann::json::object(), failures = nlohmann::json::array();
  for (const auto& [verdict, count] : report.verdicts) verdicts[name_of(verdict)] = count;
  for (const Failure& failure : report.failures) {
    nlohmann::json entry = to_json(failure.outcome);
    entry["scene"] = failure.number;
    if (!failure.folder.empty())
      entry["case"] = failure.folder.string(), entry["objects_left"] = failure.things;
    failures.push_back(entry);
  }
  const nlohmann::json json{{"seed", options.seed},
                            {"jobs", options.jobs},
                            {"scenes", report.scenes},
                            {"verdicts", verdicts},
                            {"cells", report.sum.cells},
                            {"rays", report.sum.rays},
                            {"pairs", report.sum.pairs},
                            {"hidden", report.sum.hidden},
                            {"hidden_heights", report.sum.hidden_heights},
                            {"narrow_gap_objects", report.sum.narrow_gap_objects},
                            {"elapsed_s", report.elapsed_s},
                            {"slowest_s", report.slowest_s},
                            {"slowest_scene", report.slowest},
                            {"turned_gap_scenes", report.turned_gaps},
                            {"passed", report.passed()},
                            {"failures", failures}};
  return json.dump(2) + "\n";
}

}  // namespace veduta::campaign
