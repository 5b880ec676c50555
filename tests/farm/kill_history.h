// A bake that is killed again and again, and the books that are kept about it.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <iostream>
#include <map>
#include <random>
#include <set>

#include "merge/merge.h"
#include "tests/farm/bake_fixture.h"

namespace veduta::test {

using Cells = std::set<uint32_t>;

inline bool contains_all(const Cells& all, const Cells& some) {
  return std::includes(all.begin(), all.end(), some.begin(), some.end());
}

inline Cells without(const Cells& some, const Cells& others) {
  Cells left;
  std::set_difference(some.begin(), some.end(), others.begin(), others.end(),
                      std::inserter(left, left.end()));
  return left;
}

/// What log.jsonl says of the last attempt, read slowly and obviously.
struct LastAttempt {
  std::array<uint64_t, 3> journal{};  ///< cells done, in hands, baked again: what the resumed run found
  int journals = 0;                   ///< how many runs came so far as to say so
  int attempts = 0;                   ///< in the whole log
  std::map<std::pair<int, int>, Cells> lease_of_worker;  ///< the last one
  std::map<uint32_t, int> grants;                        ///< of each cell

  explicit LastAttempt(const fs::path& log) {
    std::istringstream lines(slurp(log));
    for (std::string text; std::getline(lines, text);) {
      const auto line = nlohmann::json::parse(text, nullptr, false);
      if (!line.is_object()) continue;
      if (line["event"] == "journal")
        ++journals, journal = {line["done"], line["in_hands"], line["baked_again"]};
      if (line["event"] == "started") ++attempts, lease_of_worker.clear(), grants.clear();
      if (line["event"] != "lease") continue;
      Cells& lease = lease_of_worker[{line["rank"], line["slot"]}];
      lease.clear();
      for (uint32_t i = 0; i < line["count"]; ++i) {
        lease.insert(line["begin"].get<uint32_t>() + i);
        ++grants[line["begin"].get<uint32_t>() + i];
      }
    }
  }
  Cells held() const {
    Cells all;
    for (const auto& [worker, lease] : lease_of_worker) all.insert(lease.begin(), lease.end());
    return all;
  }
};

class KillHistory : public Bake {
 protected:
  static constexpr int ranks = 2;
  enum class Victim { launcher, rank, worker };

  Environment environment() const {
    return {{"FAKE_CELLS", std::to_string(cells_)},
            {"FAKE_CELL_MS", "5"},
            {"FAKE_GATE", (directory / "gate").string()},
            {"FAKE_BEGUN", begun_file().string()}};
  }
  /// To aim takes a while, in which the cells must not come to their end.
  void let_begin(size_t cells) const {
    std::ofstream(directory / "gate.new") << cells;
    fs::rename(directory / "gate.new", directory / "gate");
  }
  fs::path begun_file() const { return directory / "begun"; }
  size_t begun_count() const {
    std::error_code ignored;
    const auto bytes = fs::file_size(begun_file(), ignored);
    return ignored ? 0 : bytes / sizeof(uint32_t);
  }
  std::vector<uint32_t> begun() const {
    const std::string bytes = slurp(begun_file());
    std::vector<uint32_t> cells(bytes.size() / sizeof(uint32_t));
    if (!cells.empty()) std::memcpy(cells.data(), bytes.data(), cells.size() * sizeof(uint32_t));
    return cells;
  }
  /// By the journal, which may be read at any time.
  Cells recorded(uint32_t cells) const {
    const RunPaths run{directory / "run"};
    Cells done;
    const std::string fingerprint = slurp(run.fingerprint()).substr(0, 32);
    if (fingerprint.size() < 32) return done;
    const Journal journal = read_journal(run, fingerprint, cells);
    for (uint32_t cell = 0; cell < cells; ++cell)
      if (journal.cells[cell].shard >= 0) done.insert(cell);
    return done;
  }

  /// Kills a bake of `cells` cells `kills` times, continues it to its end, and checks after each attempt that
  /// what was recorded stays so, and that a cell is begun again only when it was in hands.
  void play(uint32_t cells, int kills, uint32_t seed) {
    std::mt19937 random(seed);
    const auto some = [&](double most) { return std::uniform_real_distribution<>(0, most)(random); };
    cells_ = cells, kills_left_ = kills;
    begin_attempt();
    while (kills_left_ > 0) {
      // Most moments are counted in cells, so that the bake lasts for all of them; some in time, so that they
      // fall into the beginning of an attempt too.
      const double share = (kills - kills_left_ + some(1)) / kills;
      const size_t target =
          std::max(static_cast<size_t>(0.85 * share * cells), begun_count() + 1 + random() % 4);
      let_begin(target + random() % 20);
      const double patience_s = some(1) < 0.2 ? some(0.8) : 60;
      within(patience_s, [&] { return begun_count() >= target || process_->ended(); });
      if (process_->ended()) break;  // too early: the test fails by the count of kills
      const auto victim = static_cast<Victim>(kills_left_ % 3);
      before_kill_ = recorded(cells);
      const bool ends = kill_one(victim, random);
      --kills_left_, ++kills_done_[static_cast<size_t>(victim)];
      if (!ends) continue;
      end_attempt();
      if (HasFatalFailure()) return;
      begin_attempt();
    }
    let_begin(SIZE_MAX / 100);
    EXPECT_EQ(process_->wait(), 0) << process_->output();
    check_attempt();
    EXPECT_EQ(recorded(cells).size(), cells);
  }

