// Which ranks the coordinator has not heard of for too long. MPI does not tell: a rank that is stopped, or
// whose host hangs, is only silent.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace veduta {

class RankWatch {
 public:
  /// Times are of a WatchedTime, s. \param patience_s  a rank that says nothing for longer is silent
  RankWatch(int ranks, double patience_s, double now_s);

  /// What the rank said of itself. \param host  may be empty
  void introduce(int rank, const std::string& host, uint32_t workers);
  /// Any message. \return true when it was silent and has come back.
  bool heard(int rank, double now_s);
  /// The ranks that have become silent since the last call.
  std::vector<int> newly_silent(double now_s);

  bool silent(int rank) const { return ranks_[static_cast<size_t>(rank)].silent; }
  uint32_t workers(int rank) const { return ranks_[static_cast<size_t>(rank)].workers; }
  /// "rank 3 (host n1)".
  std::string name(int rank) const;

 private:
  struct Rank {
    std::string host;
    uint32_t workers = 0;
    double last_sign_s = 0;
    bool silent = false;
  };
  std::vector<Rank> ranks_;
  double patience_s_;
};

}  // namespace veduta
