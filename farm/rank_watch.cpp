#include "farm/rank_watch.h"

#include <fmt/format.h>

#include <utility>

namespace veduta {

RankWatch::RankWatch(int ranks, double patience_s, double now_s)
    : ranks_(static_cast<size_t>(ranks)), patience_s_(patience_s) {
  for (Rank& rank : ranks_) rank.last_sign_s = now_s;
}

void RankWatch::introduce(int rank, const std::string& host, uint32_t workers) {
  ranks_[static_cast<size_t>(rank)].host = host, ranks_[static_cast<size_t>(rank)].workers = workers;
}

bool RankWatch::heard(int rank, double now_s) {
  Rank& known = ranks_[static_cast<size_t>(rank)];
  known.last_sign_s = now_s;
  return std::exchange(known.silent, false);
}

std::vector<int> RankWatch::newly_silent(double now_s) {
  std::vector<int> found;
  for (size_t rank = 0; rank < ranks_.size(); ++rank) {
    if (ranks_[rank].silent || now_s - ranks_[rank].last_sign_s <= patience_s_) continue;
    ranks_[rank].silent = true;
    found.push_back(static_cast<int>(rank));
  }
  return found;
}

std::string RankWatch::name(int rank) const {
  const std::string& host = ranks_[static_cast<size_t>(rank)].host;
  return fmt::format("rank {}{}", rank, host.empty() ? "" : " (host " + host + ")");
}

}  // namespace veduta