  /// \return true when the attempt ends with it.
  bool kill_one(Victim victim, std::mt19937& random) {
    const auto victims = victim == Victim::rank     ? descendants(process_->pid(), "veduta")
                         : victim == Victim::worker ? descendants(process_->pid(), "fake_worker")
                                                    : std::vector<pid_t>();
    const pid_t chosen = victims.empty() ? process_->pid() : victims[random() % victims.size()];
    if (chosen == process_->pid() || victim == Victim::rank) {
      family_ = descendants(process_->pid(), "");
      kill(chosen, SIGKILL);
      return true;
    }
    kill(chosen, SIGKILL);
    return false;
  }

  void begin_attempt() {
    begun_before_ = begun_count();
    const LastAttempt log(directory / "run" / "log.jsonl");
    attempts_before_ = log.attempts, journals_before_ = log.journals;
    process_ = start(mpirun(ranks, bake("", "run", 1)), environment());
    ++attempts_;
  }

  void end_attempt() {
    EXPECT_NE(process_->wait(), 0) << process_->output();
    const auto began = std::chrono::steady_clock::now();
    ASSERT_TRUE(within(20, [&] { return all_gone(family_); }));
    longest_end_s_ = std::max(
        longest_end_s_, std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count());
    check_attempt();
  }

  void check_attempt() {
    const Cells done = recorded(cells_);
    EXPECT_TRUE(contains_all(done, before_kill_)) << "acknowledged cells were lost";
    EXPECT_TRUE(contains_all(done, done_)) << "acknowledged cells were lost";
    // What the attempt said when it began.
    const std::string said = process_->output();
    if (const size_t at = said.find("continuing: "); at != std::string::npos) {
      EXPECT_EQ(said.substr(at, said.find('\n', at) - at).find(expected_line_), 0u)
          << said << "\nexpected: " << expected_line_;
      ++lines_checked_;
    }
    // What it began was given out as often in this attempt.
    const LastAttempt log(directory / "run" / "log.jsonl");
    if (log.journals > journals_before_) {
      EXPECT_EQ(log.journal, expected_);
      ++journals_checked_;
    }
    const auto all = begun();
    std::map<uint32_t, int> begun_now;
    for (size_t i = begun_before_; i < all.size(); ++i) ++begun_now[all[i]];
    EXPECT_TRUE(begun_now.empty() || log.attempts == attempts_before_ + 1);
    for (const auto& [cell, times] : begun_now) {
      const auto granted = log.grants.find(cell);
      EXPECT_LE(times, granted == log.grants.end() ? 0 : granted->second) << "cell " << cell;
      EXPECT_FALSE(done_.contains(cell)) << "cell " << cell << " was baked again although it was recorded";
    }
    // What was begun and is not recorded was in hands when an attempt ended.
    const Cells held = log.attempts > attempts_before_ ? log.held() : Cells();
    in_hands_.insert(held.begin(), held.end());
    EXPECT_TRUE(contains_all(in_hands_, without({all.begin(), all.end()}, done)));
    const Cells last_held = log.held();
    expected_ = {done.size(), last_held.size(), without(last_held, done).size()};
    expected_line_ = fmt::format("continuing: {} of {} cells are done", done.size(), cells_);
    if (!last_held.empty())
      expected_line_ += fmt::format("; {} were in hands when it stopped, {} of them are baked again",
                                    expected_[1], expected_[2]);
    done_ = done;
  }

  void print_figures(const std::string& name) const {
    const size_t again = begun_count() - cells_;
    const int kills = kills_done_[0] + kills_done_[1] + kills_done_[2];
    std::cout << fmt::format(
        "{}: {} kills (mpirun {}, ranks {}, workers {}), {} attempts, {} cells, {} bakes begun, {} again "
        "({:.2f} a "
        "kill), {} resumed runs count the same, all gone {:.1f} s after mpirun at most\n",
        name, kills, kills_done_[0], kills_done_[1], kills_done_[2], attempts_, cells_, begun_count(), again,
        kills == 0 ? 0 : static_cast<double>(again) / kills, journals_checked_, longest_end_s_);
  }

  std::unique_ptr<Process> process_;
  uint32_t cells_ = 0;
  int kills_left_ = 0, attempts_ = 0, attempts_before_ = 0, journals_before_ = 0, lines_checked_ = 0,
      journals_checked_ = 0;
  std::array<int, 3> kills_done_{};
  size_t begun_before_ = 0;
  std::vector<pid_t> family_;
  Cells before_kill_, done_, in_hands_;
  std::array<uint64_t, 3> expected_{};
  std::string expected_line_;
  double longest_end_s_ = 0;
};

}  // namespace veduta::test
