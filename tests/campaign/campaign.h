// Many random scenes, one after the other, each in a process of its own; those that fail are made small.
#pragma once

#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "tests/campaign/isolate.h"

namespace veduta::campaign {

struct CampaignOptions {
  uint64_t scenes = 2000;
  uint64_t seed = 1;                                         ///< of the numbers of scenes
  std::vector<uint64_t> numbers;                             ///< these scenes alone
  double seconds = std::numeric_limits<double>::infinity();  ///< after which no scene is begun
  double timeout_s = 120;                                    ///< of a scene
  unsigned jobs = 1;
  std::filesystem::path out;       ///< for cases of what failed; empty: none are kept
  size_t minimised = 8;            ///< failures that are made small, the first ones
  size_t minimising_checks = 400;  ///< of each
  bool quiet = false;
};

struct Failure {
  uint64_t number = 0;  ///< generate(number) fails
  Outcome outcome;
  std::filesystem::path folder;  ///< of its case; empty where none was made
  size_t things = 0;             ///< that are left in it
};

struct CampaignReport {
  uint64_t scenes = 0;
  std::map<Verdict, uint64_t> verdicts;
  Outcome sum;  ///< of the counts
  std::vector<Failure> failures;
  std::vector<uint64_t> turned_gaps;  ///< numbers of scenes with that verdict
  double elapsed_s = 0;
  double slowest_s = 0;
  uint64_t slowest = 0;  ///< its number

  bool passed() const { return scenes > 0 && failures.empty(); }
  /// Of pairs of an object and a cell, 0..1. A campaign in which nothing is hidden tests nothing.
  double hidden_share() const {
    return sum.pairs > 0 ? static_cast<double>(sum.hidden) / static_cast<double>(sum.pairs) : 0;
  }
};

using SceneCheck = std::function<Outcome(const CampaignScene&)>;

/// The numbers of the scenes of a campaign.
std::vector<uint64_t> scene_numbers(const CampaignOptions& options);

/// Forks, as Isolated does. Says on standard error how far it is, and of each failure as it is found.
CampaignReport run_campaign(const CampaignOptions& options, const SceneCheck& check);

std::string describe(const CampaignReport& report);
std::string describe_json(const CampaignReport& report, const CampaignOptions& options);

}  // namespace veduta::campaign
